//! Chains of marked edges between corners: what arcs are made of, in the network and in the cells.

use mesh_core::{EdgeId, HalfedgeId, IdVec, Topology, TriMesh, VertexId};

/// A chain of edges from one corner to the next, or closed without one.
pub(crate) struct Chain {
    /// Vertices in order; a closed chain ends with its first vertex.
    pub(crate) vertices: Vec<VertexId>,
    /// For every edge its lower halfedge.
    pub(crate) halfedges: Vec<HalfedgeId>,
}

impl Chain {
    /// Arc length up to every vertex.
    pub(crate) fn lengths(&self, mesh: &TriMesh) -> Vec<f64> {
        let mut lengths = vec![0.0];
        for pair in self.vertices.windows(2) {
            lengths.push(lengths[lengths.len() - 1] + mesh.distance(pair[0], pair[1]));
        }
        lengths
    }
}

/// One halfedge for each edge at a vertex, counter-clockwise; none at a vertex without faces.
///
/// They start at the vertex, but for the last one at a border vertex: that edge has no halfedge out of the vertex, so the one into it
/// stands for it.
pub fn spokes(topology: &Topology, v: VertexId) -> impl Iterator<Item = HalfedgeId> + '_ {
    let last = topology.fan(v).last().map(HalfedgeId::prev).filter(|&h| topology.twin(h).is_none());
    topology.fan(v).chain(last)
}

/// Splits the marked edges into chains: from every corner in vertex order, then the closed ones that have none.
pub(crate) fn trace_chains(
    topology: &Topology,
    is_marked: impl Fn(EdgeId) -> bool,
    is_corner: impl Fn(VertexId) -> bool,
) -> Vec<Chain> {
    let mut used = IdVec::<EdgeId, bool>::filled(false, topology.n_edges());
    let mut chains = Vec::new();
    let vertices = || (0..topology.n_vertices() as u32).map(VertexId);
    for v in vertices().filter(|&v| is_corner(v)).chain(vertices()) {
        let starts: Vec<EdgeId> = spokes(topology, v).map(|h| topology.edge(h)).filter(|&e| is_marked(e)).collect();
        for edge in starts {
            if !used[edge] {
                chains.push(follow(topology, v, edge, &is_marked, &is_corner, &mut used));
            }
        }
    }
    chains
}

/// Follows marked edges from `start` over `edge` to the next corner, or round to `start`.
fn follow(
    topology: &Topology,
    start: VertexId,
    mut edge: EdgeId,
    is_marked: impl Fn(EdgeId) -> bool,
    is_corner: impl Fn(VertexId) -> bool,
    used: &mut IdVec<EdgeId, bool>,
) -> Chain {
    let mut chain = Chain { vertices: vec![start], halfedges: Vec::new() };
    let mut at = start;
    loop {
        used[edge] = true;
        chain.halfedges.push(topology.halfedge(edge));
        let [a, b] = topology.ends(edge);
        at = if a == at { b } else { a };
        chain.vertices.push(at);
        if at == start || is_corner(at) {
            return chain;
        }
        match spokes(topology, at).map(|h| topology.edge(h)).find(|&e| is_marked(e) && !used[e]) {
            Some(next) => edge = next,
            None => return chain,
        }
    }
}
