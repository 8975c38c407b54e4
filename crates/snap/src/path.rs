//! Paths of domain edges beside a piece of a minor crease (Dijkstra).

use crate::assignment::Assignment;
use crate::minor::Piece;
use mesh_core::{Polyline, VertexId};
use region_map::Domain;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

/// An edge costs its length times one plus this times the mean square of its ends' distances to the crease, in edge lengths.
const DISTANCE_WEIGHT: f64 = 6.0;
/// No vertex of a path is farther from the crease, in edge lengths.
const MOST_DISTANCE: f64 = 1.5;
/// A path is between so much shorter and longer than the crease: else its edges would be much longer or shorter than those
/// around.
const LENGTHS: [f64; 2] = [0.6, 1.6];

/// A path to be found.
pub(crate) struct Path<'a, 'b> {
    assignment: &'a Assignment<'b>,
    piece: &'a Piece,
    crease: Polyline,
    start: VertexId,
    end: VertexId,
}

/// How a vertex is reached at the least cost so far.
#[derive(Clone, Copy)]
struct Reached {
    /// The cost's bits. Costs are not negative, so their bits are in order.
    cost: u64,
    previous: VertexId,
    /// Distance from the crease.
    distance: f64,
}

impl<'a, 'b> Path<'a, 'b> {
    /// A path along `piece` from the domain vertex `start` to `end`.
    pub(crate) fn new(assignment: &'a Assignment<'b>, piece: &'a Piece, start: VertexId, end: VertexId) -> Self {
        // Only distances from it are asked.
        let crease = piece.vertices.iter().map(|&v| (0.0, assignment.surface.mesh().position(v))).collect();
        Self { assignment, piece, crease: Polyline::new(crease), start, end }
    }

    /// The cheapest path from start to end over free vertices of the sheet, without edges on arcs, or corners cut by one edge.
    pub(crate) fn shortest(&self) -> Option<Vec<VertexId>> {
        if self.start == self.end {
            return None;
        }
        let start = Reached { cost: 0, previous: self.start, distance: self.distance(self.start) };
        let mut reached: BTreeMap<VertexId, Reached> = BTreeMap::from([(self.start, start)]);
        let mut queue = BinaryHeap::from([Reverse((0, self.start))]);
        while let Some(Reverse((bits, v))) = queue.pop() {
            if v == self.end {
                return self.straightened(&reached);
            }
            let at = reached[&v];
            if at.cost != bits {
                continue;
            }
            for w in self.assignment.domain.topology.one_ring(v) {
                let known = reached.get(&w).copied();
                let distance = known.map_or_else(|| self.distance(w), |known| known.distance);
                if !self.may_step(v, w, distance) {
                    continue;
                }
                let cost = (f64::from_bits(bits) + self.cost([v, w], [at.distance, distance])).to_bits();
                if known.is_none_or(|known| cost < known.cost) {
                    reached.insert(w, Reached { cost, previous: v, distance });
                    queue.push(Reverse((cost, w)));
                }
            }
        }
        None
    }

    /// May a path go from `v` to `w`, which is so far from the crease?
    fn may_step(&self, v: VertexId, w: VertexId, distance: f64) -> bool {
        let Assignment { domain, edge_length, .. } = self.assignment;
        let inside = self.assignment.is_free_in(w, self.piece.sheet) && distance < MOST_DISTANCE * edge_length;
        // An edge between two arcs of another sheet would leave this one.
        let in_sheet = |v: VertexId| domain.topology.fan(v).any(|h| domain.region.sheet_of_face[h.face()] == self.piece.sheet);
        (inside || w == self.end) && domain.region.span(v, w).is_none() && in_sheet(v) && !self.is_on_path(v, w)
    }

    /// Does the path along another piece run along this edge?
    fn is_on_path(&self, v: VertexId, w: VertexId) -> bool {
        let runs = |pair: &[VertexId]| pair == [v, w] || pair == [w, v];
        let mut pieces = self.assignment.pieces().iter();
        (v, w) == (self.start, self.end) && pieces.any(|followed| followed.path.windows(2).any(runs))
    }

    fn cost(&self, [v, w]: [VertexId; 2], distances: [f64; 2]) -> f64 {
        let Assignment { domain, edge_length, .. } = self.assignment;
        let [a, b] = distances.map(|distance| (distance / edge_length).powi(2));
        domain.mesh.distance(v, w) * (1.0 + DISTANCE_WEIGHT * 0.5 * (a + b))
    }

    /// Distance of a domain vertex from the piece.
    fn distance(&self, v: VertexId) -> f64 {
        self.crease.foot(self.assignment.domain.mesh.position(v)).distance
    }

    /// The path back from the end, without vertices whose neighbours on it are joined by an edge: on a straight crease such a
    /// triangle would have no area. `None` when it is too long or too short.
    fn straightened(&self, reached: &BTreeMap<VertexId, Reached>) -> Option<Vec<VertexId>> {
        let Domain { mesh, topology, region } = self.assignment.domain;
        let mut path = vec![self.end];
        let mut at = self.end;
        while at != self.start {
            at = reached[&at].previous;
            let n = path.len();
            if n > 1 && topology.find_edge(path[n - 2], at).is_some() && region.span(path[n - 2], at).is_none() {
                path.pop();
            }
            path.push(at);
        }
        path.reverse();
        let length = mesh.chain_length(&path);
        let [least, most] = LENGTHS.map(|share| share * self.piece.length);
        (least < length && length < most).then_some(path)
    }
}
