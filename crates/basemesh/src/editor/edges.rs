//! Edits of a single edge or face: flip and split.

use super::layout::quad;
use super::mesh::Editor;
use super::replace::Edit;
use super::star::Face;
use glam::{DVec2, DVec3};
use mesh_core::{FaceId, SurfacePoint, VertexId};
use region_map::{ArcSpan, Attachment};

impl Editor<'_> {
    /// Replaces the edge between `a` and `b` by the other diagonal of its two faces. False when that is no simplicial mesh or the
    /// edge lies on an arc.
    pub(crate) fn flip(&mut self, a: VertexId, b: VertexId) -> bool {
        let [Some((f, c)), Some((g, d))] = self.beside(a, b) else { return false };
        if self.span(a, b).is_some() || c == d || self.is_edge(c, d) {
            return false;
        }
        let [pa, pb, pc, pd] = quad([a, b, c, d].map(|v| self.positions[v]));
        let old = vec![(f, [a, b, c], [pa, pb, pc]), (g, [b, a, d], [pb, pa, pd])];
        let new = vec![([a, d, c], [pa, pd, pc]), ([d, b, c], [pd, pb, pc])];
        self.replace(&[Edit { old, new }], None)
    }

    /// Puts a vertex in the middle of an edge, on an arc at the middle of its span. `None` when that fails.
    pub(crate) fn split(&mut self, a: VertexId, b: VertexId) -> Option<VertexId> {
        let sides = self.beside(a, b);
        let (f, _) = sides[0].or(sides[1])?;
        let face = self.face(f)?;
        let mut weights = DVec3::splat(0.5);
        weights[(0..3).find(|&c| face.vertices[c] != a && face.vertices[c] != b)?] = 0.0;
        let span = self.span(a, b);
        let (attachment, point) = match span {
            Some(s) => {
                let arc = &self.surface.network().arcs[s.arc];
                let t = arc.normalise(0.5 * (s.from + s.to));
                (Attachment::Arc { arc: s.arc, t }, arc.point(self.surface.topology(), t))
            }
            None => (Attachment::Sheet(face.sheet), self.map.locate(face.map, weights)),
        };
        let m = self.add_vertex(attachment, point, sides.contains(&None));
        self.lengths.remove(&[a.min(b), a.max(b)]);
        // The middle of an edge is the same point in every layout, so any layout will do.
        let [pa, pb, pc] = [DVec2::ZERO, DVec2::X, DVec2::Y];
        let pm = pa.midpoint(pb);
        let halved = |(f, c): (FaceId, VertexId), a: VertexId, b: VertexId| Edit {
            old: vec![(f, [a, b, c], [pa, pb, pc])],
            new: vec![([a, m, c], [pa, pm, pc]), ([m, b, c], [pm, pb, pc])],
        };
        let edits = [sides[0].map(|side| halved(side, a, b)), sides[1].map(|side| halved(side, b, a))];
        if !self.replace_anyway(&edits.into_iter().flatten().collect::<Vec<_>>()) {
            return None;
        }
        if let Some(s) = span {
            let middle = 0.5 * (s.from + s.to);
            self.region.spans.remove(&[a.min(b), a.max(b)]);
            self.region.insert_span(a, m, ArcSpan { to: middle, ..s });
            self.region.insert_span(m, b, ArcSpan { from: middle, ..s });
        }
        self.n_vertices += 1;
        Some(m)
    }

    /// Puts a vertex in the middle of a face. `None` when there is no such face.
    pub(crate) fn split_face(&mut self, face: [VertexId; 3]) -> Option<VertexId> {
        let id = self.find_face(face)?;
        let Face { sheet, map, .. } = self.face(id)?;
        let point = self.map.locate(map, DVec3::splat(1.0 / 3.0));
        let m = self.add_vertex(Attachment::Sheet(sheet), point, false);
        // The middle of a triangle is the same point in every layout, so any layout will do.
        let flat = [DVec2::ZERO, DVec2::X, DVec2::Y];
        let middle = flat.iter().sum::<DVec2>() / 3.0;
        let part = |i: usize| ([face[i], face[(i + 1) % 3], m], [flat[i], flat[(i + 1) % 3], middle]);
        if !self.replace_anyway(&[Edit { old: vec![(id, face, flat)], new: vec![part(0), part(1), part(2)] }]) {
            return None;
        }
        self.n_vertices += 1;
        Some(m)
    }

    fn add_vertex(&mut self, attachment: Attachment, point: SurfacePoint, on_border: bool) -> VertexId {
        self.on_border.push(on_border);
        self.region.attachments.push(attachment);
        self.region.points.push(point);
        self.star.push(Vec::new());
        self.positions.push(point.position(self.surface.mesh()))
    }
}
