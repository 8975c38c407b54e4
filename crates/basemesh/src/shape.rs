//! What an edit would do to the shape of the base triangles.

use crate::editor::Editor;
use glam::DVec3;
use mesh_core::VertexId;
use region_map::Attachment;

/// Cost of one edge too many or too few at a vertex, in units of the shape cost of a triangle.
const VALENCE_COST: f64 = 0.12;
/// Cost of a right angle between two neighbouring triangles off the creases.
const FOLD_COST: f64 = 2.0;
/// Cap on the shape cost, so that one needle does not outweigh all.
const WORST_SHAPE: f64 = 100.0;

/// Length of an edge, on an arc that of its span.
pub(crate) fn spread(editor: &Editor<'_>, [a, b]: [VertexId; 2]) -> f64 {
    match editor.span(a, b) {
        Some(span) => (span.to - span.from).abs(),
        None => editor.position(a).distance(editor.position(b)),
    }
}

/// What the cost falls by when the edge is flipped; negative infinity where it can't be.
pub(crate) fn flip_gain(editor: &Editor<'_>, a: VertexId, b: VertexId) -> f64 {
    let [Some(c), Some(d)] = editor.opposite(a, b) else { return f64::NEG_INFINITY };
    if editor.span(a, b).is_some() || c == d || editor.is_edge(c, d) || editor.valence(a) <= 3 || editor.valence(b) <= 3 {
        return f64::NEG_INFINITY;
    }
    let p = |v| editor.position(v);
    let before = pair_cost([p(a), p(b), p(c)], [p(b), p(a), p(d)]);
    let after = pair_cost([p(a), p(d), p(c)], [p(d), p(b), p(c)]);
    let excess = |v: VertexId, shift: f64| (editor.valence(v) as f64 + shift - ideal_valence(editor, v)).powi(2);
    let valences = |shift: f64| excess(a, -shift) + excess(b, -shift) + excess(c, shift) + excess(d, shift);
    before - after + VALENCE_COST * (valences(0.0) - valences(1.0))
}

/// Inverse mean ratios of two neighbouring triangles and their fold: 2 for a flat pair of equilateral ones.
fn pair_cost(s: [DVec3; 3], t: [DVec3; 3]) -> f64 {
    let fold = 1.0 - mesh_core::normal(s).dot(mesh_core::normal(t));
    inverse_mean_ratio(s) + inverse_mean_ratio(t) + FOLD_COST * fold
}

/// `(a^2 + b^2 + c^2) / (4 sqrt3 A)`, 1 for an equilateral triangle.
fn inverse_mean_ratio([a, b, c]: [DVec3; 3]) -> f64 {
    let edges = a.distance_squared(b) + b.distance_squared(c) + c.distance_squared(a);
    let ratio = edges / (4.0 * 3f64.sqrt() * mesh_core::area([a, b, c]));
    if ratio.is_finite() { ratio.min(WORST_SHAPE) } else { WORST_SHAPE }
}

/// The number of edges that divides the angle round a vertex into steps of 60 degrees.
fn ideal_valence(editor: &Editor<'_>, v: VertexId) -> f64 {
    if let Attachment::Sheet(_) = editor.attachment(v) {
        return 6.0;
    }
    let angle_in = |f: [VertexId; 3]| {
        let c = f.iter().position(|&w| w == v).unwrap_or(0);
        mesh_core::angles(f.map(|w| editor.position(w)))[c]
    };
    let angle: f64 = editor.faces_at(v).map(angle_in).sum();
    angle / 60f64.to_radians() + f64::from(editor.ring(v).is_some_and(|r| !r.closed))
}

/// The triangles that a collapse would leave.
pub(crate) struct CollapsedShape {
    /// Least quality (AR) among them, 0 for one that is turned against the one it replaces.
    pub(crate) quality: f64,
    /// Least quality among those that are there now.
    pub(crate) quality_before: f64,
    /// Longest edge among them.
    pub(crate) longest: f64,
}

/// What collapsing `from` into `to` would leave; `None` where there is no such edge.
pub(crate) fn collapsed_shape(editor: &Editor<'_>, from: VertexId, to: VertexId) -> Option<CollapsedShape> {
    if !editor.is_edge(from, to) {
        return None;
    }
    let target = editor.position(to);
    let mut shape = CollapsedShape { quality: 1.0, quality_before: 1.0, longest: 0.0 };
    for face in editor.faces_at(from) {
        let now = face.map(|v| editor.position(v));
        shape.quality_before = shape.quality_before.min(mesh_core::aspect_ratio(now));
        if face.contains(&to) {
            continue;
        }
        let then = face.map(|v| if v == from { target } else { editor.position(v) });
        let turned = mesh_core::normal(now).dot(mesh_core::normal(then)) < 0.3;
        shape.quality = shape.quality.min(if turned { 0.0 } else { mesh_core::aspect_ratio(then) });
        for v in face {
            shape.longest = shape.longest.max(target.distance(editor.position(v)));
        }
    }
    Some(shape)
}
