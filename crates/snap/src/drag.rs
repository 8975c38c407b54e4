//! Moves the vertices around those that were snapped, less and less with the distance.

use crate::assignment::Assignment;
use glam::DVec3;
use mesh_core::{VertexId, walk_end};
use region_map::{Attachment, Domain, RegionMap};
use std::collections::{BTreeMap, BTreeSet};

/// So many rings of vertices move along: most snapped vertices move by less than half an edge length, so fewer would fold where one
/// moves farther, and more would move what the relaxation has placed well.
const RINGS: usize = 4;
/// Rounds of averaging: more spread the movement more evenly over the rings, and take time.
const ROUNDS: usize = 12;

/// Moves the vertices inside sheets around those whose points in `region` are not where the domain has them.
pub(crate) fn drag(assignment: &Assignment, region: &mut RegionMap) {
    let (surface, Domain { mesh, topology, .. }) = (assignment.surface, assignment.domain);
    let target = |v: VertexId| region.points[v].position(surface.mesh()) - mesh.position(v);
    let snapped = assignment.corners().values().copied().chain(assignment.pieces().iter().flat_map(|t| t.path.iter().copied()));
    let snapped: BTreeMap<VertexId, DVec3> = snapped.map(|v| (v, target(v))).collect();
    let mut reached: BTreeSet<VertexId> = snapped.keys().copied().collect();
    for _ in 0..RINGS {
        let next: Vec<VertexId> = reached.iter().flat_map(|&v| topology.one_ring(v)).collect();
        reached.extend(next);
    }
    let is_free = |v: &VertexId| !snapped.contains_key(v) && matches!(region.attachments[*v], Attachment::Sheet(_));
    let free: Vec<VertexId> = reached.into_iter().filter(is_free).collect();
    let mut ways = snapped.clone();
    for _ in 0..ROUNDS {
        let mean = |v: VertexId| {
            let (n, sum) = topology
                .one_ring(v)
                .fold((0, DVec3::ZERO), |(n, sum), w| (n + 1, sum + ways.get(&w).copied().unwrap_or_default()));
            sum / f64::from(n.max(1))
        };
        let means: Vec<(VertexId, DVec3)> = free.iter().map(|&v| (v, mean(v))).collect();
        ways.extend(means);
    }
    let may_cross = |e| !surface.network().is_barrier(e);
    for v in free {
        region.points[v] = walk_end(surface.mesh(), surface.topology(), region.points[v], ways[&v], may_cross);
    }
}
