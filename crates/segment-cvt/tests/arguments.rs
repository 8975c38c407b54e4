//! Whatever the arguments are, there are sites or an error, and no panic.

use mesh_core::{IdVec, TriMesh};
use odd_arguments::{odd, shape, unit};
use proptest::prelude::*;
use region_map::{Cells, Sizing, Surface};
use segment_cvt::{CvtError, CvtOptions, sample};
use segment_vsa::{VsaOptions, segment};

/// A surface with its cells.
fn patched(mesh: TriMesh) -> Option<(Surface, Cells)> {
    let surface = Surface::with_creases(mesh, 40.0).unwrap();
    let (segmentation, _) = segment(&surface, &VsaOptions::default()).ok()?;
    let cells = Cells::trace(&surface, &segmentation).unwrap();
    Some((surface, cells))
}

#[test]
fn what_is_wrong_is_named() {
    let (surface, cells) = patched(fixtures::cube(2)).unwrap();
    let (other, other_cells) = patched(fixtures::cube(4)).unwrap();
    let options = CvtOptions { base_vertices: 20, ..CvtOptions::default() };
    let uniform = Sizing::uniform(surface.mesh());
    let refused = |cells: &Cells, sizing: &Sizing, options: &CvtOptions| sample(&surface, cells, sizing, options).unwrap_err();
    assert_eq!(refused(&other_cells, &uniform, &options), CvtError::OtherMesh("the complex of cells"));
    assert_eq!(refused(&cells, &Sizing::uniform(other.mesh()), &options), CvtError::OtherMesh("the sizing field"));
    assert_eq!(
        refused(&cells, &uniform, &CvtOptions { base_vertices: 1_000_001, ..options.clone() }),
        CvtError::TooMany(1_000_001)
    );
    for h in [0.0, -1.0, 1e-61, 1e61, f64::INFINITY, 1e7] {
        let mut sizing = uniform.clone();
        sizing.relative[mesh_core::VertexId(5)] = h;
        assert_eq!(refused(&cells, &sizing, &options), CvtError::Sizing(h));
    }
    // The first of a field of no numbers.
    let no_numbers = Sizing { relative: IdVec::filled(f64::NAN, surface.mesh().n_vertices()) };
    assert!(matches!(refused(&cells, &no_numbers, &options), CvtError::Sizing(h) if h.is_nan()));
}

#[test]
fn a_strip_as_thin_as_a_hair_gets_what_its_topology_needs() {
    for width in [1e-3, 1e-9, 1e-15, 1e-100] {
        let points = [[0.0, 0.0], [1.0, 0.0], [1.0, width], [0.0, width]].map(|[x, y]| glam::DVec3::new(x, y, 0.0));
        let strip = TriMesh::new(points.to_vec(), vec![[0, 1, 2], [0, 2, 3]]).unwrap();
        let surface = Surface::with_creases(strip, 40.0).unwrap();
        let segmentation = region_map::Segmentation { patch_of_face: IdVec::filled(region_map::PatchId(0), 2), n_patches: 1 };
        let cells = Cells::trace(&surface, &segmentation).unwrap();
        let options = CvtOptions { base_vertices: 40, ..CvtOptions::default() };
        let sampled = sample(&surface, &cells, &Sizing::uniform(surface.mesh()), &options).unwrap();
        assert_eq!(sampled.budget.total, 40, "{width}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn nothing_panics(
        which in 0..6usize,
        of_cells in prop_oneof![8 => Just(None), 1 => (0..6usize).prop_map(Some)],
        unit in unit(),
        lengths in prop_oneof![
            prop::collection::vec(0.5..2.0f64, 1..20),
            prop::collection::vec(1e-3..1e3f64, 1..20),
            prop::collection::vec(odd(), 1..20),
        ],
        base_vertices in prop_oneof![5 => 0..300usize, 1 => Just(usize::MAX)],
        seed in any::<u64>(),
        max_steps in prop_oneof![0..20usize, Just(usize::MAX)],
    ) {
        let Some((surface, own_cells)) = patched(shape(which, unit)) else { return Ok(()) };
        let cells = of_cells.and_then(|w| patched(shape(w, 1.0))).map_or(own_cells, |p| p.1);
        let relative = lengths.iter().copied().cycle().take(surface.mesh().n_vertices()).collect();
        let options = CvtOptions { base_vertices, seed, max_steps };
        if let Ok(sampled) = sample(&surface, &cells, &Sizing { relative }, &options) {
            prop_assert!(of_cells.is_some() || sampled.budget.total >= base_vertices);
        }
    }
}
