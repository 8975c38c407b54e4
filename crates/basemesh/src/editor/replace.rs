//! The one way in which a base mesh changes: faces that fill flat polygons are replaced by others, in the mesh and in the map.

use super::mesh::{Editor, surface_normal};
use super::samples::{MOST_TURNED, Placed, moved};
use super::star::Face;
use glam::{DVec2, DVec3};
use mesh_core::{FaceId, VertexId, normal};
use region_map::MapFaceId;

/// Faces that fill a flat polygon, and what comes in their place.
pub(crate) struct Edit {
    /// Faces that go, with their corners and the places of these.
    pub(crate) old: Vec<(FaceId, [VertexId; 3], [DVec2; 3])>,
    /// Faces that come: corners and their places.
    pub(crate) new: Vec<([VertexId; 3], [DVec2; 3])>,
}

impl Edit {
    /// The edges between two faces that go, ends rising: those on the border of the polygon stay what they are.
    fn inner_edges(&self) -> Vec<[VertexId; 2]> {
        let sides = self.old.iter().flat_map(|(_, v, _)| (0..3).map(|c| [v[c], v[(c + 1) % 3]]));
        let mut edges: Vec<_> = sides.map(|[a, b]| [a.min(b), a.max(b)]).collect();
        edges.sort_unstable();
        edges.windows(2).filter(|w| w[0] == w[1]).map(|w| w[0]).collect()
    }
}

/// An edit as the map sees it: with every old face in the map's own order of corners, and what the new faces cover.
struct Plan {
    old: Vec<(MapFaceId, [DVec2; 3])>,
    new: Vec<[DVec2; 3]>,
    covered: Vec<Vec<Placed>>,
}

impl Editor<'_> {
    /// Replaces faces by others that fill the same flat polygons, and moves a vertex there if `v` names one. False, changing nothing, where
    /// a new face would face against more than [`MOST_TURNED`] of the surface that it covers, unless an old one did so no less.
    pub(super) fn replace(&mut self, edits: &[Edit], v: Option<(VertexId, DVec3)>) -> bool {
        let Some(plans) = self.plans(edits) else { return false };
        let before = edits.iter().flat_map(|e| &e.old).map(|&(f, ..)| self.turned(f)).fold(MOST_TURNED, f64::max);
        let at = |w: VertexId| v.filter(|v| v.0 == w).map_or(self.positions[w], |v| v.1);
        let turns = |corners: [VertexId; 3], covered: &[Placed]| self.samples.turned_share(covered, normal(corners.map(at)));
        let new = edits.iter().zip(&plans).flat_map(|(e, p)| e.new.iter().zip(&p.covered));
        if new.into_iter().any(|(n, covered)| turns(n.0, covered) > before) {
            return false;
        }
        self.carry_out(edits, plans)
    }

    /// The same without asking how the new faces face: for splits, which leave the shape as it is.
    pub(super) fn replace_anyway(&mut self, edits: &[Edit]) -> bool {
        self.plans(edits).is_some_and(|plans| self.carry_out(edits, plans))
    }

    /// The share of the surface that a face covers and faces against.
    fn turned(&self, f: FaceId) -> f64 {
        self.face(f).map_or(0.0, |face| self.samples.turned_share(&self.covered[f], normal(self.triangle(&face))))
    }

    fn plans(&self, edits: &[Edit]) -> Option<Vec<Plan>> {
        edits.iter().map(|e| self.plan(e)).collect()
    }

    fn plan(&self, edit: &Edit) -> Option<Plan> {
        let turned = |&(f, vertices, layout): &(FaceId, [VertexId; 3], [DVec2; 3])| {
            let face = self.face(f)?;
            let c = vertices.iter().position(|&v| v == face.vertices[0])?;
            Some((face.map, [0, 1, 2].map(|i| layout[(c + i) % 3])))
        };
        let old: Vec<_> = edit.old.iter().map(turned).collect::<Option<_>>()?;
        let new: Vec<[DVec2; 3]> = edit.new.iter().map(|n| n.1).collect();
        let contents = edit.old.iter().zip(&old).map(|(o, t)| (self.covered[o.0].as_slice(), t.1));
        let covered = moved(contents, &new);
        Some(Plan { old, new, covered })
    }

    fn carry_out(&mut self, edits: &[Edit], plans: Vec<Plan>) -> bool {
        for (i, (edit, plan)) in edits.iter().zip(plans).enumerate() {
            let Some(sheet) = edit.old.first().and_then(|o| self.face(o.0)).map(|f| f.sheet) else { return false };
            let Ok(made) = self.map.replace(&plan.old, &plan.new) else {
                debug_assert!(i == 0, "a layout that was checked is refused");
                return false;
            };
            edit.inner_edges().iter().for_each(|edge| {
                self.lengths.remove(edge);
            });
            for (f, vertices, _) in &edit.old {
                vertices.iter().for_each(|&v| self.star[v].retain(|g| g != f));
                self.faces[*f] = None;
                self.covered[*f] = Vec::new();
            }
            for (((vertices, _), map), covered) in edit.new.iter().zip(made).zip(plan.covered) {
                let normal = self.samples.mean_normal(&covered).unwrap_or_else(|| surface_normal(self.surface, &self.map, map));
                let f = self.faces.push(Some(Face { vertices: *vertices, sheet, map, normal }));
                self.covered.push(covered);
                vertices.iter().for_each(|&v| self.star[v].push(f));
            }
        }
        true
    }
}
