//! Better connectivity for the base mesh, by edits that the base map records.
//!
//! Isotropic remeshing (Botsch and Kobbelt, *A remeshing approach to multiresolution modeling*, 2004) in the map: split long edges,
//! collapse short ones, flip, move vertices to the middle of their neighbours. What the patches of the segmentation left in the base
//! mesh (rows of vertices along smooth arcs, thin patches without an inner vertex) is gone after a few rounds. Then single splits and
//! collapses meet the wanted number of vertices.

use crate::editor::Editor;
use crate::shape::{collapsed_shape, flip_gain, is_ear, is_folded};
use crate::{BaseError, BaseOptions};
use mesh_core::{VertexId, equilateral_edge_length};
use region_map::{BaseCounts, BaseMesh, Sizing, Surface};

/// Edges longer than this many wanted lengths are split, shorter than [`SHORT`] collapsed (Botsch and Kobbelt's figures: then
/// neither makes work for the other).
const LONG: f64 = 4.0 / 3.0;
/// See [`LONG`].
const SHORT: f64 = 4.0 / 5.0;
/// Edges get longer by at most this factor from one round of collapses to the next.
const COARSENING: f64 = 1.2;
/// Moves of all vertices in a round.
const MOVES: usize = 2;
/// Quality (AR) that a collapse must leave, unless it was worse before.
const LEAST_QUALITY: f64 = 0.25;
/// Flips must gain this much, or rounding could make them cycle.
const LEAST_GAIN: f64 = 1e-6;
/// Flips don't make edges longer than so many times their chord.
const MOST_DETOUR: f64 = 1.5;
/// A few folds come and go; with more than this many beyond twice the fewest the rounds end.
const MANY_FOLDED: usize = 10;
/// Passes of flips after a round; most need two or three.
const FLIP_PASSES: usize = 6;
/// A triangle of lower quality (AR) in a base mesh from elsewhere is a needle. Vertices that are off the surface can end up side by
/// side on it (block's QEM base of 524 vertices: 2e-5 of a mean edge apart).
const NEEDLE: f64 = 0.01;
/// Passes over the ears of a base mesh from elsewhere.
const EAR_ROUNDS: usize = 10;
/// Moves of the vertices of needles.
const NEEDLE_ROUNDS: usize = 5;
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
    let area = editor.surface_area();
    let mean_length = |n: usize| equilateral_edge_length(area, n.max(4));
    let mut length = mean_length(options.base_vertices);
    flip_edges(editor);
    // From many vertices down in small steps: a star of twenty triangles has no flat layout that is like it.
    let mut start = mean_length(editor.n_vertices());
    while start < length / COARSENING {
        start *= COARSENING;
        collapse_short(editor, sizing, SHORT * start, LONG * start);
        settle(editor);
        collapse_folded(editor);
    }
    let mut best = (usize::MAX, editor.clone());
    for _ in 0..options.rounds {
        split_long(editor, sizing, LONG * length);
        collapse_short(editor, sizing, SHORT * length, LONG * length);
        settle(editor);
        collapse_folded(editor);
        let ratio = editor.n_vertices() as f64 / options.base_vertices as f64;
        length *= ratio.sqrt().clamp(0.8, 1.25);
        // Where the wanted edges are too long for the shape, folds breed folds: then what was before is better.
        let folded = n_folded(editor);
        if folded <= best.0 {
            best = (folded, editor.clone());
        } else if folded > 2 * best.0 + MANY_FOLDED {
            break;
        }
    }
    *editor = best.1;
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

/// What was mended in a base mesh from elsewhere.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mended {
    /// Triangles with two edges on arcs that go on nearly straight at their common vertex: their subdivisions end in a triangle without
    /// area there. They were taken away by flips, or where those do not help by splits.
    pub ears: usize,
    /// Vertices of needles that were moved inside their sheet.
    pub moved: usize,
}

/// Mends what would end in triangles without area, and nothing else: see [`Mended`].
pub fn mend(surface: &Surface<'_>, base: BaseMesh) -> Result<(BaseMesh, Mended), BaseError> {
    let counts = base.counts.clone();
    let mut editor = Editor::new(surface, base)?;
    let mut mended = Mended::default();
    // A flip can leave the next ear of a row.
    for _ in 0..EAR_ROUNDS {
        let before = mended.ears;
        for face in editor.faces() {
            if editor.is_face(face) && is_ear(&editor, face) {
                mend_ear(&mut editor, face);
                mended.ears += 1;
            }
        }
        if mended.ears == before {
            break;
        }
    }
    for _ in 0..NEEDLE_ROUNDS {
        let quality = |f: &[VertexId; 3]| mesh_core::aspect_ratio(f.map(|v| editor.position(v)));
        let mut crowded: Vec<VertexId> = editor.faces().into_iter().filter(|f| quality(f) < NEEDLE).flatten().collect();
        crowded.sort_unstable();
        crowded.dedup();
        mended.moved = mended.moved.max(crowded.into_iter().filter(|&v| editor.relax_vertex(v)).count());
    }
    let mut base = editor.finish()?;
    base.counts = BaseCounts { made: base.mesh.n_vertices(), ..counts };
    Ok((base, mended))
}

fn mend_ear(editor: &mut Editor<'_>, face: [VertexId; 3]) {
    let sides = [0, 1, 2].map(|i| [face[i], face[(i + 1) % 3]]);
    match sides.into_iter().find(|&[a, b]| editor.span(a, b).is_none()) {
        Some([a, b]) if flip_gain(editor, a, b) > LEAST_GAIN && editor.flip(a, b) => {}
        Some([a, b]) => {
            editor.split(a, b);
        }
        None => {
            editor.split_face(face);
        }
    }
}

/// Flips and moves until neither gains much.
fn settle(editor: &mut Editor<'_>) {
    for _ in 0..MOVES {
        flip_edges(editor);
        for v in editor.vertices() {
            if !editor.relax_vertex(v) {
                editor.slide_vertex(v);
            }
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
            if flip_gain(editor, a, b) > LEAST_GAIN {
                changed.extend(flip_unless_it_winds(editor, a, b).into_iter().flatten());
            }
        }
        changed.sort_unstable();
        changed.dedup();
        edges = editor.edges_near(&changed);
    }
}

/// Flips an edge, but not to one that takes a detour on the surface: round a limb, the chord may be short where the edge goes the other
/// way, and triangles that look well wind up there. Returns the corners of the two faces if it was flipped.
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

/// Collapses edges of faces that face against the surface, where that leaves none that does. Left alone, such a place would grow: its
/// edges wind, are split for their length, and wind all the more.
fn collapse_folded(editor: &mut Editor<'_>) {
    for face in editor.faces() {
        if !editor.is_face(face) || !is_folded(editor, face) {
            continue;
        }
        let sides = [0, 1, 2].map(|i| (face[i], face[(i + 1) % 3])).into_iter();
        let mut ways: Vec<(f64, VertexId, VertexId)> = sides
            .flat_map(|(a, b)| [(a, b), (b, a)])
            .filter_map(|(from, to)| Some((collapsed_shape(editor, from, to)?.quality, from, to)))
            .filter(|way| way.0 > 0.0)
            .collect();
        ways.sort_by(|x, y| y.0.total_cmp(&x.0));
        ways.into_iter().any(|(_, from, to)| editor.collapse(from, to));
    }
    flip_edges(editor);
}

fn n_folded(editor: &Editor<'_>) -> usize {
    editor.faces().into_iter().filter(|&f| is_folded(editor, f)).count()
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
