//! Taking a vertex away: its star is filled with the best triangles over the same neighbours.

use super::Editor;
use super::replace::Edit;

use crate::layout::{are_unfolded, full_star, half_star};
use crate::shape::signed_quality;
use crate::star::{Face, Ring, side_between};
use glam::{DVec2, DVec3};
use mesh_core::{FaceId, VertexId, cheapest_filling, exact, inverse_mean_ratio};
use region_map::{ArcSpan, Attachment};

/// How the star of a vertex is filled.
#[derive(Clone, Copy)]
pub(crate) enum Filling<'t> {
    /// With a fan round one of the neighbours: the vertex is collapsed into it. On an arc it must be a neighbour there.
    Fan(VertexId),
    /// With the triangles of the best shape.
    Cheapest,
    /// With those of these triangles that have all corners on the polygon.
    Given(&'t [[VertexId; 3]]),
}

/// What taking a vertex away would leave.
pub(crate) struct Removal {
    vertex: VertexId,
    edits: Vec<Edit>,
    /// For a vertex on an arc its neighbours there, and the span between them then.
    joined: Option<([VertexId; 2], ArcSpan)>,
    /// Least quality (AR) of the new triangles, negative with one that faces against the surface.
    pub(crate) quality: f64,
    /// The same of those that are there now.
    pub(crate) quality_before: f64,
    /// Longest of the new edges.
    pub(crate) longest: f64,
}

impl Editor<'_> {
    /// How to take `v` away. `None` for a corner, and where the filling makes no simplicial mesh.
    pub(crate) fn removal(&self, v: VertexId, filling: Filling<'_>) -> Option<Removal> {
        let ring = self.ring(v)?;
        let (edits, joined) = match self.attachment(v) {
            Attachment::Corner(_) => return None,
            Attachment::Sheet(_) if ring.closed => (vec![self.removal_inside(v, &ring, filling)?], None),
            Attachment::Sheet(_) => return None,
            Attachment::Arc { .. } => {
                let (edits, ends, span) = self.removal_on_arc(v, &ring, filling)?;
                (edits, Some((ends, span)))
            }
        };
        let mut removal = Removal { vertex: v, edits, joined, quality: 1.0, quality_before: 1.0, longest: 0.0 };
        removal.rate(self);
        Some(removal)
    }

    /// Takes a vertex away. False, changing nothing, where the new triangles would turn their backs on the surface.
    pub(crate) fn take_away(&mut self, removal: &Removal) -> bool {
        if !self.replace(&removal.edits, None) {
            return false;
        }
        let v = removal.vertex;
        if let Some(([u, w], span)) = removal.joined {
            self.region.spans.remove(&[v.min(u), v.max(u)]);
            self.region.spans.remove(&[v.min(w), v.max(w)]);
            self.region.insert_span(u, w, span);
        }
        self.n_vertices -= 1;
        true
    }

    fn removal_inside(&self, v: VertexId, ring: &Ring, filling: Filling<'_>) -> Option<Edit> {
        let n = ring.vertices.len();
        // Two triangles over the same three vertices are a pillow.
        let is_pillow = |t: [VertexId; 3]| self.is_face(t) || self.is_face([t[0], t[2], t[1]]);
        if n < 3 || (n == 3 && is_pillow([ring.vertices[0], ring.vertices[1], ring.vertices[2]])) {
            return None;
        }
        let positions: Vec<DVec3> = ring.vertices.iter().map(|&w| self.position(w)).collect();
        let spokes = |p: &[DVec2]| -> Vec<[DVec2; 3]> { (0..n).map(|i| [DVec2::ZERO, p[i], p[(i + 1) % n]]).collect() };
        let normal = self.star_normal(&ring.faces);
        let filled = |p: &[DVec2]| are_unfolded(&spokes(p)).then(|| self.filled(&ring.vertices, p, normal, filling)).flatten();
        let flat = full_star(self.position(v), &positions, |p| filled(p).is_some());
        let triangles = filled(&flat)?;
        let corners = |i: usize| [v, ring.vertices[i], ring.vertices[(i + 1) % n]];
        let old = ring.faces.iter().zip(spokes(&flat)).enumerate().map(|(i, (&f, layout))| (f, corners(i), layout)).collect();
        Some(Edit { old, new: named(&triangles, &ring.vertices, &flat) })
    }

    /// Both sides of the arc are laid out on their own, with the arc straight and by arc length.
    fn removal_on_arc(&self, v: VertexId, ring: &Ring, filling: Filling<'_>) -> Option<(Vec<Edit>, [VertexId; 2], ArcSpan)> {
        let along: Vec<VertexId> = ring.vertices.iter().copied().filter(|&w| self.span(v, w).is_some()).collect();
        let [u, w] = along[..] else { return None };
        let (to_u, to_w) = (self.span(v, u)?, self.span(v, w)?);
        if self.is_edge(u, w) || matches!(filling, Filling::Fan(apex) if apex != u && apex != w) {
            return None;
        }
        let lengths = [(to_u.to - to_u.from).abs(), (to_w.to - to_w.from).abs()];
        let sides = [(side_between(ring, u, w), lengths), (side_between(ring, w, u), [lengths[1], lengths[0]])];
        let sides: Vec<(Ring, [f64; 2])> = sides.into_iter().filter_map(|(side, lengths)| Some((side?, lengths))).collect();
        if let [(a, _), (b, _)] = &sides[..]
            && inner(a).iter().any(|x| inner(b).contains(x))
        {
            return None;
        }
        let edits = sides.iter().map(|(side, lengths)| self.removal_beside(v, side, *lengths, filling)).collect::<Option<_>>()?;
        let span = ArcSpan { arc: to_u.arc, from: to_u.to, to: to_u.from + to_w.to - to_w.from };
        Some((edits, [u, w], span))
    }

    fn removal_beside(&self, v: VertexId, side: &Ring, [ahead, behind]: [f64; 2], filling: Filling<'_>) -> Option<Edit> {
        let positions: Vec<DVec3> = side.vertices.iter().map(|&w| self.position(w)).collect();
        let spokes = |p: &[DVec2]| -> Vec<[DVec2; 3]> { p.windows(2).map(|w| [DVec2::ZERO, w[0], w[1]]).collect() };
        let normal = self.star_normal(&side.faces);
        let is_unfolded = |p: &[DVec2]| spokes(p).iter().all(|t| exact::orient2d(t[0], t[1], t[2]) > 0.0);
        let filled = |p: &[DVec2]| is_unfolded(p).then(|| self.filled(&side.vertices, p, normal, filling)).flatten();
        let flat = half_star(self.position(v), &positions, ahead, behind, |p| are_unfolded(&spokes(p)) && filled(p).is_some());
        let triangles = filled(&flat)?;
        let faces = side.faces.iter().zip(side.vertices.windows(2)).zip(spokes(&flat));
        let old = faces.map(|((&f, w), layout)| (f, [v, w[0], w[1]], layout)).collect();
        Some(Edit { old, new: named(&triangles, &side.vertices, &flat) })
    }

    /// A triangulation of a flat polygon, by places in the list of its vertices. Its last side may be an edge to come.
    fn filled(&self, vertices: &[VertexId], flat: &[DVec2], normal: DVec3, filling: Filling<'_>) -> Option<Vec<[usize; 3]>> {
        let n = vertices.len();
        let is_side = |i: usize, j: usize| i.abs_diff(j) == 1 || i.abs_diff(j) == n - 1;
        let may_be = |i: usize, j: usize| is_side(i, j) || !self.is_edge(vertices[i], vertices[j]);
        let is_sound = |&[i, k, j]: &[usize; 3]| {
            may_be(i, k) && may_be(k, j) && may_be(i, j) && are_unfolded(&[[flat[i], flat[k], flat[j]]])
        };
        match filling {
            Filling::Fan(apex) => {
                let start = vertices.iter().position(|&w| w == apex)?;
                let fan: Vec<_> = (1..n - 1).map(|i| [start, (start + i) % n, (start + i + 1) % n]).collect();
                fan.iter().all(is_sound).then_some(fan)
            }
            Filling::Given(triangles) => {
                let place = |v: VertexId| vertices.iter().position(|&w| w == v);
                let places = triangles.iter().filter_map(|&[a, b, c]| Some([place(a)?, place(b)?, place(c)?]));
                // A polygon's corners come in their order round it, whichever is first.
                let mut given: Vec<_> = places.collect();
                given.iter_mut().for_each(|t| t.sort_unstable());
                (given.len() + 2 == n && given.iter().all(is_sound)).then_some(given)
            }
            Filling::Cheapest => {
                cheapest_filling(n, |t| is_sound(&t).then(|| inverse_mean_ratio(t.map(|i| self.position(vertices[i])), normal)))
            }
        }
    }

    /// The mean of the normals of some faces, by their areas.
    fn star_normal(&self, faces: &[FaceId]) -> DVec3 {
        let weighted = |face: Face| mesh_core::area(self.triangle(&face)) * face.normal;
        faces.iter().filter_map(|&f| self.face(f)).map(weighted).sum::<DVec3>().normalize_or_zero()
    }
}

impl Removal {
    fn rate(&mut self, editor: &Editor<'_>) {
        for edit in &self.edits {
            let faces: Vec<_> = edit.old.iter().map(|o| o.0).collect();
            let normal = editor.star_normal(&faces);
            for face in faces.iter().filter_map(|&f| editor.face(f)) {
                self.quality_before = self.quality_before.min(signed_quality(editor.triangle(&face), face.normal));
            }
            for (corners, _) in &edit.new {
                let t = corners.map(|v| editor.position(v));
                self.quality = self.quality.min(signed_quality(t, normal));
                self.longest = (0..3).fold(self.longest, |l, i| l.max(t[i].distance(t[(i + 1) % 3])));
            }
        }
    }
}

/// All vertices of one side of an arc but the first and the last.
fn inner(side: &Ring) -> &[VertexId] {
    &side.vertices[1..side.vertices.len() - 1]
}

fn named(triangles: &[[usize; 3]], vertices: &[VertexId], flat: &[DVec2]) -> Vec<([VertexId; 3], [DVec2; 3])> {
    triangles.iter().map(|t| (t.map(|i| vertices[i]), t.map(|i| flat[i]))).collect()
}
