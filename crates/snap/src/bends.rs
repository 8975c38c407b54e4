//! Bends of arcs that the edges along them cut off.

use crate::SnapOptions;
use mesh_core::VertexId;
use region_map::{Arc, ArcSpan, Surface};
use std::collections::BTreeMap;

/// An arc is as good as straight between the ends of an edge when it leaves the edge by less than this share of the arc length
/// between them. On a circle that is an arc of 14 degrees.
const LEAST_SHARE: f64 = 0.03;

/// For every edge on an arc that leaves it by too much, the vertex of the arc that is farthest from the edge; the worst first.
pub(crate) fn bends(surface: &Surface, spans: &BTreeMap<[VertexId; 2], ArcSpan>, options: &SnapOptions) -> Vec<VertexId> {
    let allowed = options.bend * surface.mesh().diagonal();
    let cut_off = |span: &ArcSpan| {
        let (off, vertex) = farthest(surface, &surface.network().arcs[span.arc], span)?;
        (off > allowed && off > LEAST_SHARE * (span.to - span.from).abs()).then_some((off, vertex))
    };
    let mut found: Vec<(f64, VertexId)> = spans.values().filter_map(cut_off).collect();
    found.sort_by(|(a, v), (b, w)| b.total_cmp(a).then(v.cmp(w)));
    found.into_iter().map(|(_, vertex)| vertex).collect()
}

/// The vertex inside a span that is farthest from its chord, with its distance.
fn farthest(surface: &Surface, arc: &Arc, span: &ArcSpan) -> Option<(f64, VertexId)> {
    let [a, b] = [span.from, span.to].map(|t| arc.position(surface.mesh(), t));
    let off = |v: VertexId| mesh_core::distance_to_segment(surface.mesh().position(v), a, b);
    let inside =
        arc.vertices.iter().zip(&arc.lengths).filter(|&(_, &t)| within(arc, span, t).is_some_and(|s| s > 0.0 && s < 1.0));
    inside.map(|(&v, _)| (off(v), v)).max_by(|(a, v), (b, w)| a.total_cmp(b).then(w.cmp(v)))
}

/// How far along a span the arc length `t` lies, 0 to 1; `None` when it lies outside. On a loop all its rounds count.
pub(crate) fn within(arc: &Arc, span: &ArcSpan, t: f64) -> Option<f64> {
    let rounds = if arc.is_loop() { [-arc.length(), 0.0, arc.length()] } else { [0.0; 3] };
    rounds.into_iter().map(|round| (t + round - span.from) / (span.to - span.from)).find(|s| (0.0..=1.0).contains(s))
}
