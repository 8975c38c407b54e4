//! Cuts minor creases in pieces that a path of edges can follow.

use crate::SnapOptions;
use mesh_core::{EdgeId, TriMesh, VertexId};
use region_map::{SheetId, Surface};

/// Where a crease turns by more than this (degrees), it turns back.
const TURN_BACK: f64 = 110.0;

/// A part of a minor crease between two vertices that shall be taken by vertices of the domain.
#[derive(Clone, Debug)]
pub(crate) struct Piece {
    /// Vertices of the working mesh in order.
    pub(crate) vertices: Vec<VertexId>,
    /// The edges between them.
    pub(crate) edges: Vec<EdgeId>,
    /// The sheet that it lies in.
    pub(crate) sheet: SheetId,
    /// Its length.
    pub(crate) length: f64,
}

impl Piece {
    /// The vertices that it begins and ends with. It has an edge at least.
    pub(crate) fn ends(&self) -> [VertexId; 2] {
        [self.vertices[0], self.vertices[self.vertices.len() - 1]]
    }
}

/// The pieces of a minor crease, of those of its edges that are kept, that edges of this length can follow.
pub(crate) fn pieces(
    surface: &Surface,
    chain: &[VertexId],
    edge_length: f64,
    is_kept: impl Fn(EdgeId) -> bool,
    options: &SnapOptions,
) -> Vec<Piece> {
    let breaks = breaks(surface, chain, options);
    let uncut = breaks.windows(2).map(|ends| &chain[ends[0]..=ends[1]]);
    let is_kept = |v: &[VertexId]| surface.topology().find_edge(v[0], v[1]).is_some_and(&is_kept);
    let pieces: Vec<Piece> = uncut.flat_map(|part| runs(part, is_kept)).filter_map(|run| piece(surface, &run)).collect();
    let can_follow = |i: usize| {
        let piece = &pieces[i];
        let turns: f64 = piece.vertices.windows(3).map(|v| turn(surface.mesh(), v)).sum();
        piece.length >= options.least_length * edge_length
            && turns * edge_length <= options.most_turn * piece.length
            && !is_turned_back(surface, &pieces, i)
    };
    (0..pieces.len()).filter(|&i| can_follow(i)).map(|i| pieces[i].clone()).collect()
}

/// Does the chain turn back between this piece and a longer one beside it? Both would leave a needle between them.
fn is_turned_back(surface: &Surface, pieces: &[Piece], i: usize) -> bool {
    let turns_back = |first: &Piece, second: &Piece| {
        let (a, b) = (&first.vertices, &second.vertices);
        a.last() == b.first() && turn(surface.mesh(), &[a[a.len() - 2], b[0], b[1]]) > TURN_BACK
    };
    let longer = |j: usize| (pieces[j].length, i) > (pieces[i].length, j);
    (i > 0 && longer(i - 1) && turns_back(&pieces[i - 1], &pieces[i]))
        || (i + 1 < pieces.len() && longer(i + 1) && turns_back(&pieces[i], &pieces[i + 1]))
}

fn piece(surface: &Surface, vertices: &[VertexId]) -> Option<Piece> {
    let edges: Vec<EdgeId> = vertices.windows(2).map(|w| surface.topology().find_edge(w[0], w[1])).collect::<Option<_>>()?;
    let sheet = surface.network().sheet_of_face[surface.topology().edge_faces(*edges.first()?).0];
    Some(Piece { vertices: vertices.to_vec(), edges, sheet, length: surface.mesh().chain_length(vertices) })
}

/// Where the chain is cut: at its ends, sharp turns and meetings with arcs, and a closed one in three at least.
fn breaks(surface: &Surface, chain: &[VertexId], options: &SnapOptions) -> Vec<usize> {
    let Some(last) = chain.len().checked_sub(1) else { return Vec::new() };
    let is_break =
        |&i: &usize| turn(surface.mesh(), &chain[i - 1..=i + 1]) > options.sharp_turn || touches_arc(surface, chain[i]);
    let mut breaks: Vec<usize> = (1..last).filter(is_break).collect();
    if chain.first() == chain.last() && breaks.len() < 2 {
        breaks.extend([last / 3, 2 * last / 3]);
    }
    breaks.extend([0, last]);
    breaks.sort_unstable();
    breaks.dedup();
    breaks
}

/// By how many degrees a chain of three vertices turns.
fn turn(mesh: &TriMesh, chain: &[VertexId]) -> f64 {
    let way = |i: usize| mesh.position(chain[i + 1]) - mesh.position(chain[i]);
    way(0).angle_between(way(1)).to_degrees()
}

fn touches_arc(surface: &Surface, v: VertexId) -> bool {
    let (topology, network) = (surface.topology(), surface.network());
    network.corner_of_vertex[v].is_some()
        || topology.fan(v).any(|h| network.is_barrier(topology.edge(h)) || network.is_barrier(topology.edge(h.prev())))
}

/// The longest parts of a chain all of whose edges are kept.
pub(crate) fn runs(chain: &[VertexId], keep: impl Fn(&[VertexId]) -> bool) -> Vec<Vec<VertexId>> {
    let mut runs: Vec<Vec<VertexId>> = Vec::new();
    for edge in chain.windows(2).filter(|edge| keep(edge)) {
        match runs.last_mut() {
            Some(run) if run.last() == edge.first() => run.push(edge[1]),
            _ => runs.push(edge.to_vec()),
        }
    }
    runs
}
