//! Small base meshes on fine ones: a map wherever there can be one, a reason where not.

use basemesh::Mended;
use glam::{DVec2, DVec3};
use mesh_core::{FaceId, Id as _, SurfacePoint, Topology, TriMesh, VertexId};
use region_map::{ArcKind, BaseMesh, Surface};
use trace_base::{TraceError, TracedBase, trace};

fn shape(mesh: TriMesh) -> Surface {
    let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
    let network = features::detect(&mesh, &topology, &[], 0.0, &Default::default()).unwrap();
    Surface::new(mesh, topology, network).unwrap()
}

/// A base mesh with a map, and the surface with the network that it follows.
struct Mapped {
    surface: Surface,
    base: BaseMesh,
}

/// Traces, and checks all that is promised of a base mesh with a map.
fn traced(surface: &Surface, base: &TriMesh) -> Mapped {
    let traced = trace(surface, base).unwrap();
    let surface = traced.surface;
    let base = match traced.base {
        TracedBase::Mapped(base) => base,
        TracedBase::Unmapped { reason, .. } => panic!("{reason}"),
    };
    base.domain.check(surface.network()).unwrap();
    assert_eq!(base.map.charts().len(), base.mesh().n_faces());
    let mapped = Mapped { surface, base };
    mapped.check_area();
    mapped.check_round_trip();
    mapped.check_corners();
    mapped
}

impl Mapped {
    /// The charts cover the surface once.
    fn check_area(&self) {
        let mesh = self.surface.mesh();
        let area = |f: &region_map::ChartFace| {
            mesh_core::area(f.barycentric.map(|b| SurfacePoint { face: f.source, barycentric: b }.position(mesh)))
        };
        let covered: f64 = self.base.map.charts().iter().flat_map(|c| c.faces()).map(area).sum();
        assert!((covered / mesh.total_area() - 1.0).abs() < 1e-9);
    }

    fn check_round_trip(&self) {
        let (mesh, network, base) = (self.surface.mesh(), self.surface.network(), &self.base);
        let tolerance = 1e-9 * mesh.diagonal();
        for face in mesh.faces().ids() {
            for weights in [DVec3::new(0.2, 0.3, 0.5), DVec3::new(0.98, 0.01, 0.01)] {
                let point = SurfacePoint { face, barycentric: weights };
                let (f, w) = base.map.find(point).unwrap();
                let back = base.map.locate(f, w).position(mesh);
                assert!(back.distance(point.position(mesh)) < tolerance);
                // A map keeps to its sheet.
                let sheet = base.domain.region.sheet_of_face[FaceId::new(f.index())];
                assert_eq!(network.sheet_of_face[face], sheet);
            }
        }
    }

    /// The map puts the corners of every base face where its vertices are.
    fn check_corners(&self) {
        let (mesh, base) = (self.surface.mesh(), &self.base);
        for f in base.mesh().faces().ids() {
            for (c, w) in [DVec3::X, DVec3::Y, DVec3::Z].into_iter().enumerate() {
                let at = base.locate(f, w).position(mesh);
                assert!(at.distance(base.mesh().position(base.mesh().face(f)[c])) < 1e-9 * mesh.diagonal());
            }
        }
    }
}

/// Vertices at corners, on arcs and in sheets.
fn counts(mapped: &Mapped) -> [usize; 3] {
    let counts = mapped.base.domain.region.class_counts();
    [counts.at_corners, counts.on_arcs, counts.in_sheets]
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
        let traced = traced(&cube, &fixtures::cube(1));
        assert_eq!((traced.surface.network().corners.len(), traced.surface.network().arcs.len()), (8, 12));
        assert_eq!(counts(&traced), [8, 0, 0]);
    }
}

#[test]
fn a_base_mesh_that_is_off_is_pulled_to_corners_and_creases() {
    let cube = shape(fixtures::cube(6));
    let off = |p: DVec3| p + 0.05 * DVec3::new((7.0 * p.y).sin(), (5.0 * p.z).cos(), (9.0 * p.x).sin());
    let traced = traced(&cube, &moved(&fixtures::cube(3), off));
    assert_eq!(traced.surface.network().arcs.len(), 12);
    assert_eq!(counts(&traced), [8, 24, 24]);
}

#[test]
fn platonic_solids_on_a_ball() {
    let ball = shape(fixtures::icosphere(12));
    let spin = |p: DVec3| 0.9 * DVec3::new(0.6 * p.x - 0.8 * p.y, 0.8 * p.x + 0.6 * p.y, p.z);
    for base in [octahedron(), fixtures::icosphere(1), fixtures::icosphere(3)] {
        traced(&ball, &base);
        traced(&ball, &moved(&base, spin));
    }
}

#[test]
fn the_surface_itself_is_a_base_mesh_of_itself() {
    for mesh in [fixtures::icosphere(3), fixtures::l_block(2), fixtures::torus(1.0, 0.4, 12, 8)] {
        let traced = traced(&shape(mesh.clone()), &mesh);
        let apart = mesh.positions().enumerate().map(|(v, p)| p.distance(traced.base.mesh().position(v)));
        assert!(apart.fold(0.0, f64::max) < 1e-12);
    }
}

#[test]
fn a_base_mesh_that_faces_inwards_is_turned_round() {
    let ball = shape(fixtures::icosphere(6));
    let traced = traced(&ball, &turned(&octahedron()));
    let f = FaceId::new(0);
    assert!(traced.base.mesh().normal(f).dot(traced.base.mesh().centroid(f)) > 0.0);
}

#[test]
fn a_small_torus_on_a_fine_one() {
    let torus = shape(fixtures::torus(1.0, 0.4, 40, 20));
    traced(&torus, &fixtures::torus(1.0, 0.4, 7, 5));
    traced(&torus, &moved(&fixtures::torus(1.0, 0.4, 6, 4), |p| DVec3::new(0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y, p.z)));
}

#[test]
fn a_prism_on_a_cylinder_keeps_both_rims() {
    let cylinder = shape(fixtures::cylinder(0.5, 1.5, 48));
    let traced = traced(&cylinder, &fixtures::cylinder(0.5, 1.5, 6));
    assert_eq!(traced.surface.network().arcs.len(), 2);
    assert_eq!(counts(&traced)[1], 12);
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
    let traced = traced(&cube, &moved(&octahedron(), |p| spin(0.5 * p + DVec3::splat(0.5))));
    assert!(!traced.surface.network().minor.is_empty() && traced.surface.network().arcs.len() < 12);
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
    let traced = traced(&plane, &square(2));
    assert_eq!(counts(&traced), [4, 4, 1]);
    assert!(traced.surface.network().arcs.iter().all(|a| a.kind == ArcKind::Border));
    // Three corners cannot follow a border with four, so one is given up, but the border is not.
    let triangle = TriMesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::new(0.8, 0.9, 0.0)], vec![[0, 1, 2]]).unwrap();
    match trace(&plane, &triangle) {
        Ok(traced) => assert!(traced.surface.network().arcs.iter().all(|a| a.kind == ArcKind::Border)),
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
    traced(&shape(two(8)), &two(2));
}

#[test]
fn another_topology_is_refused() {
    let ball = shape(fixtures::icosphere(6));
    let refused = |base: &TriMesh| match trace(&ball, base) {
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
    let e = trace(&shape(fixtures::icosphere(3)), &book.unwrap()).unwrap_err();
    assert!(matches!(e, TraceError::NotManifold(_)), "{e}");
}

#[test]
fn the_same_paths_every_time() {
    let torus = shape(fixtures::torus(1.0, 0.4, 30, 15));
    let points = || {
        let traced = traced(&torus, &fixtures::torus(1.0, 0.4, 6, 4));
        let at = |f: FaceId| traced.base.locate(f, DVec3::new(0.2, 0.3, 0.5)).position(torus.mesh());
        traced.base.mesh().faces().ids().map(at).collect::<Vec<_>>()
    };
    assert_eq!(points(), points());
}

#[test]
fn vertices_keep_their_order() {
    let base = fixtures::icosphere(2);
    let traced = traced(&shape(fixtures::icosphere(10)), &base);
    for v in 0..base.n_vertices() {
        let v = VertexId::new(v);
        assert!(base.position(v).distance(traced.base.mesh().position(v)) < 0.02);
    }
}

/// A prism whose lids are fans from a vertex of the rim, as decimation leaves them: the first and the last triangle of each fan have two
/// edges on the rim.
fn prism_with_fans(sides: u32) -> TriMesh {
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
fn straight_corners_are_mended_in_the_map() {
    let raw = fixtures::cylinder(0.5, 1.5, 48);
    let low = raw.positions().iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
    let cylinder = shape(moved(&raw, |p| p - DVec3::Z * (low + 0.75)));
    let Mapped { surface, base } = traced(&cylinder, &prism_with_fans(16));
    let Mended { base, straight_corners, .. } = basemesh::mend(&surface, base).unwrap();
    // Four there are at first, and flips may leave more.
    assert!(straight_corners >= 4 && base.map.n_edits() >= 4, "{straight_corners}");
    let on_rim = |f: &[VertexId; 3]| (0..3).filter(|&c| base.domain.region.span(f[c], f[(c + 1) % 3]).is_some()).count();
    assert!(base.mesh().faces().iter().all(|f| on_rim(f) < 2));
    base.domain.check(surface.network()).unwrap();
}
