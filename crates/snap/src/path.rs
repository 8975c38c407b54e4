//! Paths of domain edges beside a piece of a minor crease (Dijkstra).

use crate::claims::Claims;
use crate::minor::Piece;
use mesh_core::{VertexId, closest_on_segment};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

/// An edge costs its length times one plus this times the mean square of its ends' distances to the crease, in edge lengths.
const DISTANCE_WEIGHT: f64 = 6.0;
/// No vertex of a path is farther from the crease, in edge lengths.
const MOST_DISTANCE: f64 = 1.5;
/// A path is between so much shorter and longer than the crease: else its edges would be much longer or shorter than those around.
const LENGTHS: [f64; 2] = [0.6, 1.6];

/// A path to be found.
pub(crate) struct Path<'a, 'b> {
    pub(crate) claims: &'a Claims<'b>,
    pub(crate) piece: &'a Piece,
    pub(crate) start: VertexId,
    pub(crate) end: VertexId,
}

impl Path<'_, '_> {
    /// The cheapest path from start to end over free vertices of the sheet, without edges on arcs, or corners cut by one edge.
    pub(crate) fn shortest(&self) -> Option<Vec<VertexId>> {
        if self.start == self.end {
            return None;
        }
        let mut previous: BTreeMap<VertexId, (u64, VertexId)> = BTreeMap::from([(self.start, (0, self.start))]);
        let mut queue = BinaryHeap::from([Reverse((0, self.start))]); // costs are not negative: their bits are in order
        while let Some(Reverse((bits, v))) = queue.pop() {
            if v == self.end {
                return self.straightened(&previous);
            }
            if previous[&v].0 != bits {
                continue;
            }
            for w in self.claims.domain.topology.one_ring(v).filter(|&w| self.may_step(v, w)) {
                let cost = (f64::from_bits(bits) + self.cost(v, w)).to_bits();
                if previous.get(&w).is_none_or(|&(known, _)| cost < known) {
                    previous.insert(w, (cost, v));
                    queue.push(Reverse((cost, w)));
                }
            }
        }
        None
    }

    fn may_step(&self, v: VertexId, w: VertexId) -> bool {
        let claims = self.claims;
        let inside = claims.is_free_in(w, self.piece.sheet) && self.distance(w) < MOST_DISTANCE * claims.edge_length();
        // An edge between two arcs of another sheet would leave this one.
        let in_sheet = |v: VertexId| claims.spokes(v).any(|h| claims.domain.region.sheet_of_face[h.face()] == self.piece.sheet);
        (inside || w == self.end) && claims.domain.region.span(v, w).is_none() && in_sheet(v) && !self.is_claimed_edge(v, w)
    }

    /// Does a track run along this edge?
    fn is_claimed_edge(&self, v: VertexId, w: VertexId) -> bool {
        let runs = |pair: &[VertexId]| pair == [v, w] || pair == [w, v];
        (v, w) == (self.start, self.end) && self.claims.tracks.iter().any(|track| track.path.windows(2).any(runs))
    }

    fn cost(&self, v: VertexId, w: VertexId) -> f64 {
        let unit = self.claims.edge_length();
        let [a, b] = [v, w].map(|v| (self.distance(v) / unit).powi(2));
        self.claims.domain.mesh.distance(v, w) * (1.0 + DISTANCE_WEIGHT * 0.5 * (a + b))
    }

    /// Distance of a domain vertex from the piece.
    fn distance(&self, v: VertexId) -> f64 {
        let (mesh, p) = (self.claims.surface.mesh(), self.claims.domain.mesh.position(v));
        let to_segment = |ends: &[VertexId]| {
            let (a, b) = (mesh.position(ends[0]), mesh.position(ends[1]));
            p.distance(a.lerp(b, closest_on_segment(p, a, b)))
        };
        self.piece.vertices.windows(2).map(to_segment).fold(f64::INFINITY, f64::min)
    }

    /// The path back from the end, without vertices whose neighbours on it are joined by an edge: on a straight crease such a
    /// triangle would have no area. `None` when it is too long or too short.
    fn straightened(&self, previous: &BTreeMap<VertexId, (u64, VertexId)>) -> Option<Vec<VertexId>> {
        let claims = self.claims;
        let mut path = vec![self.end];
        let mut at = self.end;
        while at != self.start {
            at = previous[&at].1;
            let n = path.len();
            if n > 1
                && claims.domain.topology.find_edge(path[n - 2], at).is_some()
                && claims.domain.region.span(path[n - 2], at).is_none()
            {
                path.pop();
            }
            path.push(at);
        }
        path.reverse();
        let length = claims.domain.mesh.chain_length(&path);
        let [least, most] = LENGTHS.map(|share| share * self.piece.length);
        (least < length && length < most).then_some(path)
    }
}
