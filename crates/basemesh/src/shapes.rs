//! Segmented shapes for the tests of this crate.

use crate::{BaseOptions, build};
use mesh_core::{FaceId, Topology, TriMesh};
use region_map::{ArcKind, BaseMesh, Cells, Network, PatchId, Segmentation, SheetNormals, Sizing, Surface};
use segment_cvt::{CvtOptions, sample};

/// A mesh with its network and patches.
pub(crate) struct Shape {
    pub(crate) mesh: TriMesh,
    pub(crate) topology: Topology,
    pub(crate) network: Network,
    pub(crate) cells: Cells,
    normals: SheetNormals,
}

impl Shape {
    /// Creases above 40 degrees; patches are the connected parts of equal labels.
    pub(crate) fn new(mesh: TriMesh, label: impl Fn(&TriMesh, FaceId) -> u32) -> Self {
        let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
        let kinds = ArcKind::by_angle(&mesh, &topology, 40.0);
        let network = Network::trace(&mesh, &topology, &kinds, |_| false, Vec::new());
        let same = |e| topology.edge_faces(e).1.is_some_and(|g| label(&mesh, topology.edge_faces(e).0) == label(&mesh, g));
        let (patches, n_patches) = topology.regions(|e| kinds[e].is_none() && same(e));
        let patch_of_face = patches.iter().map(|&p| PatchId(p)).collect();
        let segmentation = Segmentation { patch_of_face, n_patches };
        let cells = Cells::trace(&mesh, &topology, &network, &segmentation).unwrap();
        let normals = SheetNormals::new(&mesh, &topology, &network);
        Self { mesh, topology, network, cells, normals }
    }

    pub(crate) fn surface(&self) -> Surface<'_> {
        Surface { mesh: &self.mesh, topology: &self.topology, network: &self.network, normals: &self.normals }
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
        let sizing = Sizing::uniform(&self.mesh);
        let wanted = CvtOptions { base_vertices: n_sites, ..Default::default() };
        let sampled = sample(&self.mesh, &self.cells, &sizing, &wanted).unwrap();
        let options = BaseOptions { base_vertices: n, rounds, ..Default::default() };
        build(&self.surface(), &self.cells, &sampled.sites, &sizing, &options).unwrap()
    }

    /// Everything that a base mesh promises.
    pub(crate) fn check(&self, base: &BaseMesh) {
        let topology = Topology::new(base.mesh.faces(), base.mesh.n_vertices()).unwrap();
        assert_eq!(topology.euler(), self.topology.euler());
        assert_eq!(topology.components().1, self.topology.components().1);
        assert_eq!(topology.border_loops().len(), self.topology.border_loops().len());
        base.region.check(&topology, &self.network).unwrap();
        assert_simplicial(&base.mesh);
        let kept: f64 = base.region.spans.values().map(|s| (s.to - s.from).abs()).sum();
        assert!((kept - self.network.total_length()).abs() < 1e-9 * kept.max(1.0), "every arc lies on base edges");
        let error = base.round_trip_error(&self.mesh, 200);
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
