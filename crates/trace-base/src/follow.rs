//! The base edges that follow an arc.

use crate::foreign::Foreign;
use crate::stops::Stop;
use glam::DVec3;
use mesh_core::{EdgeId, IdVec, Polyline, TriMesh, VertexId};
use region_map::{Arc, ArcKind, CornerId, Network, spokes};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Chains of base edges found so far.
pub(crate) struct Followed<'a> {
    base: &'a Foreign,
    taken_vertex: IdVec<VertexId, bool>,
    taken_edge: IdVec<EdgeId, bool>,
    /// The distance of every base vertex to the nearest arc.
    nearest_arc: IdVec<VertexId, f64>,
}

/// The cost of a base edge beside an arc: its length times this share and the mean square of its distance from the arc, in reaches.
const LENGTH_SHARE: f64 = 0.02;
/// What it costs to take a vertex that is nearer to another arc, for each reach that it is nearer. Without it, arcs on both sides of a
/// narrow strip take each other's vertices: the casting's own base mesh of 302 vertices loses three of its longest arcs.
const STRAY_COST: f64 = 10.0;
/// The middle of an edge that follows an arc may be two reaches away from it (this is the square): edges cut bends off.
const FARTHEST_MIDDLE: f64 = 4.0;
/// A place on an arc that is this close to a vertex of the arc, as a share of the arc's edge there, is moved to the vertex.
const AT_VERTEX: f64 = 1e-3;
/// Base vertices on an arc are at least this share of their mean distance apart; where the nearest points are closer, or in another
/// order, they are spread by the lengths of the base edges (of which QEM leaves some of no length).
const LEAST_STEP: f64 = 0.1;

impl<'a> Followed<'a> {
    pub(crate) fn new(mesh: &TriMesh, network: &Network, base: &'a Foreign, corners: &IdVec<CornerId, VertexId>) -> Self {
        let mut taken_vertex = IdVec::filled(false, base.mesh.n_vertices());
        corners.iter().for_each(|&v| taken_vertex[v] = true);
        let lines: Vec<Polyline> = network.arcs.iter().map(|a| part_of_arc(mesh, a, 0.0, a.length())).collect();
        let nearest =
            |&p: &DVec3| lines.iter().fold(f64::INFINITY, |least, l| l.foot_below(p, least).map_or(least, |f| f.distance));
        let nearest_arc = base.mesh.positions().iter().map(nearest).collect();
        Self { base, taken_vertex, taken_edge: IdVec::filled(false, base.topology.n_edges()), nearest_arc }
    }

    /// The base vertices along an arc between the base vertices at its corners: no other arc can have them from now on. `None` where no
    /// base edges follow it.
    pub(crate) fn chain(
        &mut self,
        mesh: &TriMesh,
        arc: &Arc,
        corners: Option<[VertexId; 2]>,
        component: u32,
    ) -> Option<Vec<Stop>> {
        let length = arc.length();
        let ends = match corners {
            Some([a, b]) => [Stop { vertex: a, t: 0.0 }, Stop { vertex: b, t: length }],
            None => {
                let (vertex, t) = self.nearest(mesh, arc, [0.0, length], component)?;
                self.taken_vertex[vertex] = true;
                [Stop { vertex, t }, Stop { vertex, t: t + length }]
            }
        };
        let mut legs = vec![ends[0]];
        if ends[0].vertex == ends[1].vertex {
            // Both ends are one vertex: two more on the way tell in which direction the arc runs round.
            for share in [1.0, 2.0] {
                let at = ends[0].t + share * length / 3.0;
                let (vertex, t) = self.nearest(mesh, arc, [at - length / 9.0, at + length / 9.0], component)?;
                self.taken_vertex[vertex] = true;
                legs.push(Stop { vertex, t });
            }
        }
        legs.push(ends[1]);
        let mut chain = vec![legs[0]];
        for leg in legs.windows(2) {
            let line = part_of_arc(mesh, arc, leg[0].t, leg[1].t);
            let path = self.path(leg[0].vertex, leg[1].vertex, &line, arc.kind == ArcKind::Border, component)?;
            self.take(&path);
            chain.extend(self.spread(arc, &line, &path, [leg[0].t, leg[1].t]));
        }
        Some(chain)
    }

    /// The free base vertex nearest to a part of an arc, and the arc length there. Distances are compared over the reach of each vertex.
    fn nearest(&self, mesh: &TriMesh, arc: &Arc, [from, to]: [f64; 2], component: u32) -> Option<(VertexId, f64)> {
        let line = part_of_arc(mesh, arc, from, to);
        let feet =
            self.base.mesh.positions().enumerate().filter(|(v, _)| self.may_take(*v, arc.kind == ArcKind::Border, component));
        let near = feet.map(|(v, &p)| (v, line.foot(p))).map(|(v, f)| (v, f.t, f.distance / self.base.reach[v]));
        near.filter(|n| n.2 <= 1.0).min_by(|a, b| a.2.total_cmp(&b.2)).map(|(v, t, _)| (v, snapped(arc, t)))
    }

    fn may_take(&self, v: VertexId, border: bool, component: u32) -> bool {
        !self.taken_vertex[v] && self.base.component[v] == component && self.base.topology.is_border_vertex(v) == border
    }

    /// The vertices from `from` to `to` along free base edges that stay nearest to a line (Dijkstra).
    fn path(&self, from: VertexId, to: VertexId, line: &Polyline, border: bool, component: u32) -> Option<Vec<VertexId>> {
        let base = self.base;
        let off = |p: DVec3, reach: f64| (line.foot(p).distance / reach).powi(2);
        let mut best = IdVec::<VertexId, (f64, Option<VertexId>)>::filled((f64::INFINITY, None), base.mesh.n_vertices());
        best[from].0 = 0.0;
        let mut queue = BinaryHeap::from([(Reverse(0u64), from)]);
        while let Some((Reverse(bits), v)) = queue.pop() {
            let cost = f64::from_bits(bits);
            if v == to && v != from {
                let mut path: Vec<VertexId> = std::iter::successors(Some(to), |&v| best[v].1).collect();
                path.reverse();
                return Some(path);
            }
            if cost > best[v].0 {
                continue;
            }
            for h in spokes(&base.topology, v) {
                let e = base.topology.edge(h);
                let [a, b] = base.topology.ends(e);
                let w = if a == v { b } else { a };
                let free = w == to || self.may_take(w, border, component);
                if !free || self.taken_edge[e] || base.topology.is_border_edge(e) != border {
                    continue;
                }
                let (p, q) = (base.position(v), base.position(w));
                let reach = 0.5 * (base.reach[v] + base.reach[w]);
                let offs = [off(p, reach), off(p.midpoint(q), reach), off(q, reach)];
                if w != to && offs[2] > 1.0 || offs[1] > FARTHEST_MIDDLE {
                    continue;
                }
                let stray = STRAY_COST * (offs[2].sqrt() - self.nearest_arc[w] / reach).max(0.0);
                let next = cost + p.distance(q) * (LENGTH_SHARE + (offs[0] + 4.0 * offs[1] + offs[2]) / 6.0 + stray);
                if next < best[w].0 {
                    best[w] = (next, Some(v));
                    queue.push((Reverse(next.to_bits()), w));
                }
            }
        }
        None
    }

    fn take(&mut self, path: &[VertexId]) {
        for pair in path.windows(2) {
            self.taken_vertex[pair[1]] = true;
            if let Some(e) = self.base.topology.find_edge(pair[0], pair[1]) {
                self.taken_edge[e] = true;
            }
        }
    }

    /// Arc lengths for a path, without its first vertex: those of the nearest points where they are in order.
    fn spread(&self, arc: &Arc, line: &Polyline, path: &[VertexId], [from, to]: [f64; 2]) -> Vec<Stop> {
        let n = path.len() - 1;
        let mut t: Vec<f64> = path.iter().map(|&v| snapped(arc, line.foot(self.base.position(v)).t)).collect();
        (t[0], t[n]) = (from, to);
        let step = LEAST_STEP * (to - from) / n as f64;
        if t.windows(2).any(|w| w[1] - w[0] < step) {
            let lengths: Vec<f64> = path.windows(2).map(|w| self.base.mesh.distance(w[0], w[1])).collect();
            let least = LEAST_STEP * lengths.iter().sum::<f64>() / n as f64;
            let whole: f64 = lengths.iter().map(|l| l.max(least)).sum();
            for k in 1..n {
                t[k] = t[k - 1] + (to - from) * lengths[k - 1].max(least) / whole;
            }
        }
        path.iter().zip(t).skip(1).map(|(&vertex, t)| Stop { vertex, t }).collect()
    }
}

/// An arc length moved to the next vertex of the arc if that is near.
fn snapped(arc: &Arc, t: f64) -> f64 {
    let (i, s) = arc.segment(t);
    let round = t - arc.normalise(t);
    match s {
        s if s < AT_VERTEX => round + arc.lengths[i],
        s if s > 1.0 - AT_VERTEX => round + arc.lengths[i + 1],
        _ => t,
    }
}

/// The part of an arc from `from` to `to`, by arc lengths; on a loop it may go beyond the loop's start.
fn part_of_arc(mesh: &TriMesh, arc: &Arc, from: f64, to: f64) -> Polyline {
    let rounds = if arc.is_loop() { 2 } else { 1 };
    let all = (0..rounds).flat_map(|k| {
        let offset = f64::from(k) * arc.length();
        arc.lengths.iter().zip(&arc.vertices).map(move |(t, &v)| (t + offset, mesh.position(v)))
    });
    let mut points = vec![(from, arc.position(mesh, from))];
    points.extend(all.filter(|&(t, _)| from < t && t < to));
    points.push((to, arc.position(mesh, to)));
    Polyline::new(points)
}
