//! Patches cut in two, for the stages that find a patch too long or too winding to lay flat.

use crate::disk::{PatchOf, can_add, n_patches};
use crate::measured::Measured;
use crate::straighten::straighten;
use mesh_core::{FaceId, Id, IdVec};
use region_map::{PatchId, Segmentation, Surface};
use rustc_hash::FxHashMap;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Why patches are not split.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum SplitError {
    /// The segmentation is of another mesh.
    #[error("the segmentation is of another mesh, or its number of patches is wrong")]
    OtherMesh,
    /// There is no such patch.
    #[error("patch {0} cannot be split: the segmentation does not have it")]
    NoSuchPatch(PatchId),
}

/// Cuts each of the given patches into two or more disks of about the same extent; a patch of one face stays as it is.
///
/// Both halves grow at the same pace from the two ends of the patch, under the rule that keeps disks; what neither can take becomes a
/// patch of its own. A patch that is named twice is cut once.
///
/// Fails where the segmentation is not one of this surface, or does not have one of the patches.
pub fn split(surface: &Surface, segmentation: &Segmentation, patches: &[PatchId]) -> Result<Segmentation, SplitError> {
    check(surface, segmentation, patches)?;
    let surface = Measured::new(surface);
    let mut patch_of: PatchOf = segmentation.patch_of_face.iter().map(|&p| Some(p)).collect();
    let faces = segmentation.faces_of_patches();
    let mut next = segmentation.n_patches;
    let mut is_done: IdVec<PatchId, bool> = IdVec::filled(false, next);
    for &p in patches {
        if faces[p].len() < 2 || std::mem::replace(&mut is_done[p], true) {
            continue;
        }
        let (from, to) = ends(&surface, &patch_of, &faces[p]);
        faces[p].iter().for_each(|&f| patch_of[f] = None);
        grow_by_distance(&surface, &mut patch_of, &[(from, p), (to, PatchId::new(next))]);
        // Both ends are the same only where the patch hangs together nowhere, so is no disk.
        next += usize::from(from != to);
        for &f in &faces[p] {
            if patch_of[f].is_none() {
                grow_by_distance(&surface, &mut patch_of, &[(f, PatchId::new(next))]);
                next += 1;
            }
        }
    }
    straighten(&surface, &mut patch_of);
    let n_patches = n_patches(&patch_of);
    Ok(Segmentation { patch_of_face: patch_of.iter().flatten().copied().collect(), n_patches })
}

fn check(surface: &Surface, segmentation: &Segmentation, patches: &[PatchId]) -> Result<(), SplitError> {
    if !segmentation.fits(surface.mesh()) {
        return Err(SplitError::OtherMesh);
    }
    match patches.iter().find(|p| p.index() >= segmentation.n_patches) {
        Some(&p) => Err(SplitError::NoSuchPatch(p)),
        None => Ok(()),
    }
}

/// Distances are compared as bits: those of numbers that are not negative order like the numbers.
type Distance = u64;

/// Two faces of a patch that are about as far from each other as any two.
fn ends(surface: &Measured, patch_of: &PatchOf, faces: &[FaceId]) -> (FaceId, FaceId) {
    let first = farthest(surface, patch_of, faces[0]);
    (first, farthest(surface, patch_of, first))
}

/// The face of the same patch that is farthest from a face, along centroids.
fn farthest(surface: &Measured, patch_of: &PatchOf, from: FaceId) -> FaceId {
    let mut distance: FxHashMap<FaceId, f64> = FxHashMap::default();
    let mut queue = BinaryHeap::from([Reverse((0f64.to_bits(), from))]);
    let mut last = from;
    while let Some(Reverse((bits, f))) = queue.pop() {
        if distance.contains_key(&f) {
            continue;
        }
        let d = f64::from_bits(bits);
        distance.insert(f, d);
        last = f;
        for (g, further) in across(surface, f, d) {
            if patch_of[g] == patch_of[from] && !distance.contains_key(&g) {
                queue.push(Reverse((further, g)));
            }
        }
    }
    last
}

/// The neighbours of a face with their distances from where the face has distance `d`.
fn across<'a>(surface: &'a Measured, f: FaceId, d: f64) -> impl Iterator<Item = (FaceId, Distance)> + 'a {
    let step = move |g: FaceId| (g, (d + surface.centroids[f].distance(surface.centroids[g])).to_bits());
    surface.topology.neighbours(f).into_iter().flatten().map(step)
}

/// Grows patches from seeds over the faces that have none, nearest first.
fn grow_by_distance(surface: &Measured, patch_of: &mut PatchOf, seeds: &[(FaceId, PatchId)]) {
    let mut queue: BinaryHeap<Reverse<(Distance, FaceId, PatchId)>> = BinaryHeap::new();
    let take = |f: FaceId, p: PatchId, d: f64, patch_of: &mut PatchOf, queue: &mut BinaryHeap<_>| {
        patch_of[f] = Some(p);
        queue.extend(across(surface, f, d).filter(|&(g, _)| patch_of[g].is_none()).map(|(g, further)| Reverse((further, g, p))));
    };
    for &(f, p) in seeds {
        if patch_of[f].is_none() {
            take(f, p, 0.0, patch_of, &mut queue);
        }
    }
    while let Some(Reverse((bits, f, p))) = queue.pop() {
        if patch_of[f].is_none() && can_add(surface, patch_of, f, p) {
            take(f, p, f64::from_bits(bits), patch_of, &mut queue);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use region_map::Cells;

    #[test]
    fn halves_are_disks() {
        for mesh in [fixtures::icosphere(6), fixtures::torus(2.0, 0.7, 24, 12), fixtures::cube(5)] {
            let surface = Surface::with_creases(mesh, 60.0).unwrap();
            let (mut segmentation, _) = crate::segment(&surface, &crate::VsaOptions::default()).unwrap();
            for _ in 0..4 {
                let before = segmentation.n_patches;
                let all: Vec<PatchId> = (0..before).map(PatchId::new).collect();
                segmentation = split(&surface, &segmentation, &all).unwrap();
                assert!(segmentation.n_patches > before);
                Cells::trace(&surface, &segmentation).unwrap();
            }
        }
    }
}
