//! The disk rule: which faces a patch may take or give so that it stays a disk whose border is one simple cycle of distinct
//! vertices, with no arc and no corner of the network inside.
//!
//! A single face is such a disk. Everything the stage does to a patch goes through [`can_add`], [`can_remove`] or the union test
//! of `merge.rs`, so every patch is one at all times, whatever the genus of the surface.

use crate::measured::Measured;
use mesh_core::{FaceId, HalfedgeId, Id, IdVec, VertexId};
use region_map::PatchId;

/// The patch of every face, `None` as long as it has none.
pub(crate) type PatchOf = IdVec<FaceId, Option<PatchId>>;

/// True when `patch`, which face `f` is not in, stays a disk with `f`.
pub(crate) fn can_add(surface: &Measured, patch_of: &PatchOf, f: FaceId, patch: PatchId) -> bool {
    let Measured { topology, network, .. } = surface;
    let halfedges = topology.halfedges(f);
    let inside = |h: HalfedgeId| topology.twin(h).is_some_and(|twin| patch_of[twin.face()] == Some(patch));
    let shared = halfedges.map(inside);
    if halfedges.into_iter().zip(shared).any(|(h, shared)| shared && network.is_barrier(topology.edge(h))) {
        return false;
    }
    match shared.map(usize::from).iter().sum() {
        // The patch touches f along one edge, and must not touch the third vertex as well.
        1 => find(halfedges, shared, true).is_some_and(|h| !touches(surface, patch_of, topology.opposite(h), patch)),
        // The border of the patch runs through the common vertex of both edges once, so the vertex becomes an inner one.
        2 => find(halfedges, shared, false).is_some_and(|h| network.corner_of_vertex[topology.opposite(h)].is_none()),
        _ => false,
    }
}

/// True when the patch of face `f` stays a disk without `f`.
pub(crate) fn can_remove(surface: &Measured, patch_of: &PatchOf, f: FaceId) -> bool {
    let topology = surface.topology;
    let halfedges = topology.halfedges(f);
    let own = patch_of[f];
    let shared = halfedges.map(|h| topology.twin(h).is_some_and(|twin| patch_of[twin.face()] == own));
    match shared.map(usize::from).iter().sum() {
        1 => true,
        // Without f the border runs through the common vertex; it must not do so already.
        2 => find(halfedges, shared, false).is_some_and(|h| is_inner(surface, patch_of, topology.opposite(h))),
        _ => false,
    }
}

fn find(halfedges: [HalfedgeId; 3], shared: [bool; 3], wanted: bool) -> Option<HalfedgeId> {
    halfedges.into_iter().zip(shared).find(|&(_, s)| s == wanted).map(|(h, _)| h)
}

/// True when a face at the vertex is in the patch.
fn touches(surface: &Measured, patch_of: &PatchOf, v: VertexId, patch: PatchId) -> bool {
    surface.topology.fan(v).any(|h| patch_of[h.face()] == Some(patch))
}

/// True when all faces at the vertex are in one patch and close round it.
fn is_inner(surface: &Measured, patch_of: &PatchOf, v: VertexId) -> bool {
    let mut patches = surface.topology.fan(v).map(|h| patch_of[h.face()]);
    let first = patches.next();
    !surface.topology.is_border_vertex(v) && patches.all(|p| Some(p) == first)
}

/// Number of patches when their ids are used up to the greatest.
pub(crate) fn n_patches(patch_of: &PatchOf) -> usize {
    patch_of.iter().flatten().max().map_or(0, |p| p.index() + 1)
}
