//! Better connectivity for the base mesh, by edits that the base map records.
//!
//! Isotropic remeshing (Botsch and Kobbelt, *A remeshing approach to multiresolution modeling*, 2004) in the map: split long edges,
//! collapse short ones, flip, move vertices to the middle of their neighbours. What the patches of the segmentation left in the base
//! mesh (rows of vertices along smooth arcs, thin patches without an inner vertex) is gone after a few rounds. Then single splits and
//! collapses meet the wanted number of vertices.

use crate::BaseOptions;
use crate::editor::Editor;
use crate::shape::{collapsed_shape, flip_gain, is_ear};
use mesh_core::VertexId;
use region_map::Sizing;

/// Edges longer than this many wanted lengths are split, shorter than [`SHORT`] collapsed (Botsch and Kobbelt's figures: then
/// neither makes work for the other).
const LONG: f64 = 4.0 / 3.0;
/// See [`LONG`].
const SHORT: f64 = 4.0 / 5.0;
/// Moves of all vertices in a round.
const MOVES: usize = 2;
/// Quality (AR) that a collapse must leave, unless it was worse before.
const LEAST_QUALITY: f64 = 0.25;
/// Flips must gain this much, or rounding could make them cycle.
const LEAST_GAIN: f64 = 1e-6;
/// Passes of flips after a round; most need two or three.
const FLIP_PASSES: usize = 6;
/// A pass that closes less than this share of the gap to the wanted number of vertices is the last: corners and arcs don't allow
/// more.
const LEAST_PROGRESS: f64 = 0.05;

/// Brings the number of vertices to the request, as far as corners and arcs allow, and the triangles nearer to equilateral, with
/// edges as long as the sizing field says.
pub(crate) fn improve(editor: &mut Editor<'_>, sizing: &Sizing, options: &BaseOptions) {
    if options.rounds == 0 {
        return;
    }
    // eq. 3, then adapted: on a curved surface, along creases and with a sizing field the count at a length is not known before.
    let mut length = (2.0 * editor.surface_area() / (3f64.sqrt() * options.base_vertices.max(4) as f64)).sqrt();
    flip_edges(editor);
    for _ in 0..options.rounds {
        split_long(editor, sizing, LONG * length);
        collapse_short(editor, sizing, SHORT * length, LONG * length);
        settle(editor);
        let ratio = editor.n_vertices() as f64 / options.base_vertices as f64;
        length *= ratio.sqrt().clamp(0.8, 1.25);
    }
    cut_ears(editor);
    meet_count(editor, sizing, options.base_vertices);
    cut_ears(editor);
}

/// Cuts the ears that flips could not take away: at the edge off the arcs, or where there is none (a disk inside a small loop) at a
/// new vertex inside.
fn cut_ears(editor: &mut Editor<'_>) {
    for face in editor.faces() {
        if !is_ear(editor, face) || !editor.is_face(face) {
            continue;
        }
        let sides = [0, 1, 2].map(|i| [face[i], face[(i + 1) % 3]]);
        match sides.into_iter().find(|&[a, b]| editor.span(a, b).is_none()) {
            Some([a, b]) => editor.split(a, b),
            None => editor.split_face(face),
        };
    }
    flip_edges(editor);
}

/// Flips and moves until neither gains much.
fn settle(editor: &mut Editor<'_>) {
    for _ in 0..MOVES {
        flip_edges(editor);
        for v in editor.vertices() {
            editor.relax_vertex(v);
        }
    }
    flip_edges(editor);
}

/// Passes of flips until none gains: the first over all edges, the others round the flips of the one before.
fn flip_edges(editor: &mut Editor<'_>) {
    let mut edges = editor.edges();
    for _ in 0..FLIP_PASSES {
        let mut changed = Vec::new();
        for [a, b] in edges {
            let quad = editor.faces_beside(a, b).into_iter().flatten().flat_map(|(f, _)| f.vertices);
            if flip_gain(editor, a, b) > LEAST_GAIN && editor.flip(a, b) {
                changed.extend(quad);
            }
        }
        changed.sort_unstable();
        changed.dedup();
        edges = editor.edges_near(&changed);
    }
}

/// Edges with their lengths over what the sizing field says, the longest first.
fn by_length(editor: &Editor<'_>, sizing: &Sizing) -> Vec<(f64, [VertexId; 2])> {
    let relative =
        |[a, b]: [VertexId; 2]| editor.surface_length(a, b) / (0.5 * (editor.size(sizing, a) + editor.size(sizing, b)));
    let mut edges: Vec<_> = editor.edges().into_iter().map(|e| (relative(e), e)).collect();
    edges.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    edges
}

fn split_long(editor: &mut Editor<'_>, sizing: &Sizing, limit: f64) {
    for (length, [a, b]) in by_length(editor, sizing) {
        if length > limit && editor.is_edge(a, b) {
            editor.split(a, b);
        }
    }
}

fn collapse_short(editor: &mut Editor<'_>, sizing: &Sizing, limit: f64, longest: f64) {
    for (length, [a, b]) in by_length(editor, sizing).into_iter().rev() {
        if length < limit && editor.is_edge(a, b) {
            collapse_edge(editor, a, b, longest * editor.size(sizing, a).min(editor.size(sizing, b)));
        }
    }
}

/// Collapses an edge the way that leaves the better triangles, if these are good enough and no edge longer than `longest`.
fn collapse_edge(editor: &mut Editor<'_>, a: VertexId, b: VertexId, longest: f64) -> bool {
    let mut ways: Vec<(f64, VertexId, VertexId)> = [(a, b), (b, a)]
        .into_iter()
        .filter_map(|(from, to)| {
            let shape = collapsed_shape(editor, from, to)?;
            let allowed = shape.longest <= longest && shape.quality >= LEAST_QUALITY.min(shape.quality_before);
            allowed.then_some((shape.quality, from, to))
        })
        .collect();
    ways.sort_by(|x, y| y.0.total_cmp(&x.0));
    ways.into_iter().any(|(_, from, to)| editor.collapse(from, to))
}

/// Splits the longest and collapses the shortest edges until the number of vertices is the one wanted.
fn meet_count(editor: &mut Editor<'_>, sizing: &Sizing, wanted: usize) {
    while editor.n_vertices() != wanted {
        let before = editor.n_vertices();
        if before < wanted {
            for (_, [a, b]) in by_length(editor, sizing).into_iter().take((wanted - before).div_ceil(2)) {
                if editor.is_edge(a, b) && editor.n_vertices() < wanted {
                    editor.split(a, b);
                }
            }
        } else {
            for (_, [a, b]) in by_length(editor, sizing).into_iter().rev() {
                if editor.is_edge(a, b) && editor.n_vertices() > wanted {
                    collapse_edge(editor, a, b, f64::INFINITY);
                }
            }
        }
        settle(editor);
        let gap = |n: usize| n.abs_diff(wanted) as f64;
        if gap(editor.n_vertices()) > (1.0 - LEAST_PROGRESS) * gap(before) {
            return;
        }
    }
}
