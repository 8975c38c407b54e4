//! Better connectivity for a base mesh, by edits that its map records.
//!
//! Isotropic remeshing (Botsch and Kobbelt, *A remeshing approach to multiresolution modeling*, 2004) in the map: split long edges,
//! collapse short ones, flip, move vertices to the middle of their neighbours. What the patches of the segmentation left in the base
//! mesh (rows of vertices along smooth arcs, thin patches without an inner vertex) is gone after a few rounds. Then single splits and
//! collapses meet the wanted number of vertices.

mod delaunay;
mod flips;
mod shape;
mod straight_corners;

use crate::editor::{Checkpoint, Editor, Filling, Hole, Removal};
use crate::{BaseError, BaseOptions};
use delaunay::delaunay_flips;
use flips::{flip_edges, flip_near, settle};
use mesh_core::{VertexId, equilateral_edge_length};
use region_map::{BaseMesh, Sizing, Surface};
use rustc_hash::FxHashSet;
#[cfg(test)]
pub(crate) use shape::has_straight_corner;
pub(crate) use shape::is_folded;
use std::ops::Range;
pub(crate) use straight_corners::open_straight_corners;

/// Edges longer than this many wanted lengths are split, shorter than [`SHORT`] collapsed (Botsch and Kobbelt's figures: then
/// neither makes work for the other).
const LONG: f64 = 4.0 / 3.0;
/// See [`LONG`].
const SHORT: f64 = 4.0 / 5.0;
/// Edges get longer by at most this factor from one round of collapses to the next.
const COARSENING: f64 = 1.2;
/// Once edges have this share of the wanted length, each round of collapses is followed by moves of the vertices; before, by flips alone.
const NEAR: f64 = 0.8;
/// Quality (AR) that a collapse must leave, unless it was worse before.
const LEAST_QUALITY: f64 = 0.25;
/// Where a greater share of the faces is folded after a round, each further round folds more of them, and makes more faces. Measured: a lamp
/// of 4,400 vertices took 308 s to no better end than the 1 s that it takes now.
const MOST_FOLDED: f64 = 0.1;
/// So many vertices too many or too few are as bad as one folded face.
const FOLD_WORTH: usize = 10;
/// Where corners and arcs need more vertices than asked, the other edges get longer by at most this factor to make up for it.
const MOST_STRETCHED: f64 = 1.6;
/// The wanted length is adapted to the count by at most this factor from one round to the next, or it would swing.
const MOST_ADAPTED: f64 = 1.25;
/// Splitting stops at so many vertices, or at [`SPLIT_TIMES`] those wanted: where a sizing field asks for edges that are far too short,
/// each round would make four times the faces of the one before. No mesh that was measured comes near to it.
const MOST_SPLIT: usize = 10_000;
/// See [`MOST_SPLIT`].
const SPLIT_TIMES: usize = 30;
/// When a pass of splits or collapses closes less than this share of the gap to the wanted number of vertices, it is the last: corners
/// and arcs don't allow more.
const LEAST_PROGRESS: f64 = 0.05;

/// A first base mesh with better connectivity, and with the number of vertices that is asked for, as far as that can be.
pub(crate) fn improved(
    surface: &Surface,
    first: BaseMesh,
    sizing: &Sizing,
    options: &BaseOptions,
) -> Result<BaseMesh, BaseError> {
    let mut editor = Editor::new(surface, first);
    improve(&mut editor, sizing, options);
    editor.finish()
}

/// A first base mesh with the same vertices and, but for the edges that are `fixed` (ends rising), Delaunay by the lengths of its edges.
pub(crate) fn made_delaunay(surface: &Surface, first: BaseMesh, fixed: &FxHashSet<[VertexId; 2]>) -> Result<BaseMesh, BaseError> {
    let mut editor = Editor::new(surface, first);
    delaunay_flips(&mut editor, |edge| fixed.contains(&edge));
    editor.finish()
}

/// Brings the number of vertices to the request, as far as corners and arcs allow, and the triangles nearer to equilateral, with
/// edges as long as the sizing field says.
fn improve(editor: &mut Editor<'_>, sizing: &Sizing, options: &BaseOptions) {
    if options.rounds == 0 {
        return;
    }
    // eq. 3, then adapted: on a curved surface, along creases and with a sizing field the count at a length is not known before.
    let length = mean_length(editor, options.base_vertices);
    flip_edges(editor);
    coarsen(editor, sizing, length);
    editor.close_gaps();
    best_of_rounds(editor, sizing, options, length);
    open_straight_corners(editor);
    flip_edges(editor);
    meet_count(editor, sizing, options.base_vertices);
    open_straight_corners(editor);
    flip_edges(editor);
}

/// The length of the edges of `n` equilateral triangles that cover the surface.
fn mean_length(editor: &Editor<'_>, n: usize) -> f64 {
    equilateral_edge_length(editor.surface_area(), n.max(4))
}

/// Comes from many vertices down to edges of about this length in small steps: a star of twenty triangles has no flat layout that is
/// like it.
fn coarsen(editor: &mut Editor<'_>, sizing: &Sizing, length: f64) {
    let mut start = mean_length(editor, editor.n_vertices());
    while start < length / COARSENING && !editor.is_interrupted() {
        start *= COARSENING;
        collapse_short(editor, sizing, SHORT * start, LONG * start);
        // Far from the wanted length the moves of one step are undone by the next.
        if start < NEAR * length {
            flip_edges(editor);
        } else {
            settle(editor);
        }
        collapse_folded(editor);
    }
}

/// Splits, collapses, flips and moves round after round, with a length that is adapted to the count, and keeps the best round.
fn best_of_rounds(editor: &mut Editor<'_>, sizing: &Sizing, options: &BaseOptions, mut length: f64) {
    let mut best: Option<(usize, Checkpoint)> = None;
    let longest_wanted = MOST_STRETCHED * length;
    let most_vertices = MOST_SPLIT.max(SPLIT_TIMES * options.base_vertices).max(2 * editor.n_vertices());
    for _ in 0..options.rounds {
        if editor.is_interrupted() {
            return;
        }
        split_long(editor, sizing, LONG * length, most_vertices);
        collapse_short(editor, sizing, SHORT * length, LONG * length);
        settle(editor);
        collapse_folded(editor);
        let ratio = editor.n_vertices() as f64 / options.base_vertices as f64;
        length = (length * ratio.sqrt().clamp(1.0 / MOST_ADAPTED, MOST_ADAPTED)).min(longest_wanted);
        // Where the wanted edges are too long for the shape, each round folds more faces: then an earlier round is better.
        let folded = n_folded(editor);
        let cost = FOLD_WORTH * folded + editor.n_vertices().abs_diff(options.base_vertices);
        if best.as_ref().is_none_or(|(least, _)| cost <= *least) {
            best = Some((cost, editor.checkpoint()));
        }
        if folded as f64 > MOST_FOLDED * editor.faces().len() as f64 {
            break;
        }
    }
    if let Some((_, best)) = best {
        editor.restore(best);
    }
}

/// Edges with their lengths over what the sizing field says, the longest first: at least those with one in `range`.
fn by_length(editor: &mut Editor<'_>, sizing: &Sizing, range: Range<f64>) -> Vec<(f64, [VertexId; 2])> {
    let wanted = |editor: &Editor<'_>, [a, b]: [VertexId; 2]| 0.5 * (editor.size(sizing, a) + editor.size(sizing, b));
    let mut edges = editor.edges();
    edges.retain(|&[a, b]| {
        let ([least, most], wanted) = (editor.length_bounds(a, b), wanted(editor, [a, b]));
        least <= range.end * wanted && most >= range.start * wanted
    });
    let lengths = editor.with_lengths(edges);
    let mut edges: Vec<_> = lengths.into_iter().map(|(e, length)| (length / wanted(editor, e), e)).collect();
    edges.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    edges
}

/// Splits edges longer than `limit`, the longest first, until there are `most_vertices`.
fn split_long(editor: &mut Editor<'_>, sizing: &Sizing, limit: f64, most_vertices: usize) {
    for (length, [a, b]) in by_length(editor, sizing, limit..f64::INFINITY) {
        if editor.n_vertices() >= most_vertices || editor.is_interrupted() {
            return;
        }
        if length > limit && editor.is_edge(a, b) {
            editor.split(a, b);
        }
    }
}

fn collapse_short(editor: &mut Editor<'_>, sizing: &Sizing, limit: f64, longest: f64) {
    for (length, [a, b]) in by_length(editor, sizing, 0.0..limit).into_iter().rev() {
        if editor.is_interrupted() {
            return;
        }
        if length < limit && editor.is_edge(a, b) {
            collapse_edge(editor, a, b, longest * editor.size(sizing, a).min(editor.size(sizing, b)));
        }
    }
}

/// Takes vertices of faces that face against the surface away, where that leaves none that does. Left alone, such a place would grow: its
/// edges wind, are split for their length, and wind all the more.
fn collapse_folded(editor: &mut Editor<'_>) {
    let mut changed = Vec::new();
    for face in editor.faces() {
        if !editor.is_face(face) || !is_folded(editor, face) {
            continue;
        }
        let holes = face.map(|v| editor.hole(v));
        let ways: Vec<_> = holes.iter().flatten().map(|hole| (hole, Filling::Cheapest)).collect();
        let around = editor.edges_near(&face);
        if take_best(editor, &ways, |removal| removal.quality > 0.0) {
            changed.extend(around.into_iter().flatten());
        }
    }
    flip_near(editor, &changed);
}

fn n_folded(editor: &Editor<'_>) -> usize {
    editor.faces().into_iter().filter(|&f| is_folded(editor, f)).count()
}

/// Takes one end of an edge away, if the triangles then are good enough and no edge is longer than `longest`.
fn collapse_edge(editor: &mut Editor<'_>, a: VertexId, b: VertexId, longest: f64) -> bool {
    let is_good = |r: &Removal<'_>| r.longest <= longest && r.quality >= LEAST_QUALITY.min(r.hole.quality);
    let holes: Vec<_> = [(a, b), (b, a)].into_iter().filter_map(|(v, into)| Some((editor.hole(v)?, into))).collect();
    let holes: Vec<_> = holes.iter().filter(|(hole, _)| hole.longest <= longest).collect();
    let fans: Vec<_> = holes.iter().map(|(hole, into)| (hole, Filling::Fan(*into))).collect();
    let cheapest: Vec<_> = holes.iter().map(|(hole, _)| (hole, Filling::Cheapest)).collect();
    take_best(editor, &fans, is_good) || take_best(editor, &cheapest, is_good)
}

/// Takes a vertex away in that one of some ways that leaves the best triangles, if it may be. False when none could be taken.
fn take_best(editor: &mut Editor<'_>, ways: &[(&Hole, Filling<'_>)], may_be: impl Fn(&Removal<'_>) -> bool) -> bool {
    let removals = ways.iter().filter_map(|&(hole, filling)| editor.removal(hole, filling));
    let mut removals: Vec<Removal<'_>> = removals.filter(may_be).collect();
    removals.sort_by(|a, b| b.quality.total_cmp(&a.quality));
    removals.iter().any(|removal| editor.take_away(removal))
}

/// Splits the longest and collapses the shortest edges until the number of vertices is the one wanted.
fn meet_count(editor: &mut Editor<'_>, sizing: &Sizing, wanted: usize) {
    while editor.n_vertices() != wanted && !editor.is_interrupted() {
        let before = editor.n_vertices();
        if before < wanted {
            for (_, [a, b]) in by_length(editor, sizing, 0.0..f64::INFINITY).into_iter().take((wanted - before).div_ceil(2)) {
                if editor.is_edge(a, b) && editor.n_vertices() < wanted && !editor.is_interrupted() {
                    editor.split(a, b);
                }
            }
        } else {
            for (_, [a, b]) in by_length(editor, sizing, 0.0..f64::INFINITY).into_iter().rev() {
                if editor.is_edge(a, b) && editor.n_vertices() > wanted && !editor.is_interrupted() {
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
