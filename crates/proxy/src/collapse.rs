//! The order in which vertices are merged: those first whose neighbour stands for them best.

use crate::ProxyOptions;
use crate::quadric::Quadric;
use crate::triangles::{Guards, Triangles};
use glam::DVec3;
use mesh_core::{Id as _, VertexId};
use region_map::{Sizing, Surface};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// First only merges that hardly change a triangle; then, while there are too many faces, any that turn none over. With the first alone scans
/// with noise of the size of their edges stop early.
const ROUNDS: [Guards; 2] = [Guards { cosine: 0.7, quality: 0.3 }, Guards { cosine: 0.1, quality: 0.05 }];
/// The part of an edge's length that counts as distance: of merges that cost the same the shortest goes first, so that flat parts come out even. More
/// makes edges more even, less follows bends better.
const LENGTH_AS_DISTANCE: f64 = 0.03;
/// The weight of the planes that hold a vertex on its arc, as a share of the squared length of the arc's edges. More keeps the bends of arcs.
const ARC_WEIGHT: f64 = 1.0;
/// The interrupt is asked every so many merges.
const MERGES_AT_ONCE: usize = 1024;

/// A vertex that may be merged.
struct Candidate {
    /// What that costs at least. What a vertex costs only grows while others are merged around it.
    cost: f64,
    vertex: u32,
}

impl Ord for Candidate {
    /// The cheapest is the greatest.
    fn cmp(&self, other: &Self) -> Ordering {
        other.cost.total_cmp(&self.cost).then(other.vertex.cmp(&self.vertex))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Candidate {}

/// Merges vertices until there are as few faces as wanted, or no more can go.
pub(crate) fn collapsed<'a>(surface: &'a Surface, sizing: &'a Sizing, options: &'a ProxyOptions) -> Triangles<'a> {
    let triangles = Triangles::new(surface);
    let n = surface.mesh().n_vertices();
    let (quadrics, queue, is_stuck) = (quadrics(surface), BinaryHeap::new(), vec![true; n]);
    let mut collapse = Collapse { triangles, quadrics, queue, is_stuck, sizing, options };
    for guards in &ROUNDS {
        collapse.run(guards, surface);
    }
    collapse.triangles
}

struct Collapse<'a> {
    triangles: Triangles<'a>,
    quadrics: Vec<Quadric>,
    /// Every vertex once, but for those that are gone or stuck.
    queue: BinaryHeap<Candidate>,
    /// Whether a vertex has no neighbour that can take it, as things are around it.
    is_stuck: Vec<bool>,
    sizing: &'a Sizing,
    options: &'a ProxyOptions,
}

impl Collapse<'_> {
    fn run(&mut self, guards: &Guards, surface: &Surface) {
        (0..self.is_stuck.len() as u32).for_each(|v| self.free(v));
        let mut merges = 0;
        while self.triangles.n_faces > self.options.faces {
            let Some(Candidate { cost, vertex }) = self.queue.pop() else { break };
            if !self.triangles.is_there(vertex) {
                continue;
            }
            match self.first_that_can(vertex, cost, guards) {
                None => self.is_stuck[vertex as usize] = true,
                // It was put into the queue for less, before others were merged.
                Some((least, _)) if least > cost => self.queue.push(Candidate { cost: least, vertex }),
                Some((_, into)) => {
                    self.merge(vertex, into);
                    merges += 1;
                }
            }
            if merges % MERGES_AT_ONCE == 0 && surface.interrupt().is_set() {
                break;
            }
        }
    }

    fn merge(&mut self, from: u32, into: u32) {
        self.triangles.merge(from, into);
        self.quadrics[into as usize] = self.quadrics[into as usize].and(&self.quadrics[from as usize]);
        self.free(into);
        self.triangles.ring(into).into_iter().for_each(|v| self.free(v));
    }

    /// Puts a vertex that is stuck into the queue.
    fn free(&mut self, v: u32) {
        if std::mem::take(&mut self.is_stuck[v as usize]) && self.triangles.is_there(v) {
            self.queue.push(Candidate { cost: 0.0, vertex: v });
        }
    }

    /// The cheapest merge of a vertex that can be done, and what it costs. Where even the cheapest one of all costs more than `known`, only
    /// that is told: whether it can be done is asked when its turn comes.
    fn first_that_can(&self, v: u32, known: f64, guards: &Guards) -> Option<(f64, u32)> {
        let mut targets: Vec<(f64, u32)> =
            self.triangles.targets(v).into_iter().filter_map(|w| Some((self.cost(v, w)?, w))).collect();
        targets.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let first = *targets.first()?;
        if first.0 > known {
            return Some(first);
        }
        targets.into_iter().find(|&(_, w)| self.triangles.can_merge(v, w, |a, b| self.longest(a, b), guards))
    }

    /// What a merge costs, a squared length; `None` where it leads too far from the surface.
    fn cost(&self, from: u32, into: u32) -> Option<f64> {
        let [p, q] = [from, into].map(|v| self.triangles.position(v));
        // Not the mean with those of `into`: the more a vertex stands for, the less another one would count.
        let distance = self.quadrics[from as usize].mean_at(q);
        let most = self.options.distance * self.relative(from, into);
        (distance <= most * most).then(|| distance + LENGTH_AS_DISTANCE * LENGTH_AS_DISTANCE * p.distance_squared(q))
    }

    fn longest(&self, a: u32, b: u32) -> f64 {
        self.options.longest_edge * self.relative(a, b)
    }

    /// How long edges shall be here, relative to others.
    fn relative(&self, a: u32, b: u32) -> f64 {
        let [a, b] = [a, b].map(|v| self.sizing.relative[VertexId(v)]);
        a.min(b)
    }
}

/// The planes that each vertex stands for: those of its faces, and for one on an arc those through the arc across the faces.
fn quadrics(surface: &Surface) -> Vec<Quadric> {
    let (mesh, topology) = (surface.mesh(), surface.topology());
    let mut quadrics = vec![Quadric::NONE; mesh.n_vertices()];
    let mut add = |v: VertexId, plane: &Quadric| quadrics[v.index()] = quadrics[v.index()].and(plane);
    for f in mesh.faces().ids() {
        let normal = mesh.normal(f);
        if normal == DVec3::ZERO {
            continue;
        }
        let plane = Quadric::of_plane(mesh.centroid(f), normal, mesh.area(f));
        mesh.face(f).into_iter().for_each(|v| add(v, &plane));
        for h in topology.halfedges(f).into_iter().filter(|&h| surface.network().is_barrier(topology.edge(h))) {
            let [a, b] = [topology.from(h), topology.to(h)];
            let along = mesh.position(b) - mesh.position(a);
            let Some(across) = along.cross(normal).try_normalize() else { continue };
            let plane = Quadric::of_plane(mesh.position(a), across, ARC_WEIGHT * along.length_squared());
            [a, b].into_iter().for_each(|v| add(v, &plane));
        }
    }
    quadrics
}
