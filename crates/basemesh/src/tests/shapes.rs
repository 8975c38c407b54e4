//! Segmented shapes for the tests of this crate.

use crate::{BaseOptions, build};
use mesh_core::{FaceId, TriMesh};
use region_map::{BaseMesh, Cells, PatchId, Segmentation, Sizing, Surface};
use segment_cvt::{CvtOptions, sample};

/// A surface with its patches.
pub(crate) struct Shape {
    pub(crate) surface: Surface,
    pub(crate) cells: Cells,
}

impl Shape {
    /// Creases above 40 degrees; patches are the connected parts of equal labels.
    pub(crate) fn new(mesh: TriMesh, label: impl Fn(&TriMesh, FaceId) -> u32) -> Self {
        let surface = Surface::with_creases(mesh, 40.0).unwrap();
        let (mesh, topology) = (surface.mesh(), surface.topology());
        let same = |e| topology.edge_faces(e).1.is_some_and(|g| label(mesh, topology.edge_faces(e).0) == label(mesh, g));
        let (patches, n_patches) = topology.regions(|e| !surface.network().is_barrier(e) && same(e));
        let patch_of_face = patches.iter().map(|&p| PatchId(p)).collect();
        let cells = Cells::trace(&surface, &Segmentation { patch_of_face, n_patches }).unwrap();
        Self { surface, cells }
    }

    pub(crate) fn cube() -> Self {
        Self::new(fixtures::cube(6), |_, _| 0)
    }
    pub(crate) fn box_of_twelve() -> Self {
        Self::new(fixtures::cube(1), |_, _| 0)
    }
    /// The side of a cylinder in four quarters.
    pub(crate) fn cylinder() -> Self {
        Self::new(fixtures::cylinder(1.0, 2.0, 24), |m, f| {
            let c = m.centroid(f);
            if m.normal(f).z.abs() > 0.9 { 9 } else { u32::from(c.x > 0.0) + 2 * u32::from(c.y > 0.0) }
        })
    }
    /// A sphere in eight octants.
    pub(crate) fn sphere() -> Self {
        Self::new(fixtures::icosphere(8), |m, f| {
            let c = m.centroid(f);
            u32::from(c.x > 0.0) + 2 * u32::from(c.y > 0.0) + 4 * u32::from(c.z > 0.0)
        })
    }
    /// A torus in four by four parts.
    pub(crate) fn torus() -> Self {
        let quarter = |a: f64| (a.rem_euclid(std::f64::consts::TAU) / std::f64::consts::FRAC_PI_2) as u32;
        Self::new(fixtures::torus(2.0, 0.8, 32, 20), move |m, f| {
            let c = m.centroid(f);
            quarter(c.y.atan2(c.x)) + 4 * quarter(c.z.atan2(c.truncate().length() - 2.0))
        })
    }

    /// A base mesh of about `n` vertices, with or without improvement.
    pub(crate) fn base(&self, n: usize, rounds: usize) -> BaseMesh {
        self.base_from(n, n, rounds)
    }

    /// A base mesh of about `n` vertices that starts from about `n_sites` sites.
    pub(crate) fn base_from(&self, n_sites: usize, n: usize, rounds: usize) -> BaseMesh {
        let sizing = Sizing::uniform(self.surface.mesh());
        let wanted = CvtOptions { base_vertices: n_sites, ..Default::default() };
        let sampled = sample(&self.surface, &self.cells, &sizing, &wanted).unwrap();
        let options = BaseOptions { base_vertices: n, rounds, ..Default::default() };
        build(&self.surface, &self.cells, &sampled.sites, &sizing, &options).unwrap()
    }

    /// Everything that a base mesh promises.
    pub(crate) fn check(&self, base: &BaseMesh) {
        let (topology, working) = (&base.domain.topology, self.surface.topology());
        assert_eq!(topology.euler(), working.euler());
        assert_eq!(topology.components().1, working.components().1);
        assert_eq!(topology.border_loops().len(), working.border_loops().len());
        base.domain.check(self.surface.network()).unwrap();
        assert_simplicial(base.mesh());
        let kept: f64 = base.domain.region.spans.values().map(|s| (s.to - s.from).abs()).sum();
        assert!((kept - self.surface.network().total_length()).abs() < 1e-9 * kept.max(1.0), "every arc lies on base edges");
        let error = base.round_trip_error(self.surface.mesh(), 200);
        assert!(error <= 1e-9, "round trip is off by {error:e} of the diagonal");
    }
}

fn assert_simplicial(mesh: &TriMesh) {
    let mut triangles: Vec<_> = mesh
        .faces()
        .iter()
        .map(|f| {
            let mut f = *f;
            f.sort_unstable();
            f
        })
        .collect();
    triangles.sort_unstable();
    assert!(triangles.windows(2).all(|w| w[0] != w[1]), "no triangle repeats");
}
