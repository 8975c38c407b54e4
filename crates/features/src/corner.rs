//! Corners that the degree of a vertex does not show: sharp turns along a chain, and the tips of cones.

use crate::crease::{Kinds, is_on_network};
use mesh_core::{IdVec, Topology, TriMesh, VertexId, angles};
use region_map::{Arc, Network};
use std::f64::consts::TAU;

/// A chain that turns by more than this has a corner, in degrees. A smaller angle puts corners on rounded borders, a greater one cuts true corners off.
const TURN: f64 = 60.0;
/// How far from a vertex its turn is measured, in base edge lengths: far enough to see past the zigzag of a fine scan.
const WINDOW: f64 = 0.25;
/// The window is at most this share of its arc, so that the two windows at a vertex do not reach round a closed arc.
const WINDOW_SHARE: f64 = 0.25;
/// A turn that is nearer to the end of its arc than this, in base edge lengths, is part of the corner there: the base edge between the two would make
/// needles.
const BESIDE_END: f64 = 0.0125;
/// At a true corner half the window sees at least this share of the turn; on a circle it sees one half.
const CONCENTRATION: f64 = 0.75;
/// Least angle defect of a cone tip, in radians: a cone whose sides stand 65 degrees off its axis has 0.6.
const TIP_DEFECT: f64 = 0.6;
/// The vertices around the tip of a cone have at most this share of its angle defect; in scan noise they have as much.
const TIP_NEIGHBOURS: f64 = 0.15;

/// Vertices where an arc turns sharply, the sharpest one within a window.
pub(crate) fn sharp_turns(mesh: &TriMesh, network: &Network, base_edge_length: f64) -> Vec<VertexId> {
    network.arcs.iter().flat_map(|arc| turns_of(mesh, arc, base_edge_length)).collect()
}

fn turns_of(mesh: &TriMesh, arc: &Arc, base_edge_length: f64) -> Vec<VertexId> {
    let n = arc.halfedges.len();
    let window = (WINDOW * base_edge_length).min(WINDOW_SHARE * arc.length());
    let is_inside = |&i: &usize| {
        let to_end = arc.lengths[i].min(arc.length() - arc.lengths[i]);
        arc.is_loop() || (i > 0 && to_end >= BESIDE_END * base_edge_length)
    };
    let inner = (0..n).filter(is_inside);
    let turns: Vec<(usize, f64)> = inner
        .filter_map(|i| {
            let [half, full] = [0.5 * window, window].map(|w| turn_at(mesh, arc, i, w));
            (full > TURN && half >= CONCENTRATION * full).then_some((i, full))
        })
        .collect();
    let distance = |i: usize, j: usize| {
        let d = (arc.lengths[i] - arc.lengths[j]).abs();
        if arc.is_loop() { d.min(arc.length() - d) } else { d }
    };
    let beaten = |&(i, turn): &(usize, f64)| {
        turns.iter().any(|&(j, other)| i != j && distance(i, j) < window && (other > turn || (other == turn && j < i)))
    };
    turns.iter().filter(|t| !beaten(t)).map(|&(i, _)| arc.vertices[i]).collect()
}

/// The angle in degrees by which an arc turns at its vertex `i`, between the chords to the points `window` before and after;
/// along the two edges when they are longer.
fn turn_at(mesh: &TriMesh, arc: &Arc, i: usize, window: f64) -> f64 {
    let n = arc.halfedges.len();
    let at = arc.lengths[i];
    let before = if i == 0 { arc.lengths[n] - arc.lengths[n - 1] } else { at - arc.lengths[i - 1] };
    let after = arc.lengths[i + 1] - at;
    let here = mesh.position(arc.vertices[i]);
    let back = here - arc.position(mesh, at - window.max(before));
    let ahead = arc.position(mesh, at + window.max(after)) - here;
    back.cross(ahead).length().atan2(back.dot(ahead)).to_degrees()
}

/// Vertices off the network whose angle defect is large and stands alone.
pub(crate) fn cone_tips(mesh: &TriMesh, topology: &Topology, kinds: &Kinds) -> Vec<VertexId> {
    let defect = angle_defects(mesh, topology);
    let on_network = |v: VertexId| is_on_network(topology, kinds, v);
    let alone =
        |v: VertexId| topology.one_ring(v).filter(|&w| !on_network(w)).all(|w| defect[w].abs() <= TIP_NEIGHBOURS * defect[v]);
    defect.ids().filter(|&v| defect[v] >= TIP_DEFECT && !on_network(v) && alone(v)).collect()
}

/// A full turn less the angles of the faces at each vertex; 0 for a vertex without faces.
fn angle_defects(mesh: &TriMesh, topology: &Topology) -> IdVec<VertexId, f64> {
    let mut sums = IdVec::filled(0.0, topology.n_vertices());
    for f in mesh.faces().ids() {
        for (v, angle) in mesh.face(f).into_iter().zip(angles(mesh.triangle(f))) {
            sums[v] += angle;
        }
    }
    sums.iter().map(|&sum| if sum > 0.0 { TAU - sum } else { 0.0 }).collect()
}
