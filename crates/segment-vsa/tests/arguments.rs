//! Whatever the arguments are, there are patches or an error, and no panic.

use mesh_core::IdVec;
use odd_arguments::{odd, shape, unit};
use proptest::prelude::*;
use region_map::{Cells, PatchId, Segmentation, Surface};
use segment_vsa::{SplitError, VsaOptions, segment, split};

#[test]
fn what_cannot_be_split_is_named() {
    let surface = Surface::with_creases(fixtures::cube(2), 40.0).unwrap();
    let (segmentation, _) = segment(&surface, &VsaOptions { max_patches: 6, ..VsaOptions::default() }).unwrap();
    assert_eq!(segmentation.n_patches, 6);
    for p in [PatchId(6), PatchId(u32::MAX)] {
        assert_eq!(split(&surface, &segmentation, &[PatchId(0), p]), Err(SplitError::NoSuchPatch(p)));
    }
    let other = Surface::with_creases(fixtures::cube(3), 40.0).unwrap();
    assert_eq!(split(&other, &segmentation, &[PatchId(0)]), Err(SplitError::OtherMesh));
    for n_patches in [0, 5, usize::MAX] {
        let wrong = Segmentation { n_patches, ..segmentation.clone() };
        assert_eq!(split(&surface, &wrong, &[]), Err(SplitError::OtherMesh));
    }
}

#[test]
fn a_patch_that_is_named_twice_is_cut_once() {
    let surface = Surface::with_creases(fixtures::cube(4), 40.0).unwrap();
    let (segmentation, _) = segment(&surface, &VsaOptions { max_patches: 6, ..VsaOptions::default() }).unwrap();
    let once = split(&surface, &segmentation, &[PatchId(2)]).unwrap();
    assert_eq!(split(&surface, &segmentation, &[PatchId(2), PatchId(2)]).unwrap(), once);
    assert!(once.n_patches > 6 && once.faces_of_patches().iter().all(|faces| !faces.is_empty()));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn segmenting_never_panics(
        which in 0..6usize,
        unit in unit(),
        max_angle in prop_oneof![Just(40.0), odd()],
        max_patches in prop_oneof![0..30usize, Just(usize::MAX)],
        rounds in prop_oneof![0..12usize, Just(usize::MAX)],
        base_edge_length in prop_oneof![Just(0.1), odd()],
        compactness in prop_oneof![Just(0.0), Just(0.3), odd()],
    ) {
        let surface = Surface::with_creases(shape(which, unit), 40.0).unwrap();
        let options = VsaOptions { max_angle, max_patches, rounds, base_edge_length, compactness };
        if let Ok((segmentation, _)) = segment(&surface, &options) {
            prop_assert!(Cells::trace(&surface, &segmentation).is_ok());
        }
    }

    /// Patches at random are no disks: what is split may be any set of faces.
    #[test]
    fn splitting_never_panics(
        which in 0..6usize,
        patches in prop::collection::vec(0..9u32, 1..200),
        more in 0..3usize,
        wanted in prop::collection::vec(0..12u32, 0..6),
    ) {
        let surface = Surface::with_creases(shape(which, 1.0), 40.0).unwrap();
        let n = surface.mesh().n_faces();
        let patch_of_face: IdVec<_, _> = patches.iter().cycle().take(n).map(|&p| PatchId(p)).collect();
        let n_patches = patch_of_face.iter().map(|p| p.0 as usize + 1).max().unwrap_or(0) + more;
        let segmentation = Segmentation { patch_of_face, n_patches };
        let wanted: Vec<_> = wanted.into_iter().map(PatchId).collect();
        if let Ok(after) = split(&surface, &segmentation, &wanted) {
            prop_assert_eq!(after.patch_of_face.len(), n);
            prop_assert!(after.patch_of_face.iter().all(|p| (p.0 as usize) < after.n_patches));
        }
    }
}
