//! Merging of neighbouring patches whose union is a disk.

use crate::disk::{PatchOf, n_patches};
use crate::measured::Measured;
use crate::proxy::Moments;
use mesh_core::{Id, IdVec, VertexId};
use region_map::PatchId;
use rustc_hash::FxHashMap;
use std::f64::consts::PI;

/// A patch with less area than this, in squared base edge lengths, is a sliver: less than one base triangle.
pub(crate) const SLIVER_AREA: f64 = 0.4;
/// A patch narrower than this, in base edge lengths, is a sliver.
const SLIVER_WIDTH: f64 = 0.3;
/// Not even a sliver is merged past this spread of normals, in degrees: half of a cylinder has 74.
const SLIVER_SPREAD: f64 = 80.0;
/// Weight of the roundness of a union beside the error that it adds (0 to 4): decides where normals don't.
const ROUNDNESS_WEIGHT: f64 = 0.05;

/// Which unions are allowed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MergeRule {
    /// Greatest spread of the normals of a union, in degrees. Slivers are merged past it.
    pub(crate) max_spread: f64,
    /// Greatest `perimeter^2 / (4 pi area)` of a union, unless one of the two has more; a circle has 1.
    pub(crate) max_roundness: f64,
    /// What makes a sliver is measured in this unit.
    pub(crate) base_edge_length: f64,
    /// No more merging below this number of patches, but for slivers.
    pub(crate) enough: usize,
}

/// Merges patches, the best pairs first, until the rule allows no more. Returns how many were merged; ids stay gapless.
pub(crate) fn merge(surface: &Measured, patch_of: &mut PatchOf, rule: &MergeRule) -> usize {
    let before = n_patches(patch_of);
    while merge_best_pairs(surface, patch_of, rule) {}
    before - n_patches(patch_of)
}

/// Merges all pairs of which each patch is the other's best partner; false when there are none. No patch is in two of these pairs, so one
/// union does not change what another one was judged by.
fn merge_best_pairs(surface: &Measured, patch_of: &mut PatchOf, rule: &MergeRule) -> bool {
    let n = n_patches(patch_of);
    let shapes = Shapes::of(surface, patch_of, n);
    let mut pairs: Vec<(f64, Pair)> =
        pairs(surface, patch_of).into_iter().filter(Pair::is_disk).filter_map(|p| Some((shapes.cost(&p, rule)?, p))).collect();
    pairs.sort_by(|(c, p), (d, q)| c.total_cmp(d).then(p.patches.cmp(&q.patches)));
    let mut best: IdVec<PatchId, Option<[PatchId; 2]>> = IdVec::filled(None, n);
    for (_, pair) in &pairs {
        pair.patches.iter().for_each(|&p| _ = best[p].get_or_insert(pair.patches));
    }
    let mut into: IdVec<PatchId, PatchId> = (0..n).map(PatchId::new).collect();
    let mut left = n;
    for (cost, Pair { patches, .. }) in pairs {
        let [a, b] = patches;
        if best[a] == Some(patches) && best[b] == Some(patches) && (left > rule.enough || cost < 0.0) {
            into[b] = a;
            left -= 1;
        }
    }
    renumber(patch_of, &into);
    left < n
}

/// Gives every face the patch that its own went into, and numbers the patches that are left without gaps.
fn renumber(patch_of: &mut PatchOf, into: &IdVec<PatchId, PatchId>) {
    let mut next = 0;
    let mut new = IdVec::<PatchId, PatchId>::filled(PatchId(0), into.len());
    for (p, &target) in into.enumerate() {
        if target == p {
            new[p] = PatchId(next);
            next += 1;
        }
    }
    for p in patch_of.iter_mut() {
        *p = p.map(|p| new[into[p]]);
    }
}

/// What two patches have in common.
struct Pair {
    patches: [PatchId; 2],
    edges: usize,
    vertices: usize,
    length: f64,
    /// An arc of the network lies between them, or a corner of the network would be inside of their union.
    blocked: bool,
}

impl Pair {
    /// True when the union is a disk with a simple border: what they share is a subset of a circle whose Euler number is 1, so one
    /// path; and nothing of the network gets inside.
    fn is_disk(&self) -> bool {
        !self.blocked && self.edges > 0 && self.vertices == self.edges + 1
    }
}

/// All pairs of patches that share an edge or a vertex, in order.
fn pairs(surface: &Measured, patch_of: &PatchOf) -> Vec<Pair> {
    let mut found: FxHashMap<[PatchId; 2], Pair> = FxHashMap::default();
    fn entry(found: &mut FxHashMap<[PatchId; 2], Pair>, a: PatchId, b: PatchId) -> &mut Pair {
        let patches = [a.min(b), a.max(b)];
        found.entry(patches).or_insert(Pair { patches, edges: 0, vertices: 0, length: 0.0, blocked: false })
    }
    let Measured { mesh, topology, network, .. } = surface;
    let mut on_border = IdVec::<VertexId, bool>::filled(false, topology.n_vertices());
    for e in topology.edge_ids() {
        let (f, Some(g)) = topology.edge_faces(e) else { continue };
        let (Some(a), Some(b)) = (patch_of[f], patch_of[g]) else { continue };
        if a != b {
            let [v, w] = topology.ends(e);
            (on_border[v], on_border[w]) = (true, true);
            let pair = entry(&mut found, a, b);
            pair.edges += 1;
            pair.length += mesh.distance(v, w);
            pair.blocked |= network.is_barrier(e);
        }
    }
    let mut around = Vec::new();
    for v in on_border.ids().filter(|&v| on_border[v]) {
        around.clear();
        around.extend(topology.fan(v).filter_map(|h| patch_of[h.face()]));
        around.sort_unstable();
        around.dedup();
        let becomes_inner = around.len() == 2 && !topology.is_border_vertex(v);
        for (i, &a) in around.iter().enumerate() {
            for &b in &around[i + 1..] {
                let pair = entry(&mut found, a, b);
                pair.vertices += 1;
                pair.blocked |= becomes_inner && network.corner_of_vertex[v].is_some();
            }
        }
    }
    let mut pairs: Vec<Pair> = found.into_values().collect();
    pairs.sort_unstable_by_key(|p| p.patches);
    pairs
}

/// Moments and perimeters of all patches.
struct Shapes {
    moments: IdVec<PatchId, Moments>,
    perimeters: IdVec<PatchId, f64>,
}

impl Shapes {
    fn of(surface: &Measured, patch_of: &PatchOf, n: usize) -> Self {
        let mut perimeters = IdVec::filled(0.0, n);
        for e in surface.topology.edge_ids() {
            let (f, g) = surface.topology.edge_faces(e);
            let (a, b) = (patch_of[f], g.and_then(|g| patch_of[g]));
            if a != b {
                let [v, w] = surface.topology.ends(e);
                for p in [a, b].into_iter().flatten() {
                    perimeters[p] += surface.mesh.distance(v, w);
                }
            }
        }
        Self { moments: Moments::of_patches(surface, patch_of, n), perimeters }
    }

    /// What merging a pair costs, `None` when the rule forbids it. Slivers cost less than nothing, and least where they share most.
    fn cost(&self, pair: &Pair, rule: &MergeRule) -> Option<f64> {
        let [a, b] = pair.patches;
        let union = self.moments[a].plus(&self.moments[b]);
        let spread = union.spread();
        let share = |p: PatchId| self.is_sliver(p, rule).then(|| pair.length / self.perimeters[p]);
        let share = [a, b].into_iter().filter_map(share).reduce(f64::max).filter(|_| spread <= SLIVER_SPREAD);
        if let Some(share) = share {
            return Some(-share);
        }
        let roundness = roundness(union.area, self.perimeters[a] + self.perimeters[b] - 2.0 * pair.length);
        let worst = [a, b].map(|p| roundness_of(self, p)).into_iter().fold(rule.max_roundness, f64::max);
        let added = union.error() - self.moments[a].error() - self.moments[b].error();
        (spread <= rule.max_spread && roundness <= worst).then(|| added.max(0.0) / union.area + ROUNDNESS_WEIGHT * roundness)
    }

    fn is_sliver(&self, p: PatchId, rule: &MergeRule) -> bool {
        let area = self.moments[p].area;
        let width = 2.0 * area / self.perimeters[p].max(f64::MIN_POSITIVE);
        area < SLIVER_AREA * rule.base_edge_length.powi(2) || width < SLIVER_WIDTH * rule.base_edge_length
    }
}

fn roundness_of(shapes: &Shapes, p: PatchId) -> f64 {
    roundness(shapes.moments[p].area, shapes.perimeters[p])
}

fn roundness(area: f64, perimeter: f64) -> f64 {
    perimeter.powi(2) / (4.0 * PI * area).max(f64::MIN_POSITIVE)
}
