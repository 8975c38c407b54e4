//! Straight smooth borders: faces change sides where most of their surroundings lie.

use crate::disk::{PatchOf, can_add, can_remove};
use crate::measured::Measured;
use mesh_core::FaceId;
use region_map::PatchId;

/// Passes over all faces. A border moves by one row of faces per pass at most, so this is also how far it can.
const PASSES: usize = 16;
/// Surroundings of a face, in rings of vertices.
const RINGS: usize = 2;
/// A side must have this much more area to win, so that rounding cannot swap a face to and fro.
const MAJORITY: f64 = 1.000_001;

/// Moves faces along smooth borders to the side that has more of the area around them, which flows the border by its curvature.
/// Across the network nothing moves. Returns the number of faces that changed sides.
pub(crate) fn straighten(surface: &Measured, patch_of: &mut PatchOf) -> usize {
    let mut swaps = 0;
    let mut around = Vec::new();
    let mut active: Vec<FaceId> = surface.topology.faces().ids().collect();
    for _ in 0..PASSES {
        let mut next = Vec::new();
        for &f in &active {
            if let Some(patch) = better_side(surface, patch_of, f, &mut around) {
                patch_of[f] = Some(patch);
                swaps += 1;
                next.extend_from_slice(&around);
            }
        }
        // Only where something has changed can something change again.
        next.sort_unstable();
        next.dedup();
        active = next;
    }
    swaps
}

/// The patch across one of its edges that `f` should go to. Leaves the faces around `f` in `around` when there is one.
fn better_side(surface: &Measured, patch_of: &PatchOf, f: FaceId, around: &mut Vec<FaceId>) -> Option<PatchId> {
    let topology = surface.topology;
    let own = patch_of[f];
    let across = |h| topology.twin(h).filter(|_| !surface.network.is_barrier(topology.edge(h))).and_then(|t| patch_of[t.face()]);
    let beside = topology.halfedges(f).map(across);
    if beside.iter().all(|&p| p == own || p.is_none()) || !can_remove(surface, patch_of, f) {
        return None;
    }
    collect_around(surface, f, around);
    let weight = |p: Option<PatchId>| around.iter().filter(|&&g| patch_of[g] == p).map(|&g| surface.areas[g]).sum::<f64>();
    let mut others: Vec<(f64, PatchId)> =
        beside.into_iter().flatten().filter(|&p| Some(p) != own).map(|p| (weight(Some(p)), p)).collect();
    others.sort_by(|(a, p), (b, q)| b.total_cmp(a).then(p.cmp(q)));
    let least = MAJORITY * weight(own);
    others.into_iter().find(|&(area, p)| area > least && can_add(surface, patch_of, f, p)).map(|(_, p)| p)
}

/// The other faces within two rings of vertices.
fn collect_around(surface: &Measured, f: FaceId, around: &mut Vec<FaceId>) {
    let topology = surface.topology;
    around.clear();
    around.push(f);
    for _ in 0..RINGS {
        let vertices: Vec<_> = around.iter().flat_map(|&g| topology.face(g)).collect();
        around.extend(vertices.into_iter().flat_map(|v| topology.faces_at(v)));
        around.sort_unstable();
        around.dedup();
    }
    around.retain(|&g| g != f);
}
