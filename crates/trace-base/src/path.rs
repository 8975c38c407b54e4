//! The shortest path between two vertices over the free part of a cut mesh, near to a given way (A*).

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

/// Where a path shall run: a polyline.
pub(crate) struct Way {
    points: Vec<DVec3>,
    length: f64,
}

impl Way {
    /// A way with a point at least.
    pub(crate) fn new(points: Vec<DVec3>) -> Self {
        let length = points.windows(2).map(|w| w[0].distance(w[1])).sum();
        Self { points, length }
    }

    pub(crate) fn length(&self) -> f64 {
        self.length
    }

    fn end(&self) -> DVec3 {
        self.points.last().copied().unwrap_or_default()
    }

    fn square_distance(&self, p: DVec3) -> f64 {
        let feet = self.points.windows(2).map(|w| w[0].lerp(w[1], mesh_core::closest_on_segment(p, w[0], w[1])));
        feet.map(|q| q.distance_squared(p)).fold(f64::INFINITY, f64::min)
    }
}

/// A step costs its length, and so much more where it is as far off the way as the way is long; with the square of the distance. A way that
/// winds is long, so that a shortcut costs little more there.
const STRAIGHTNESS: f64 = 30.0;
/// What each step costs beside its length, in spacings: in needles steps have almost no length, and a path could zigzag there.
const STOP: f64 = 1e-3;
/// Most points on an edge.
const MOST_STEPS: f64 = 7.0;

/// Finds a path from one end to the other that crosses no wall and runs through no taken vertex. Points on edges are about
/// `spacing` apart, and every edge has one at least: so there is a path wherever there is a way.
pub(crate) fn shortest(mesh: &CutMesh, [from, to]: [&End; 2], way: &Way, spacing: f64) -> Option<Vec<Node>> {
    Search { mesh, from, to, way, spacing }.run()
}

struct Search<'a> {
    mesh: &'a CutMesh,
    from: &'a End,
    to: &'a End,
    way: &'a Way,
    spacing: f64,
}

/// A node that the search has met.
struct Met {
    node: Node,
    at: DVec3,
    /// What a step costs here for each unit of its length: 1 on the way.
    weight: f64,
    cost: f64,
    before: usize,
}

impl Search<'_> {
    fn run(&self) -> Option<Vec<Node>> {
        let (start, goal) = (Node::Vertex(self.from.vertex), Node::Vertex(self.to.vertex));
        let mut all = vec![Met { cost: 0.0, ..self.meet(start, 0) }];
        let mut index = FxHashMap::from_iter([(start, 0)]);
        let mut queue = BinaryHeap::from([(Reverse(0u64), Reverse(0), 0u64)]);
        let mut next = Vec::new();
        while let Some((_, Reverse(i), bits)) = queue.pop() {
            let Met { node, at, weight, cost, .. } = all[i];
            if node == goal {
                return Some(back(&all, i));
            }
            if f64::from_bits(bits) > cost {
                continue;
            }
            self.next(node, &mut next);
            for &beside in &next {
                let k = *index.entry(beside).or_insert_with(|| {
                    all.push(self.meet(beside, i));
                    all.len() - 1
                });
                let met = &mut all[k];
                let cost = cost + at.distance(met.at) * weight.min(met.weight) + STOP * self.spacing;
                if cost < met.cost {
                    (met.cost, met.before) = (cost, i);
                    let estimate = cost + met.at.distance(self.way.end());
                    queue.push((Reverse(estimate.to_bits()), Reverse(k), cost.to_bits()));
                }
            }
        }
        None
    }

    fn meet(&self, node: Node, before: usize) -> Met {
        let at = |v: u32| self.mesh.positions()[v as usize];
        let at = match node {
            Node::Vertex(v) => at(v),
            Node::OnEdge([a, b], step) => at(a).lerp(at(b), share(self.mesh, [a, b], step, self.spacing)),
        };
        let scale = self.way.length().max(self.spacing);
        let weight = 1.0 + STRAIGHTNESS * self.way.square_distance(at) / (scale * scale);
        Met { node, at, weight, cost: f64::INFINITY, before }
    }

    /// All nodes on the pieces beside a node.
    fn next(&self, node: Node, next: &mut Vec<Node>) {
        let mesh = self.mesh;
        let pieces = match node {
            Node::Vertex(v) if v == self.from.vertex => self.from.sector.clone(),
            Node::Vertex(v) => mesh.fan(v),
            Node::OnEdge([a, b], _) => [mesh.left(a, b), mesh.left(b, a)].into_iter().flatten().collect(),
        };
        next.clear();
        for piece in pieces {
            let vertices = mesh.pieces()[piece as usize].vertices;
            for c in 0..3 {
                let v = vertices[c];
                let is_goal = v == self.to.vertex && self.to.sector.contains(&piece);
                if is_goal || !mesh.is_taken(v) {
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
    }
}

/// The path to the last of the nodes.
fn back(all: &[Met], mut i: usize) -> Vec<Node> {
    let mut path = vec![all[i].node];
    while i != all[i].before {
        i = all[i].before;
        path.push(all[i].node);
    }
    path.reverse();
    path
}

/// The number of points on an edge.
fn steps(mesh: &CutMesh, [a, b]: [u32; 2], spacing: f64) -> u8 {
    let [a, b] = [a, b].map(|v| mesh.positions()[v as usize]);
    (a.distance(b) / spacing).round().clamp(1.0, MOST_STEPS) as u8
}

/// How far along its edge a point is, 0 to 1.
pub(crate) fn share(mesh: &CutMesh, ends: [u32; 2], step: u8, spacing: f64) -> f64 {
    f64::from(step) / f64::from(steps(mesh, ends, spacing) + 1)
}
