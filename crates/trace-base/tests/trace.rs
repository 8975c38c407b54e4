//! Small base meshes on fine ones: a map wherever there can be one, a reason where not.

use glam::{DVec2, DVec3};
use mesh_core::{FaceId, Id as _, SurfacePoint, Topology, TriMesh, VertexId};
use region_map::{ArcKind, Network, SheetNormals, Surface};
use trace_base::{TraceError, Traced, trace};

struct Shape {
    mesh: TriMesh,
    topology: Topology,
    network: Network,
}

fn shape(mesh: TriMesh) -> Shape {
    let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
    let network = features::detect(&mesh, &topology, &Default::default()).unwrap();
    Shape { mesh, topology, network }
}

impl Shape {
    fn trace(&self, base: &TriMesh) -> Result<Traced, TraceError> {
        trace(&self.mesh, &self.topology, &self.network, base)
    }

    /// Traces, and checks all that is promised of a base mesh with a map.
    fn traced(&self, base: &TriMesh) -> Traced {
        let traced = self.trace(base).unwrap();
        assert_eq!(traced.untraced, None);
        let domain = Topology::new(traced.base.mesh.faces(), base.n_vertices()).unwrap();
        traced.base.region.check(&domain, &traced.network).unwrap();
        assert_eq!(traced.base.map.charts().len(), base.n_faces());
        // The charts cover the surface once.
        let area = |f: &region_map::ChartFace| {
            let corners = f.barycentric.map(|b| SurfacePoint { face: f.source, barycentric: b }.position(&self.mesh));
            mesh_core::area(corners)
        };
        let covered: f64 = traced.base.map.charts().iter().flat_map(|c| c.faces()).map(area).sum();
        assert!((covered / self.mesh.total_area() - 1.0).abs() < 1e-9);
        self.check_round_trip(&traced);
        self.check_corners(&traced);
        traced
    }

    fn check_round_trip(&self, traced: &Traced) {
        let tolerance = 1e-9 * self.mesh.diagonal();
        for face in self.mesh.faces().ids() {
            for weights in [DVec3::new(0.2, 0.3, 0.5), DVec3::new(0.98, 0.01, 0.01)] {
                let point = SurfacePoint { face, barycentric: weights };
                let (f, w) = traced.base.map.find(point).unwrap();
                let back = traced.base.map.locate(f, w).position(&self.mesh);
                assert!(back.distance(point.position(&self.mesh)) < tolerance);
                // A map keeps to its sheet.
                let sheet = traced.base.region.sheet_of_face[FaceId::new(f.index())];
                assert_eq!(traced.network.sheet_of_face[face], sheet);
            }
        }
    }

    /// The map puts the corners of every base face where its vertices are.
    fn check_corners(&self, traced: &Traced) {
        let base = &traced.base;
        for f in base.mesh.faces().ids() {
            for (c, w) in [DVec3::X, DVec3::Y, DVec3::Z].into_iter().enumerate() {
                let at = base.locate(f, w).position(&self.mesh);
                assert!(at.distance(base.mesh.position(base.mesh.face(f)[c])) < 1e-9 * self.mesh.diagonal());
            }
        }
    }
}

fn octahedron() -> TriMesh {
    let axes = [DVec3::X, DVec3::Y, -DVec3::X, -DVec3::Y, DVec3::Z, -DVec3::Z];
    TriMesh::new(axes.to_vec(), (0..4).flat_map(|i| [[i, (i + 1) % 4, 4], [(i + 1) % 4, i, 5]]).collect()).unwrap()
}

fn moved(mesh: &TriMesh, to: impl Fn(DVec3) -> DVec3) -> TriMesh {
    mesh.with_positions(mesh.positions().iter().map(|&p| to(p)).collect()).unwrap()
}

fn turned(mesh: &TriMesh) -> TriMesh {
    let faces = mesh.faces().iter().map(|f| [f[0].0, f[2].0, f[1].0]).collect();
    TriMesh::new(mesh.positions().as_slice().to_vec(), faces).unwrap()
}

#[test]
fn a_cube_on_a_cube_keeps_all_creases() {
    for n in [1, 2, 7] {
        let cube = shape(fixtures::cube(n));
        let traced = cube.traced(&fixtures::cube(1));
        assert_eq!((traced.network.corners.len(), traced.network.arcs.len()), (8, 12));
        assert_eq!(traced.base.region.class_counts(), [8, 0, 0]);
    }
}

#[test]
fn a_base_mesh_that_is_off_is_pulled_to_corners_and_creases() {
    let cube = shape(fixtures::cube(6));
    let off = |p: DVec3| p + 0.05 * DVec3::new((7.0 * p.y).sin(), (5.0 * p.z).cos(), (9.0 * p.x).sin());
    let traced = cube.traced(&moved(&fixtures::cube(3), off));
    assert_eq!(traced.network.arcs.len(), 12);
    assert_eq!(traced.base.region.class_counts(), [8, 24, 24]);
}

#[test]
fn platonic_solids_on_a_ball() {
    let ball = shape(fixtures::icosphere(12));
    let spin = |p: DVec3| 0.9 * DVec3::new(0.6 * p.x - 0.8 * p.y, 0.8 * p.x + 0.6 * p.y, p.z);
    for base in [octahedron(), fixtures::icosphere(1), fixtures::icosphere(3)] {
        ball.traced(&base);
        ball.traced(&moved(&base, spin));
    }
}

#[test]
fn the_surface_itself_is_a_base_mesh_of_itself() {
    for mesh in [fixtures::icosphere(3), fixtures::l_block(2), fixtures::torus(1.0, 0.4, 12, 8)] {
        let traced = shape(mesh.clone()).traced(&mesh);
        let apart = mesh.positions().enumerate().map(|(v, p)| p.distance(traced.base.mesh.position(v)));
        assert!(apart.fold(0.0, f64::max) < 1e-12);
    }
}

#[test]
fn a_base_mesh_that_faces_inwards_is_turned_round() {
    let ball = shape(fixtures::icosphere(6));
    let traced = ball.traced(&turned(&octahedron()));
    let f = FaceId::new(0);
    assert!(traced.base.mesh.normal(f).dot(traced.base.mesh.centroid(f)) > 0.0);
}

#[test]
fn a_small_torus_on_a_fine_one() {
    let torus = shape(fixtures::torus(1.0, 0.4, 40, 20));
    torus.traced(&fixtures::torus(1.0, 0.4, 7, 5));
    torus.traced(&moved(&fixtures::torus(1.0, 0.4, 6, 4), |p| DVec3::new(0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y, p.z)));
}

#[test]
fn a_prism_on_a_cylinder_keeps_both_rims() {
    let cylinder = shape(fixtures::cylinder(0.5, 1.5, 48));
    let traced = cylinder.traced(&fixtures::cylinder(0.5, 1.5, 6));
    assert_eq!(traced.network.arcs.len(), 2);
    assert_eq!(traced.base.region.class_counts()[1], 12);
}

#[test]
fn creases_that_the_base_mesh_does_not_have_are_minor() {
    let cube = shape(fixtures::cube(8));
    // Turned by a quarter of a right angle: no base edge lies along a crease.
    let turn = DVec2::from_angle(0.55);
    let spin = |p: DVec3| {
        let q = p - DVec3::splat(0.5);
        let r = turn.rotate(q.truncate());
        let s = turn.rotate(DVec2::new(r.y, q.z));
        DVec3::new(r.x, s.x, s.y) + DVec3::splat(0.5)
    };
    let traced = cube.traced(&moved(&octahedron(), |p| spin(0.5 * p + DVec3::splat(0.5))));
    assert!(!traced.network.minor.is_empty() && traced.network.arcs.len() < 12);
}

#[test]
fn the_border_of_a_sheet_is_followed() {
    let square = |n: u32| {
        let at = |i: u32| DVec3::new(f64::from(i % (n + 1)) / f64::from(n), f64::from(i / (n + 1)) / f64::from(n), 0.0);
        let quads = (0..n * n).map(|i| i / n * (n + 1) + i % n);
        let faces = quads.flat_map(|a| [[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]]).collect();
        TriMesh::new((0..(n + 1) * (n + 1)).map(at).collect(), faces).unwrap()
    };
    let plane = shape(square(9));
    let traced = plane.traced(&square(2));
    assert_eq!(traced.base.region.class_counts(), [4, 4, 1]);
    assert!(traced.network.arcs.iter().all(|a| a.kind == ArcKind::Border));
    // Three corners cannot follow a border with four, so one is given up, but the border is not.
    let triangle = TriMesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::new(0.8, 0.9, 0.0)], vec![[0, 1, 2]]).unwrap();
    match plane.trace(&triangle) {
        Ok(traced) => assert!(traced.network.arcs.iter().all(|a| a.kind == ArcKind::Border)),
        Err(e) => assert!(matches!(e, TraceError::Border(_)), "{e}"),
    }
}

#[test]
fn components_go_to_their_own() {
    let two = |n: usize| {
        let ball = fixtures::icosphere(n);
        let m = ball.n_vertices() as u32;
        let positions = ball.positions().iter().copied().chain(ball.positions().iter().map(|&p| p + 1.5 * DVec3::X)).collect();
        let faces = ball.faces().iter().map(|f| f.map(|v| v.0));
        TriMesh::new(positions, faces.clone().chain(faces.map(|f| f.map(|v| v + m))).collect()).unwrap()
    };
    // They pass through each other.
    shape(two(8)).traced(&two(2));
}

#[test]
fn another_topology_is_refused() {
    let ball = shape(fixtures::icosphere(6));
    let refused = |base: &TriMesh| match ball.trace(base) {
        Err(TraceError::OtherTopology { base, surface }) => (base, surface),
        other => panic!("{other:?}"),
    };
    let (base, surface) = refused(&fixtures::torus(1.0, 0.4, 7, 5));
    assert!(base.contains("Euler number 0") && surface.contains("Euler number 2"), "{base}, {surface}");
    refused(&fixtures::plane());
}

#[test]
fn what_is_not_manifold_is_refused() {
    let book = TriMesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z, -DVec3::Y], vec![[0, 1, 2], [1, 0, 3], [0, 1, 4]]);
    let e = shape(fixtures::icosphere(3)).trace(&book.unwrap()).unwrap_err();
    assert!(matches!(e, TraceError::NotManifold(_)), "{e}");
}

#[test]
fn the_same_paths_every_time() {
    let torus = shape(fixtures::torus(1.0, 0.4, 30, 15));
    let points = || {
        let traced = torus.traced(&fixtures::torus(1.0, 0.4, 6, 4));
        let at = |f: FaceId| traced.base.locate(f, DVec3::new(0.2, 0.3, 0.5)).position(&torus.mesh);
        traced.base.mesh.faces().ids().map(at).collect::<Vec<_>>()
    };
    assert_eq!(points(), points());
}

#[test]
fn vertices_keep_their_order() {
    let base = fixtures::icosphere(2);
    let traced = shape(fixtures::icosphere(10)).traced(&base);
    for v in 0..base.n_vertices() {
        let v = VertexId::new(v);
        assert!(base.position(v).distance(traced.base.mesh.position(v)) < 0.02);
    }
}

/// A prism whose lids are fans from a vertex of the rim, as decimation leaves them.
fn prism_with_ears(sides: u32) -> TriMesh {
    let at = |i: u32| {
        let angle = std::f64::consts::TAU * f64::from(i % sides) / f64::from(sides);
        DVec3::new(0.5 * angle.cos(), 0.5 * angle.sin(), if i < sides { -0.75 } else { 0.75 })
    };
    let mut faces = Vec::new();
    for i in 0..sides {
        let j = (i + 1) % sides;
        faces.extend([[i, j, sides + j], [i, sides + j, sides + i]]);
        if 0 < i && j > 0 {
            faces.extend([[0, j, i], [sides, sides + i, sides + j]]);
        }
    }
    TriMesh::new((0..2 * sides).map(at).collect(), faces).unwrap()
}

#[test]
fn ears_are_mended_in_the_map() {
    let raw = fixtures::cylinder(0.5, 1.5, 48);
    let low = raw.positions().iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
    let cylinder = shape(moved(&raw, |p| p - DVec3::Z * (low + 0.75)));
    let traced = cylinder.traced(&prism_with_ears(16));
    let normals = SheetNormals::new(&cylinder.mesh, &cylinder.topology, &traced.network);
    let (mesh, topology) = (&cylinder.mesh, &cylinder.topology);
    let surface = Surface { mesh, topology, network: &traced.network, normals: &normals };
    let (base, mended) = basemesh::mend(&surface, traced.base.clone()).unwrap();
    // Of every fan the first and the last triangle have two edges on the rim, and flips may leave more.
    assert!(mended.ears >= 4 && base.map.n_edits() >= 4, "{mended:?}");
    let on_rim = |f: &[VertexId; 3]| (0..3).filter(|&c| base.region.span(f[c], f[(c + 1) % 3]).is_some()).count();
    assert!(base.mesh.faces().iter().all(|f| on_rim(f) < 2));
    base.region.check(&Topology::new(base.mesh.faces(), base.mesh.n_vertices()).unwrap(), &traced.network).unwrap();
}
