//! Rounded creases: those that are spread over several weak edges side by side, as small fillets, bevels and rounded rims.
//!
//! None of these edges is sharp by itself, but a result whose edges are longer than the strip is wide has a crease there, ragged where nothing
//! says where it runs. So one row of edges along the strip is taken for the crease.

use crate::crease::{Creases, away};
use glam::DVec3;
use mesh_core::{EdgeId, FaceId, HalfedgeId, IdVec, SurfacePoint, Topology, TriMesh, VertexId, walk};
use region_map::spokes;
use std::cell::RefCell;

/// An edge of a rounded crease has at least this dihedral angle, in degrees: less is noise, and the diagonals of curved strips.
const LEAST_ANGLE: f64 = 6.0;
/// The surface turns about such an edge: cosine of the angle between them at least. Edges across a strip turn it as well.
const ALONG: f64 = 0.85;
/// Cosine of the angle by which a row turns from edge to edge at most.
const GOES_ON: f64 = 0.7;
/// A rounded crease is as long as so many widths at least.
const LEAST_LENGTH: f64 = 8.0;

/// An edge about which the surface turns within the width.
struct Candidate {
    /// By how many degrees the surface turns there, less what it turns by beside it.
    turn: f64,
    /// The edges beside it, within half the width.
    beside: Vec<EdgeId>,
}

/// Edges on which a surface turns by `angle` degrees or more within a width, and goes on flat on both sides; one row of edges along each such
/// strip, with the angles that it turns by. Creases end a strip.
pub(crate) fn rounded_creases(
    mesh: &TriMesh,
    topology: &Topology,
    creases: &Creases,
    width: f64,
    angle: f64,
) -> Vec<(EdgeId, f64)> {
    let finder = Finder { mesh, topology, creases, width };
    let candidate = |e| finder.candidate(e).filter(|candidate| candidate.turn >= angle);
    let at: IdVec<EdgeId, Option<Candidate>> = topology.edge_ids().map(candidate).collect();
    let strength = |row: &Vec<EdgeId>| -> f64 {
        row.iter().map(|&e| finder.length(e) * at[e].as_ref().map_or(0.0, |candidate| candidate.turn)).sum()
    };
    let mut ranked: Vec<(f64, Vec<EdgeId>)> = finder.rows(&at).into_iter().map(|row| (strength(&row), row)).collect();
    ranked.sort_by(|(s, row), (t, other)| t.total_cmp(s).then(row.iter().min().cmp(&other.iter().min())));
    let mut is_taken: IdVec<EdgeId, bool> = IdVec::filled(false, topology.n_edges());
    let mut taken = Vec::new();
    for (_, row) in ranked {
        let is_free = |e: &EdgeId| at[*e].as_ref().is_some_and(|candidate| candidate.beside.iter().all(|&f| !is_taken[f]));
        let free: Vec<bool> = row.iter().map(is_free).collect();
        for run in runs(&row, &free) {
            if run.iter().map(|&e| finder.length(e)).sum::<f64>() >= LEAST_LENGTH * width {
                taken.extend(run.iter().filter_map(|&e| Some((e, at[e].as_ref()?.turn))));
                run.iter().for_each(|&e| is_taken[e] = true);
            }
        }
    }
    taken
}

/// The longest parts of a row whose edges are all free.
fn runs<'a>(row: &'a [EdgeId], free: &'a [bool]) -> Vec<&'a [EdgeId]> {
    let mut runs = Vec::new();
    let mut start = 0;
    for part in free.chunk_by(|a, b| a == b) {
        let end = start + part.len();
        if part[0] {
            runs.push(&row[start..end]);
        }
        start = end;
    }
    runs
}

struct Finder<'a> {
    mesh: &'a TriMesh,
    topology: &'a Topology,
    creases: &'a Creases,
    width: f64,
}

impl Finder<'_> {
    /// An edge as a candidate; `None` where the surface does not turn about it.
    fn candidate(&self, e: EdgeId) -> Option<Candidate> {
        let h = self.topology.halfedge(e);
        let twin = self.topology.twin(h)?;
        if self.creases.is_crease(e) || self.creases.angle[e] < LEAST_ANGLE {
            return None;
        }
        let beside = RefCell::new(Vec::new());
        let [[m, m_far], [n, n_far]] = [self.normals_beside(h, &beside)?, self.normals_beside(twin, &beside)?];
        let along = self.along(h);
        if m.cross(n).normalize_or_zero().dot(along).abs() < ALONG {
            return None;
        }
        let turn = (m.angle_between(n) - m.angle_between(m_far) - n.angle_between(n_far)).to_degrees();
        Some(Candidate { turn, beside: beside.into_inner() })
    }

    /// Normals half a width and a whole width beside a halfedge, on the side of its face. `None` where the surface ends or has a crease
    /// nearer than half a width. The edges up to there are added to `beside`.
    fn normals_beside(&self, h: HalfedgeId, beside: &RefCell<Vec<EdgeId>>) -> Option<[DVec3; 2]> {
        let (f, along) = (h.face(), self.along(h));
        let inwards = self.mesh.normal(f).cross(along);
        let mut middle = DVec3::ZERO;
        middle[h.corner()] = 0.5;
        middle[(h.corner() + 1) % 3] = 0.5;
        let start = SurfacePoint { face: f, barycentric: middle };
        let normal = |f: FaceId| self.mesh.normal(f);
        let may_cross = |e: EdgeId| {
            let may = !self.creases.is_crease(e);
            if may {
                beside.borrow_mut().push(e);
            }
            may
        };
        let near = walk(self.mesh, self.topology, start, 0.5 * self.width * inwards, may_cross);
        if near.stopped {
            return None;
        }
        let onwards = 0.5 * self.width * near.direction;
        let far = walk(self.mesh, self.topology, near.end, onwards, |e| !self.creases.is_crease(e));
        Some([normal(near.end.face), normal(far.end.face)])
    }

    /// Unit vector along a halfedge.
    fn along(&self, h: HalfedgeId) -> DVec3 {
        let [a, b] = [self.topology.from(h), self.topology.to(h)].map(|v| self.mesh.position(v));
        (b - a).normalize_or_zero()
    }

    fn length(&self, e: EdgeId) -> f64 {
        let [a, b] = self.topology.ends(e);
        self.mesh.distance(a, b)
    }

    /// Rows of candidates that go on from each other, in their order along the row.
    fn rows(&self, at: &IdVec<EdgeId, Option<Candidate>>) -> Vec<Vec<EdgeId>> {
        let mut is_used: IdVec<EdgeId, bool> = at.iter().map(Option::is_none).collect();
        let mut rows = Vec::new();
        for first in at.ids() {
            if is_used[first] {
                continue;
            }
            is_used[first] = true;
            let [a, b] = self.topology.ends(first);
            let mut row = self.onwards(first, a, at, &mut is_used);
            row.reverse();
            row.push(first);
            row.extend(self.onwards(first, b, at, &mut is_used));
            rows.push(row);
        }
        rows
    }

    /// The edges that go on from an end of an edge.
    fn onwards(
        &self,
        first: EdgeId,
        end: VertexId,
        at: &IdVec<EdgeId, Option<Candidate>>,
        is_used: &mut IdVec<EdgeId, bool>,
    ) -> Vec<EdgeId> {
        let (mut edge, mut v, mut row) = (first, end, Vec::new());
        loop {
            let way = away(self.mesh, self.topology, edge, v);
            let next = spokes(self.topology, v).map(|h| self.topology.edge(h)).filter(|&e| at[e].is_some() && e != edge);
            let turned = |e: &EdgeId| -away(self.mesh, self.topology, *e, v).dot(way);
            let Some(next) = next.filter(|e| turned(e) >= GOES_ON).max_by(|e, f| turned(e).total_cmp(&turned(f)).then(f.cmp(e)))
            else {
                return row;
            };
            if std::mem::replace(&mut is_used[next], true) {
                return row;
            }
            let [a, b] = self.topology.ends(next);
            (edge, v) = (next, if a == v { b } else { a });
            row.push(next);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FeatureOptions;

    /// A box with rounded long edges: a rounded rectangle of half size `half` and corner radius `radius`, swept along z.
    fn rounded_bar(half: f64, radius: f64, steps: usize, length: f64, n_along: usize) -> TriMesh {
        let mut outline = Vec::new();
        for corner in 0..4 {
            let centre = DVec3::new([1.0, -1.0, -1.0, 1.0][corner], [1.0, 1.0, -1.0, -1.0][corner], 0.0) * (half - radius);
            for i in 0..=steps {
                let angle = std::f64::consts::FRAC_PI_2 * (corner as f64 + i as f64 / steps as f64);
                outline.push(centre + radius * DVec3::new(angle.cos(), angle.sin(), 0.0));
            }
        }
        let n = outline.len() as u32;
        let ring = |j: usize| outline.iter().map(move |p| (*p + DVec3::Z * length * j as f64 / n_along as f64).to_array());
        let positions: Vec<[f64; 3]> = (0..=n_along).flat_map(ring).collect();
        let quads = (0..n_along as u32)
            .flat_map(|j| (0..n).map(move |i| [j * n + i, j * n + (i + 1) % n, (j + 1) * n + (i + 1) % n, (j + 1) * n + i]));
        let faces: Vec<[u32; 3]> = quads.flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        TriMesh::from_slices(&positions, &faces).unwrap()
    }

    fn found(mesh: &TriMesh, width: f64) -> (Topology, Vec<(EdgeId, f64)>) {
        let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
        let creases = Creases::find(mesh, &topology, &FeatureOptions::default());
        let found = rounded_creases(mesh, &topology, &creases, width, 40.0);
        (topology, found)
    }

    /// Each rounded edge has one row of edges along it where it is narrow, and none where it is wide.
    #[test]
    fn a_narrow_rounded_edge_is_one_row() {
        for steps in [3, 4, 7] {
            let mesh = rounded_bar(1.0, 0.05, steps, 4.0, 10);
            let (topology, rows) = found(&mesh, 0.25);
            assert_eq!(rows.len(), 4 * 10, "{steps}");
            assert!(rows.iter().all(|(_, turn)| (*turn - 90.0).abs() < 1e-6));
            // One edge in each ring of each rounded edge, so the rows are whole.
            let lines: std::collections::BTreeSet<u32> =
                rows.iter().map(|(e, _)| topology.ends(*e)[0].0 % (4 * (steps as u32 + 1))).collect();
            assert_eq!(lines.len(), 4, "{steps}");
            assert!(found(&mesh, 0.02).1.is_empty());
        }
        assert!(found(&rounded_bar(1.0, 0.9, 12, 4.0, 10), 0.25).1.is_empty());
    }

    /// A thin rod turns everywhere; a sphere, too.
    #[test]
    fn round_things_have_none() {
        assert!(found(&rounded_bar(0.1, 0.1, 8, 4.0, 40), 0.1).1.is_empty());
        assert!(found(&fixtures::icosphere(8), 0.3).1.is_empty());
    }

    #[test]
    fn creases_have_none_beside_them() {
        assert!(found(&fixtures::cube(6), 0.3).1.is_empty());
    }
}
