//! A path becomes a wall: pulled straight over the edges that it crosses, and cut into the mesh.

use crate::cut_mesh::CutMesh;
use crate::path::{Node, share};
use glam::DVec3;
use rustc_hash::FxHashSet;

/// A path keeps this share of an edge away from its ends: later paths need room beside it.
const MARGIN: f64 = 0.05;
/// Passes in which the points of a path are moved, one after the other, to make it shorter.
const SWEEPS: usize = 20;

/// A piece that a path runs through twice: it cannot be laid there.
pub(crate) fn piece_met_twice(mesh: &CutMesh, path: &[Node]) -> Option<u32> {
    let mut met = FxHashSet::default();
    path.windows(2).filter_map(|step| piece_between(mesh, step[0], step[1])).find(|&piece| !met.insert(piece))
}

/// The piece that a step runs through, `None` for one along an edge.
fn piece_between(mesh: &CutMesh, a: Node, b: Node) -> Option<u32> {
    let ([x, y], other) = match (a, b) {
        (Node::OnEdge(edge, _), other) | (other, Node::OnEdge(edge, _)) => (edge, other),
        _ => return None,
    };
    let ends = match other {
        Node::Vertex(v) => [v, v],
        Node::OnEdge(ends, _) => ends,
    };
    let holds = |&piece: &u32| ends.iter().all(|v| mesh.pieces()[piece as usize].vertices.contains(v));
    [mesh.left(x, y), mesh.left(y, x)].into_iter().flatten().find(holds)
}

/// Cuts the mesh along a path and makes it a wall; the vertices along it. `None` where it meets a piece twice.
pub(crate) fn lay(mesh: &mut CutMesh, path: &[Node], spacing: f64) -> Option<Vec<u32>> {
    let shares = straightened(mesh, path, spacing);
    let mut vertices = Vec::with_capacity(path.len());
    for (node, s) in path.iter().zip(shares) {
        vertices.push(match *node {
            Node::Vertex(v) => v,
            Node::OnEdge([a, b], _) => mesh.cut(a, b, s)?,
        });
    }
    for pair in vertices.windows(2) {
        if !mesh.are_joined(pair[0], pair[1]) {
            return None;
        }
        mesh.wall(pair[0], pair[1]);
    }
    Some(vertices)
}

/// Where a path of the least length crosses each of its edges, 0 to 1 along the edge; 0 for vertices.
fn straightened(mesh: &CutMesh, path: &[Node], spacing: f64) -> Vec<f64> {
    let edges: Vec<[DVec3; 2]> = path
        .iter()
        .map(|node| match *node {
            Node::Vertex(v) => [mesh.positions()[v as usize]; 2],
            Node::OnEdge(ends, _) => ends.map(|v| mesh.positions()[v as usize]),
        })
        .collect();
    let first = |node: &Node| match *node {
        Node::Vertex(_) => 0.0,
        Node::OnEdge(ends, step) => share(mesh, ends, step, spacing),
    };
    let mut shares: Vec<f64> = path.iter().map(first).collect();
    let at = |i: usize, s: f64| edges[i][0].lerp(edges[i][1], s);
    for _ in 0..SWEEPS {
        for i in 1..path.len().saturating_sub(1) {
            if let Node::OnEdge(..) = path[i] {
                shares[i] = crossing(edges[i], at(i - 1, shares[i - 1]), at(i + 1, shares[i + 1])).unwrap_or(shares[i]);
            }
        }
    }
    shares
}

/// Where the shortest way from `p` to `q` across an edge meets the edge: it is a straight line when both triangles are unfolded into one
/// plane.
fn crossing([a, b]: [DVec3; 2], p: DVec3, q: DVec3) -> Option<f64> {
    let along = b - a;
    let foot = |x: DVec3| along.dot(x - a) / along.length_squared();
    let off = |x: DVec3, s: f64| x.distance(a + s * along);
    let (s, t) = (foot(p), foot(q));
    let (d, e) = (off(p, s), off(q, t));
    let crossing = (s * e + t * d) / (d + e);
    crossing.is_finite().then(|| crossing.clamp(MARGIN, 1.0 - MARGIN))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_line_crosses_where_the_unfolded_one_does() {
        let edge = [DVec3::new(-1.0, 0.0, 0.0), DVec3::new(3.0, 0.0, 0.0)];
        // 2 and 1 off the edge, on sides that meet at a right angle: two thirds of the way from one foot to the other.
        let (p, q) = (DVec3::new(0.0, 2.0, 0.0), DVec3::new(1.5, 0.0, 1.0));
        let s = crossing(edge, p, q).unwrap();
        assert!((edge[0].lerp(edge[1], s).x - 1.0).abs() < 1e-12);
        assert_eq!(crossing(edge, p, DVec3::new(9.0, -1.0, 0.0)), Some(1.0 - MARGIN));
        assert_eq!(crossing([p, p], p, q), None);
    }
}
