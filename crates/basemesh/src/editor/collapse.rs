//! Collapses: a vertex goes to one of its neighbours.

use super::{Edit, Editor};
use crate::layout::{are_unfolded, full_star, half_star};
use crate::star::{Ring, side_between};
use glam::{DVec2, DVec3};
use mesh_core::VertexId;
use region_map::{ArcSpan, Attachment};

impl Editor<'_> {
    /// Takes `v` away and joins its neighbours to `u`, which must be one of them. A vertex on an arc only moves along the arc, a
    /// corner never. False when the result were no simplicial mesh.
    pub(crate) fn collapse(&mut self, v: VertexId, u: VertexId) -> bool {
        let Some(ring) = self.ring(v) else { return false };
        match self.attachment(v) {
            Attachment::Corner(_) => false,
            Attachment::Sheet(_) => ring.closed && self.collapse_inside(v, u, &ring),
            Attachment::Arc { .. } => self.collapse_along(v, u, &ring),
        }
    }

    fn collapse_inside(&mut self, v: VertexId, u: VertexId, ring: &Ring) -> bool {
        let n = ring.vertices.len();
        let Some(start) = ring.vertices.iter().position(|&w| w == u) else { return false };
        // The neighbours but those beside u get an edge to u.
        if n < 4 || (2..n - 1).any(|i| self.is_edge(u, ring.vertices[(start + i) % n])) {
            return false;
        }
        let order = |i: usize| (start + i) % n;
        let fan = |p: &[DVec2]| -> Vec<[DVec2; 3]> { (1..n - 1).map(|i| [p[order(0)], p[order(i)], p[order(i + 1)]]).collect() };
        let positions: Vec<DVec3> = ring.vertices.iter().map(|&w| self.positions[w]).collect();
        let flat = full_star(self.positions[v], &positions, |p| are_unfolded(&fan(p)));
        let old: Vec<_> = (0..n)
            .map(|i| {
                (ring.faces[i], [v, ring.vertices[i], ring.vertices[(i + 1) % n]], [DVec2::ZERO, flat[i], flat[(i + 1) % n]])
            })
            .collect();
        let corners = (1..n - 1).map(|i| [u, ring.vertices[order(i)], ring.vertices[order(i + 1)]]);
        let new: Vec<_> = corners.zip(fan(&flat)).collect();
        let done = self.replace(&old, &new);
        self.n_vertices -= usize::from(done);
        done
    }

    /// Collapses along an arc: both sides of it are laid out on their own, with the arc straight and by arc length.
    fn collapse_along(&mut self, v: VertexId, u: VertexId, ring: &Ring) -> bool {
        let along: Vec<VertexId> = ring.vertices.iter().copied().filter(|&w| self.span(v, w).is_some()).collect();
        let w = match along[..] {
            [a, b] if a == u => b,
            [a, b] if b == u => a,
            _ => return false,
        };
        let (Some(to_u), Some(to_w)) = (self.span(v, u), self.span(v, w)) else { return false };
        if self.is_edge(u, w) {
            return false;
        }
        let mut sides = Vec::new();
        for (first, last) in [(u, w), (w, u)] {
            let Some(side) = side_between(ring, first, last) else { continue };
            let inner = &side.vertices[1..side.vertices.len() - 1];
            // u gets an edge to all on this side but w and its own neighbour.
            let skip = if first == u { 0 } else { inner.len().saturating_sub(1) };
            if inner.is_empty() || inner.iter().enumerate().any(|(i, &x)| i != skip && self.is_edge(u, x)) {
                return false;
            }
            sides.push((side, first == u));
        }
        if let [(a, _), (b, _)] = &sides[..]
            && a.vertices[1..a.vertices.len() - 1].iter().any(|x| b.vertices[1..b.vertices.len() - 1].contains(x))
        {
            return false;
        }
        let (mut old, mut new) = (Vec::new(), Vec::new());
        for (side, starts_at_u) in &sides {
            let edit = self.side_edit(v, u, side, *starts_at_u, (to_u.to - to_u.from).abs(), (to_w.to - to_w.from).abs());
            let Some((o, n)) = edit else { return false };
            old.push(o);
            new.push(n);
        }
        for (o, n) in old.iter().zip(&new) {
            if !self.replace(o, n) {
                debug_assert!(false, "a layout that was checked is refused");
                return false;
            }
        }
        self.region.spans.remove(&[v.min(u), v.max(u)]);
        self.region.spans.remove(&[v.min(w), v.max(w)]);
        self.region.insert_span(u, w, ArcSpan { arc: to_u.arc, from: to_u.to, to: to_u.from + to_w.to - to_w.from });
        self.n_vertices -= 1;
        true
    }

    /// The edit of one side of an arc when `v` goes to `u`.
    fn side_edit(&self, v: VertexId, u: VertexId, side: &Ring, starts_at_u: bool, to_u: f64, to_w: f64) -> Option<Edit> {
        let n = side.vertices.len();
        let positions: Vec<DVec3> = side.vertices.iter().map(|&w| self.positions[w]).collect();
        let apex = if starts_at_u { 0 } else { n - 1 };
        let gaps = if starts_at_u { 1..n - 1 } else { 0..n - 2 };
        let fan = |p: &[DVec2]| -> Vec<[DVec2; 3]> { gaps.clone().map(|i| [p[apex], p[i], p[i + 1]]).collect() };
        let spokes = |p: &[DVec2]| -> Vec<[DVec2; 3]> { (0..n - 1).map(|i| [DVec2::ZERO, p[i], p[i + 1]]).collect() };
        let (ahead, behind) = if starts_at_u { (to_u, to_w) } else { (to_w, to_u) };
        let flat = half_star(self.positions[v], &positions, ahead, behind, |p| are_unfolded(&fan(p)) && are_unfolded(&spokes(p)));
        let faces = side.faces.iter().zip(side.vertices.windows(2)).zip(spokes(&flat));
        let old: Vec<_> = faces.map(|((&f, w), p)| (f, [v, w[0], w[1]], p)).collect();
        let new: Vec<_> = gaps.clone().map(|i| [u, side.vertices[i], side.vertices[i + 1]]).zip(fan(&flat)).collect();
        let valid = |t: &[DVec2; 3]| mesh_core::exact::orient2d(t[0], t[1], t[2]) > 0.0;
        (old.iter().all(|o| valid(&o.2)) && new.iter().all(|n| valid(&n.1))).then_some((old, new))
    }
}
