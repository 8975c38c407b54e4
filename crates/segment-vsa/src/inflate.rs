//! Tiny patches that cannot be merged take faces from their neighbours.
//!
//! The disk rule makes small patches that no other may take: beside the end of a crease inside a sheet, and where a patch that grew round a
//! neck met itself. Corners of patches become base vertices, so those of a tiny patch would be nearer to each other than a base edge.

use crate::disk::{PatchOf, can_add, can_remove, n_patches};
use crate::measured::Measured;
use crate::merge::SLIVER_AREA;
use crate::proxy::Moments;
use glam::DVec3;
use mesh_core::{FaceId, IdVec};
use region_map::PatchId;

/// Lets every patch below the least size of one that is no sliver take faces, the nearest first, from patches that stay above it.
pub(crate) fn inflate(surface: &Measured, patch_of: &mut PatchOf, base_edge_length: f64) {
    let target = SLIVER_AREA * base_edge_length.powi(2);
    let moments = Moments::of_patches(surface, patch_of, n_patches(patch_of));
    let mut areas: IdVec<PatchId, f64> = moments.iter().map(|m| m.area).collect();
    let mut tiny: IdVec<PatchId, Vec<FaceId>> = IdVec::filled(Vec::new(), areas.len());
    for (f, p) in patch_of.enumerate() {
        if let Some(p) = p.filter(|&p| areas[p] < target) {
            tiny[p].push(f);
        }
    }
    for (patch, faces) in tiny.enumerate().filter(|(_, faces)| !faces.is_empty()) {
        let centre = moments[patch].normal_and_centre().map_or(surface.centroids[faces[0]], |(_, centre)| centre);
        inflate_one(surface, patch_of, &mut areas, patch, faces, centre, target);
    }
}

fn inflate_one(
    surface: &Measured,
    patch_of: &mut PatchOf,
    areas: &mut IdVec<PatchId, f64>,
    patch: PatchId,
    faces: &[FaceId],
    centre: DVec3,
    target: f64,
) {
    let neighbours = |f: FaceId| surface.topology.neighbours(f).into_iter().flatten();
    let mut rim: Vec<FaceId> = faces.iter().flat_map(|&f| neighbours(f)).collect();
    while areas[patch] < target {
        let spared = |f: FaceId| patch_of[f].is_some_and(|p| p != patch && areas[p] - surface.areas[f] >= target);
        let fits = |f: FaceId| spared(f) && can_add(surface, patch_of, f, patch) && can_remove(surface, patch_of, f);
        let distance = |f: FaceId| surface.centroids[f].distance_squared(centre);
        let nearest =
            rim.iter().copied().filter(|&f| fits(f)).min_by(|&f, &g| distance(f).total_cmp(&distance(g)).then(f.cmp(&g)));
        let Some(f) = nearest else { return };
        if let Some(donor) = patch_of[f] {
            areas[donor] -= surface.areas[f];
        }
        areas[patch] += surface.areas[f];
        patch_of[f] = Some(patch);
        rim.retain(|&g| g != f);
        rim.extend(neighbours(f));
        rim.sort_unstable();
        rim.dedup();
    }
}
