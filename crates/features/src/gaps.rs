//! Gaps between creases that are too narrow for any triangle: they are closed.
//!
//! Where a crease passes another one closer than [`GAP`], the sheet between them would have to go through. All triangles that do are needles there,
//! and more often than not some of them are folded on any base mesh: a result that is refused for them as a whole.

use crate::crease::{Kinds, is_on_network};
use mesh_core::{HalfedgeId, Topology, TriMesh, VertexId, distance_to_segment};
use region_map::{ArcKind, spokes};
use std::collections::BTreeSet;

/// Creases that are closer than this touch, in base edge lengths: an edge of the third level is a hundred times as long. More moves creases farther.
const GAP: f64 = 0.00125;
/// Where the creases hang together within this length, in base edge lengths, they may bend or be the rims of a strip, and no gap is closed there.
const APART: f64 = 0.1;

/// Closes the narrow gaps between creases: where only one face is between a crease and a vertex of another one, the crease runs along the other two
/// sides of the face, through that vertex. Tells whether there was a gap.
pub(crate) fn close_gaps(mesh: &TriMesh, topology: &Topology, kinds: &mut Kinds, base_edge_length: f64) -> bool {
    let mut has_closed = false;
    for f in topology.faces().ids() {
        let across = topology.halfedges(f).map(|h| (h, topology.edge(h)));
        let mut on_network = across.iter().filter(|(_, e)| kinds[*e].is_some());
        let (Some(&(h, crease)), None) = (on_network.next(), on_network.next()) else { continue };
        let tip = topology.opposite(h);
        if kinds[crease] == Some(ArcKind::Sharp)
            && height(mesh, topology, h) < GAP * base_edge_length
            && is_on_network(topology, kinds, tip)
            && !are_joined(mesh, topology, kinds, [tip, topology.from(h)], APART * base_edge_length)
        {
            across.iter().for_each(|&(_, e)| kinds[e] = Some(ArcKind::Sharp));
            kinds[crease] = None;
            has_closed = true;
        }
    }
    has_closed
}

/// How far the corner across an edge is from it.
fn height(mesh: &TriMesh, topology: &Topology, h: HalfedgeId) -> f64 {
    let [tip, a, b] = [topology.opposite(h), topology.from(h), topology.to(h)].map(|v| mesh.position(v));
    distance_to_segment(tip, a, b)
}

/// Whether the network leads from one vertex to another on a way that goes nowhere farther than some length from where it begins.
fn are_joined(mesh: &TriMesh, topology: &Topology, kinds: &Kinds, [from, to]: [VertexId; 2], reach: f64) -> bool {
    let (mut open, mut reached) = (vec![from], BTreeSet::from([from]));
    while let Some(v) = open.pop() {
        if v == to {
            return true;
        }
        let steps = spokes(topology, v).filter(|&h| kinds[topology.edge(h)].is_some());
        let ends = steps.flat_map(|h| [topology.from(h), topology.to(h)]);
        open.extend(ends.filter(|&w| mesh.distance(from, w) <= reach && reached.insert(w)));
    }
    false
}
