//! Lengths of edges on the surface.

use super::mesh::Editor;
use glam::DVec3;
use mesh_core::VertexId;
use rayon::prelude::*;

/// An edge counts as at most this many times as long as its chord: half a circle over its diameter.
const LONGEST_DETOUR: f64 = 2.5;
/// Steps in which the length of an edge is measured on the surface.
const LENGTH_STEPS: usize = 4;

impl Editor<'_> {
    /// Length on the surface of what the map makes of an edge, on an arc that of its span. A chord would not see a limb that the
    /// edge cuts off; but where the map itself winds, splitting the edge would only wind it more, so the detour is bounded.
    pub(crate) fn surface_length(&self, a: VertexId, b: VertexId) -> f64 {
        self.lengths.get(&[a.min(b), a.max(b)]).copied().unwrap_or_else(|| self.measured_length(a, b))
    }
    /// Bounds of the length of an edge on the surface. They take no time, and neither does the length itself on an arc.
    pub(crate) fn length_bounds(&self, a: VertexId, b: VertexId) -> [f64; 2] {
        let chord = self.positions[a].distance(self.positions[b]);
        if self.span(a, b).is_some() { [0.0, f64::INFINITY] } else { [chord, LONGEST_DETOUR * chord] }
    }
    /// Edges with their lengths on the surface, which are kept.
    pub(crate) fn with_lengths(&mut self, edges: Vec<[VertexId; 2]>) -> Vec<([VertexId; 2], f64)> {
        let lengths: Vec<_> = edges.into_par_iter().map(|[a, b]| ([a, b], self.surface_length(a, b))).collect();
        self.lengths.extend(lengths.iter().copied());
        lengths
    }
    fn measured_length(&self, a: VertexId, b: VertexId) -> f64 {
        if let Some(span) = self.span(a, b) {
            return (span.to - span.from).abs();
        }
        let Some((face, corner)) = self.star[a].iter().find_map(|&f| {
            let face = self.face(f)?;
            Some((face, [face.corner(a)?, face.corner(b)?]))
        }) else {
            return 0.0;
        };
        let along = |i: usize| {
            let s = i as f64 / LENGTH_STEPS as f64;
            let mut weights = DVec3::ZERO;
            (weights[corner[0]], weights[corner[1]]) = (1.0 - s, s);
            self.map.locate(face.map, weights).position(self.surface.mesh())
        };
        let inner = (1..LENGTH_STEPS).map(along).chain([self.positions[b]]);
        let length = inner.fold((0.0, self.positions[a]), |(sum, last), p| (sum + last.distance(p), p)).0;
        length.min(LONGEST_DETOUR * self.positions[a].distance(self.positions[b]))
    }
    /// Length of an edge on the surface over that of its chord, at most [`LONGEST_DETOUR`].
    pub(crate) fn detour(&self, a: VertexId, b: VertexId) -> f64 {
        self.surface_length(a, b) / self.positions[a].distance(self.positions[b]).max(f64::MIN_POSITIVE)
    }
}
