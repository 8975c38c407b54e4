//! Better connectivity for the base mesh, by edits that the base map records.

use crate::BaseOptions;
use crate::editor::Editor;
use glam::DVec3;
use mesh_core::VertexId;
use region_map::Attachment;

/// Brings the number of vertices to the request and the triangles nearer to equilateral.
pub(crate) fn improve(editor: &mut Editor<'_>, options: &BaseOptions) {
    for _ in 0..options.rounds {
        let flips = flip_edges(editor);
        if flips == 0 {
            break;
        }
    }
}

/// One pass of flips over all edges; returns how many were made.
fn flip_edges(editor: &mut Editor<'_>) -> usize {
    let mut flips = 0;
    for [a, b] in editor.edges() {
        if editor.is_edge(a, b) && flip_gain(editor, a, b) > LEAST_GAIN && editor.flip(a, b) {
            flips += 1;
        }
    }
    flips
}

/// Flips must gain this much, or rounding could make them cycle.
const LEAST_GAIN: f64 = 1e-6;
/// Cost of one edge too many or too few at a vertex, in units of the shape cost of a triangle.
const VALENCE_COST: f64 = 0.12;

/// What the cost falls by when the edge is flipped; negative infinity where it can't be.
fn flip_gain(editor: &Editor<'_>, a: VertexId, b: VertexId) -> f64 {
    let [Some(c), Some(d)] = editor.opposite(a, b) else { return f64::NEG_INFINITY };
    if editor.span(a, b).is_some() || c == d || editor.is_edge(c, d) || editor.valence(a) <= 3 || editor.valence(b) <= 3 {
        return f64::NEG_INFINITY;
    }
    let p = |v| editor.position(v);
    let before = pair_cost([p(a), p(b), p(c)], [p(b), p(a), p(d)]);
    let after = pair_cost([p(a), p(d), p(c)], [p(d), p(b), p(c)]);
    let valences = |shift: i32| -> f64 {
        let at = |v: VertexId, shift: i32| (editor.valence(v) as f64 + f64::from(shift) - ideal_valence(editor, v)).powi(2);
        at(a, -shift) + at(b, -shift) + at(c, shift) + at(d, shift)
    };
    before - after + VALENCE_COST * (valences(0) - valences(1))
}

/// Inverse mean ratios of two neighbouring triangles, and their fold: 2 for a flat pair of equilateral ones.
fn pair_cost(s: [DVec3; 3], t: [DVec3; 3]) -> f64 {
    let fold = 1.0 - mesh_core::normal(s).dot(mesh_core::normal(t));
    inverse_mean_ratio(s) + inverse_mean_ratio(t) + 2.0 * fold
}

/// `(a^2 + b^2 + c^2) / (4 sqrt3 A)`, capped so that one needle does not outweigh all.
fn inverse_mean_ratio([a, b, c]: [DVec3; 3]) -> f64 {
    let edges = a.distance_squared(b) + b.distance_squared(c) + c.distance_squared(a);
    let ratio = edges / (4.0 * 3f64.sqrt() * mesh_core::area([a, b, c]));
    if ratio.is_finite() { ratio.min(100.0) } else { 100.0 }
}

/// The number of edges that divides the angle round a vertex into steps of 60 degrees.
fn ideal_valence(editor: &Editor<'_>, v: VertexId) -> f64 {
    match editor.attachment(v) {
        Attachment::Sheet(_) => 6.0,
        _ => {
            let angle: f64 = editor
                .faces_at(v)
                .map(|f| {
                    let c = f.iter().position(|&w| w == v).unwrap_or(0);
                    mesh_core::angles(f.map(|w| editor.position(w)))[c]
                })
                .sum();
            angle / 60f64.to_radians() + f64::from(editor.ring(v).is_some_and(|r| !r.closed))
        }
    }
}
