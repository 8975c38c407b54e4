//! Patches cut in two, for the stages that find a patch too long or too winding to lay flat.

use crate::disk::{PatchOf, can_add, n_patches};
use crate::straighten::straighten;
use crate::surface::Surface;
use mesh_core::{FaceId, Id, Topology, TriMesh};
use region_map::{Network, PatchId, Segmentation};
use rustc_hash::FxHashMap;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Cuts each of the given patches into two or more disks of about the same extent; a patch of one face stays as it is.
///
/// Both halves grow at the same pace from the two ends of the patch, under the rule that keeps disks; what neither can take becomes a
/// patch of its own.
pub fn split(
    mesh: &TriMesh,
    topology: &Topology,
    network: &Network,
    segmentation: &Segmentation,
    patches: &[PatchId],
) -> Segmentation {
    let surface = Surface::new(mesh, topology, network);
    let mut patch_of: PatchOf = segmentation.patch_of_face.iter().map(|&p| Some(p)).collect();
    let faces = segmentation.faces_of_patches();
    let mut next = segmentation.n_patches;
    for &p in patches {
        if faces[p].len() < 2 {
            continue;
        }
        let (from, to) = ends(&surface, &patch_of, &faces[p]);
        faces[p].iter().for_each(|&f| patch_of[f] = None);
        grow_by_distance(&surface, &mut patch_of, &[(from, p), (to, PatchId::new(next))]);
        next += 1;
        for &f in &faces[p] {
            if patch_of[f].is_none() {
                grow_by_distance(&surface, &mut patch_of, &[(f, PatchId::new(next))]);
                next += 1;
            }
        }
    }
    straighten(&surface, &mut patch_of);
    let n_patches = n_patches(&patch_of);
    Segmentation { patch_of_face: patch_of.iter().flatten().copied().collect(), n_patches }
}

/// Distances are compared as bits: those of numbers that are not negative order like the numbers.
type Distance = u64;

/// Two faces of a patch that are about as far from each other as any two.
fn ends(surface: &Surface, patch_of: &PatchOf, faces: &[FaceId]) -> (FaceId, FaceId) {
    let first = farthest(surface, patch_of, faces[0]);
    (first, farthest(surface, patch_of, first))
}

/// The face of the same patch that is farthest from a face, along centroids.
fn farthest(surface: &Surface, patch_of: &PatchOf, from: FaceId) -> FaceId {
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
fn across<'a>(surface: &'a Surface, f: FaceId, d: f64) -> impl Iterator<Item = (FaceId, Distance)> + 'a {
    let step = move |g: FaceId| (g, (d + surface.centroids[f].distance(surface.centroids[g])).to_bits());
    surface.topology.neighbours(f).into_iter().flatten().map(step)
}

/// Grows patches from seeds over the faces that have none, nearest first.
fn grow_by_distance(surface: &Surface, patch_of: &mut PatchOf, seeds: &[(FaceId, PatchId)]) {
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
    use mesh_core::{EdgeId, IdVec};
    use region_map::{ArcKind, Cells};

    fn check(mesh: &TriMesh, is_sharp: impl Fn(&Topology, EdgeId) -> bool) {
        let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
        let kinds: IdVec<EdgeId, _> = topology.edge_ids().map(|e| is_sharp(&topology, e).then_some(ArcKind::Sharp)).collect();
        let network = Network::trace(mesh, &topology, &kinds, |_| false, Vec::new());
        let (mut segmentation, _) = crate::segment(mesh, &topology, &network, &crate::VsaOptions::default()).unwrap();
        for _ in 0..4 {
            let before = segmentation.n_patches;
            let all: Vec<PatchId> = (0..before).map(PatchId::new).collect();
            segmentation = split(mesh, &topology, &network, &segmentation, &all);
            assert!(segmentation.n_patches > before);
            Cells::trace(mesh, &topology, &network, &segmentation).unwrap();
        }
    }

    #[test]
    fn halves_are_disks() {
        check(&fixtures::icosphere(6), |_, _| false);
        check(&fixtures::torus(2.0, 0.7, 24, 12), |_, _| false);
        let cube = fixtures::cube(5);
        check(&cube, |t, e| {
            let (f, g) = t.edge_faces(e);
            g.is_some_and(|g| cube.normal(f).dot(cube.normal(g)) < 0.5)
        });
    }
}
