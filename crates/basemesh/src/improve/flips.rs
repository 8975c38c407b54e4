//! Flips and moves: better triangles with as many vertices.

use super::shape::{IdealValences, flip_gain, is_folded};
use crate::editor::Editor;
use mesh_core::VertexId;

/// Moves of all vertices in a round.
const MOVES: usize = 2;
/// Flips must gain this much, or rounding could make them cycle.
const LEAST_GAIN: f64 = 1e-6;
/// A flip may not make an edge that is longer on the surface than so many times its chord, unless the old one was.
const MOST_DETOUR: f64 = 1.5;
/// Passes of flips after a round; most need two or three.
const FLIP_PASSES: usize = 6;

/// Flips and moves until neither gains much.
pub(crate) fn settle(editor: &mut Editor<'_>) {
    for _ in 0..MOVES {
        flip_edges(editor);
        for v in editor.vertices() {
            if editor.is_interrupted() {
                return;
            }
            if !editor.relax_vertex(v) {
                editor.slide_vertex(v);
            }
        }
    }
    flip_edges(editor);
}

/// Passes of flips until none gains: the first over all edges, the others round the flips of the one before.
pub(crate) fn flip_edges(editor: &mut Editor<'_>) {
    let all = editor.edges();
    flip(editor, all);
}

/// The same, with a first pass over the edges of the faces at some vertices.
pub(crate) fn flip_near(editor: &mut Editor<'_>, vertices: &[VertexId]) {
    let near = editor.edges_near(vertices);
    flip(editor, near);
}

fn flip(editor: &mut Editor<'_>, mut edges: Vec<[VertexId; 2]>) {
    let mut ideal = IdealValences::default();
    for _ in 0..FLIP_PASSES {
        let mut changed = Vec::new();
        for [a, b] in edges {
            if editor.is_interrupted() {
                return;
            }
            if flip_gain(editor, &mut ideal, a, b) > LEAST_GAIN {
                ideal.forget(editor, a, b);
                changed.extend(flip_unless_it_winds(editor, a, b).into_iter().flatten());
            }
        }
        changed.sort_unstable();
        changed.dedup();
        edges = editor.edges_near(&changed);
    }
}

/// Flips an edge, unless the new one is much longer on the surface than its chord: across a thin limb the chord may be short while the
/// edge goes all the way round, and the map then winds round the limb. Returns the corners of the two faces if it was flipped.
fn flip_unless_it_winds(editor: &mut Editor<'_>, a: VertexId, b: VertexId) -> Option<[VertexId; 4]> {
    let [Some((_, c)), Some((_, d))] = editor.faces_beside(a, b) else { return None };
    let before = editor.detour(a, b);
    let mends = is_folded(editor, [a, b, c]) || is_folded(editor, [b, a, d]);
    if !editor.flip(a, b) {
        return None;
    }
    if !mends && editor.detour(c, d) > before.max(MOST_DETOUR) {
        editor.flip(c, d);
        return None;
    }
    Some([a, b, c, d])
}
