//! The shortest way between two vertices over the free part of a cut mesh, near a straight line (A*).

use crate::cut_mesh::CutMesh;
use glam::DVec3;
use rustc_hash::FxHashMap;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A stop of a path: a vertex, or one of the points spread over an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Node {
    Vertex(u32),
    /// Point `step` (from 1) of those on the edge between two vertices, the lower first.
    OnEdge([u32; 2], u8),
}

/// An end of a path: the vertex, and the pieces at it that the path may run through.
pub(crate) struct End {
    pub(crate) vertex: u32,
    pub(crate) sector: Vec<u32>,
}

/// What being off the line costs: at one line length off, a way counts this much more.
const STRAIGHTNESS: f64 = 30.0;
/// Most points on an edge.
const MOST_STEPS: f64 = 7.0;

/// Finds a path from one end to the other that crosses no wall and runs through no taken vertex. Points on edges are about
/// `spacing` apart, and every edge has one at least: so there is a path wherever there is a way.
pub(crate) fn shortest(mesh: &CutMesh, from: &End, to: &End, spacing: f64) -> Option<Vec<Node>> {
    let search = Search { mesh, from, to, spacing, line: [from.vertex, to.vertex].map(|v| mesh.positions[v as usize]) };
    search.run()
}

struct Search<'a> {
    mesh: &'a CutMesh,
    from: &'a End,
    to: &'a End,
    spacing: f64,
    line: [DVec3; 2],
}

impl Search<'_> {
    fn run(&self) -> Option<Vec<Node>> {
        let (start, goal) = (Node::Vertex(self.from.vertex), Node::Vertex(self.to.vertex));
        let mut best: FxHashMap<Node, (f64, Node)> = FxHashMap::default();
        best.insert(start, (0.0, start));
        let mut queue = BinaryHeap::from([(Reverse(0u64), Reverse(start), 0u64)]);
        while let Some((_, Reverse(node), bits)) = queue.pop() {
            if node == goal {
                return Some(self.back(&best, goal));
            }
            let cost = f64::from_bits(bits);
            if best.get(&node).is_some_and(|b| cost > b.0) {
                continue;
            }
            let at = self.position(node);
            for next in self.next(node) {
                let to = self.position(next);
                let cost = cost + self.cost(at, to);
                if best.get(&next).is_none_or(|b| cost < b.0) {
                    best.insert(next, (cost, node));
                    let estimate = cost + to.distance(self.line[1]);
                    queue.push((Reverse(estimate.to_bits()), Reverse(next), cost.to_bits()));
                }
            }
        }
        None
    }

    fn back(&self, best: &FxHashMap<Node, (f64, Node)>, goal: Node) -> Vec<Node> {
        let mut path = vec![goal];
        let mut at = goal;
        while let Some(&(_, before)) = best.get(&at).filter(|b| b.1 != at) {
            path.push(before);
            at = before;
        }
        path.reverse();
        path
    }

    /// The length of a straight step, more the further it is from the line.
    fn cost(&self, a: DVec3, b: DVec3) -> f64 {
        let [from, to] = self.line;
        let middle = a.midpoint(b);
        let off = middle.distance(from.lerp(to, mesh_core::closest_on_segment(middle, from, to)));
        let scale = from.distance(to).max(self.spacing);
        a.distance(b) * (1.0 + STRAIGHTNESS * (off / scale).powi(2))
    }

    fn position(&self, node: Node) -> DVec3 {
        let at = |v: u32| self.mesh.positions[v as usize];
        match node {
            Node::Vertex(v) => at(v),
            Node::OnEdge([a, b], step) => at(a).lerp(at(b), share(self.mesh, [a, b], step, self.spacing)),
        }
    }

    /// All nodes on the pieces beside a node.
    fn next(&self, node: Node) -> Vec<Node> {
        let mesh = self.mesh;
        let pieces = match node {
            Node::Vertex(v) if v == self.from.vertex => self.from.sector.clone(),
            Node::Vertex(v) => mesh.fan(v),
            Node::OnEdge([a, b], _) => [mesh.left(a, b), mesh.left(b, a)].into_iter().flatten().collect(),
        };
        let mut next = Vec::new();
        for piece in pieces {
            let vertices = mesh.pieces[piece as usize].vertices;
            for c in 0..3 {
                let v = vertices[c];
                let is_goal = v == self.to.vertex && self.to.sector.contains(&piece);
                if is_goal || !mesh.taken[v as usize] {
                    next.push(Node::Vertex(v));
                }
                let (a, b) = (v, vertices[(c + 1) % 3]);
                let ends = [a.min(b), a.max(b)];
                let own = match node {
                    Node::Vertex(w) => w == a || w == b,
                    Node::OnEdge(edge, _) => edge == ends,
                };
                if !own && !mesh.is_wall(a, b) {
                    next.extend((1..=steps(mesh, ends, self.spacing)).map(|step| Node::OnEdge(ends, step)));
                }
            }
        }
        next
    }
}

/// The number of points on an edge.
fn steps(mesh: &CutMesh, [a, b]: [u32; 2], spacing: f64) -> u8 {
    let [a, b] = [a, b].map(|v| mesh.positions[v as usize]);
    (a.distance(b) / spacing).round().clamp(1.0, MOST_STEPS) as u8
}

/// How far along its edge a point is, 0 to 1.
fn share(mesh: &CutMesh, ends: [u32; 2], step: u8, spacing: f64) -> f64 {
    f64::from(step) / f64::from(steps(mesh, ends, spacing) + 1)
}

/// Cuts the mesh along a path and makes it a wall; the vertices along it. `None` where it meets itself.
pub(crate) fn lay(mesh: &mut CutMesh, path: &[Node], spacing: f64) -> Option<Vec<u32>> {
    // Where points are hangs on the mesh before the first cut.
    let share = |node: &Node| match *node {
        Node::Vertex(_) => 0.0,
        Node::OnEdge(ends, step) => share(mesh, ends, step, spacing),
    };
    let shares: Vec<f64> = path.iter().map(share).collect();
    let mut vertices = Vec::with_capacity(path.len());
    for (node, s) in path.iter().zip(shares) {
        vertices.push(match *node {
            Node::Vertex(v) => v,
            Node::OnEdge([a, b], _) => mesh.cut(a, b, s)?,
        });
    }
    for pair in vertices.windows(2) {
        if !mesh.joined(pair[0], pair[1]) {
            return None;
        }
        mesh.wall(pair[0], pair[1]);
    }
    Some(vertices)
}
