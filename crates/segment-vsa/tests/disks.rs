//! The promise of the stage, on shapes of every topology and on random features: patches are disks that the network bounds.

use mesh_core::{IdVec, Topology, TriMesh, VertexId};
use proptest::prelude::*;
use region_map::{ArcKind, Cells, Network, Segmentation, Surface};
use segment_vsa::{VsaError, VsaOptions, VsaReport, segment};

fn topology(mesh: &TriMesh) -> Topology {
    Topology::new(mesh.faces(), mesh.n_vertices()).expect("a manifold")
}

/// Segments, and checks that the cells are disks that keep the topology of the surface.
fn check(surface: &Surface, options: &VsaOptions) -> (Segmentation, VsaReport) {
    let (segmentation, report) = segment(surface, options).expect("valid options");
    assert_eq!(segmentation.patch_of_face.len(), surface.mesh().n_faces());
    assert!(segmentation.faces_of_patches().iter().all(|faces| !faces.is_empty()));
    let cells = Cells::trace(surface, &segmentation).expect("disks");
    let euler = cells.corners.len() as i64 - cells.arcs.len() as i64 + cells.patches.len() as i64;
    assert_eq!(euler, surface.topology().euler());
    (segmentation, report)
}

/// Arcs at borders and at edges of more than 40 degrees.
fn creased(mesh: TriMesh) -> Surface {
    Surface::with_creases(mesh, 40.0).expect("a manifold")
}

fn options(max_patches: usize) -> VsaOptions {
    VsaOptions { max_patches, ..VsaOptions::default() }
}

/// A flat ring of quads, each cut in two.
fn annulus(sides: u32) -> TriMesh {
    let positions = (0..2 * sides).map(|i| {
        let angle = std::f64::consts::TAU * f64::from(i / 2) / f64::from(sides);
        glam::DVec3::new(angle.cos(), angle.sin(), 0.0) * f64::from(1 + i % 2)
    });
    let faces = (0..sides).flat_map(|i| {
        let (a, b, c, d) = (2 * i, 2 * i + 1, (2 * i + 2) % (2 * sides), (2 * i + 3) % (2 * sides));
        [[a, b, d], [a, d, c]]
    });
    TriMesh::new(positions.collect(), faces.collect()).expect("a mesh")
}

fn tetrahedron() -> TriMesh {
    let p = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let faces = vec![[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
    TriMesh::new(p.map(glam::DVec3::from_array).to_vec(), faces).expect("a mesh")
}

fn shapes() -> Vec<(&'static str, TriMesh)> {
    vec![
        ("tetrahedron", tetrahedron()),
        ("two triangles", fixtures::plane()),
        ("smallest annulus", annulus(3)),
        ("annulus", annulus(24)),
        ("smallest cube", fixtures::cube(1)),
        ("cube", fixtures::cube(5)),
        ("l block", fixtures::l_block(3)),
        ("crossing boxes", fixtures::crossing_boxes(3)),
        ("cylinder", fixtures::cylinder(1.0, 3.0, 24)),
        ("cone", fixtures::cone(1.0, 1.0, 24)),
        ("sphere", fixtures::icosphere(6)),
        ("uv sphere", fixtures::uv_sphere(16)),
        ("torus", fixtures::torus(2.0, 0.7, 24, 12)),
        ("part", fixtures::part(4)),
        ("brick", fixtures::brick(12)),
        ("shell", fixtures::shell(12)),
        ("cad", fixtures::cad(16)),
        ("tap", fixtures::tap(6)),
    ]
}

#[test]
fn every_shape_becomes_disks() {
    for (name, mesh) in shapes() {
        for max_patches in [1, 4, 40, 1000] {
            println!("{name}, {max_patches} patches");
            check(&creased(mesh.clone()), &options(max_patches));
        }
    }
}

#[test]
fn slivers_may_be_merged_whatever_their_size() {
    for (name, mesh) in shapes() {
        println!("{name}");
        let base_edge_length = 0.3 * mesh.diagonal();
        check(&creased(mesh), &VsaOptions { base_edge_length, ..options(8) });
    }
}

#[test]
fn flat_faces_are_patches() {
    let (segmentation, report) = check(&creased(fixtures::cube(4)), &options(6));
    assert_eq!(segmentation.n_patches, 6);
    assert!(report.error < 1e-12 && report.max_spread < 1e-3);
}

#[test]
fn a_smooth_sphere_needs_few_patches() {
    let (segmentation, report) = check(&creased(fixtures::icosphere(8)), &options(64));
    // A cap of 40 degrees covers (1 - cos 40) / 2 of the sphere: at least 9 are needed.
    assert!((9..=20).contains(&segmentation.n_patches), "{} patches", segmentation.n_patches);
    assert!(report.max_spread <= 45.0, "{}", report.max_spread);
}

#[test]
fn the_tip_of_a_cone_is_not_inside() {
    let cone = fixtures::cone(1.0, 1.5, 40);
    let topology = topology(&cone);
    let kinds = ArcKind::by_angle(&cone, &topology, 40.0);
    let is_tip = |v| cone.position(v).z > 1.5 - 1e-9;
    let network = Network::trace(&cone, &topology, &kinds, is_tip, Vec::new()).expect("tables of one mesh");
    assert_eq!(network.corners.len(), 1);
    check(&Surface::new(cone, topology, network).expect("one mesh"), &options(2));
}

#[test]
fn the_same_twice() {
    let part = creased(fixtures::part(5));
    assert_eq!(check(&part, &options(30)), check(&part, &options(30)));
}

#[test]
fn bad_options_are_named() {
    let cube = creased(fixtures::cube(1));
    let refused = |options: &VsaOptions| segment(&cube, options).expect_err("refused");
    assert_eq!(refused(&options(0)), VsaError::ZeroCount);
    assert_eq!(refused(&VsaOptions { max_angle: 90.0, ..options(6) }), VsaError::MaxAngle(90.0));
    assert_eq!(refused(&VsaOptions { compactness: -1.0, ..options(6) }), VsaError::Compactness(-1.0));
    assert!(matches!(refused(&VsaOptions { base_edge_length: f64::NAN, ..options(6) }), VsaError::BaseEdgeLength(_)));
}

/// Random edges as creases and random vertices as corners, however senseless: isolated chains, crosses, dots.
fn scribble(mesh: TriMesh, edges: &[usize], corners: &[usize]) -> Surface {
    let topology = topology(&mesh);
    let mut kinds: IdVec<_, _> = topology.edge_ids().map(|e| topology.is_border_edge(e).then_some(ArcKind::Border)).collect();
    let all: Vec<_> = topology.edge_ids().collect();
    for &i in edges {
        kinds[all[i % all.len()]].get_or_insert(ArcKind::Sharp);
    }
    let corners: Vec<VertexId> = corners.iter().map(|&i| VertexId((i % mesh.n_vertices()) as u32)).collect();
    let network = Network::trace(&mesh, &topology, &kinds, |v| corners.contains(&v), Vec::new()).expect("tables of one mesh");
    Surface::new(mesh, topology, network).expect("one mesh")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn random_features_are_never_inside(
        shape in 0..6_usize,
        edges in prop::collection::vec(any::<prop::sample::Index>(), 0..60),
        corners in prop::collection::vec(any::<prop::sample::Index>(), 0..6),
        max_patches in 1..20_usize,
        size in 0.0..0.5_f64,
    ) {
        let mesh = match shape {
            0 => tetrahedron(),
            1 => annulus(7),
            2 => fixtures::cube(3),
            3 => fixtures::icosphere(3),
            4 => fixtures::torus(2.0, 0.7, 9, 7),
            _ => fixtures::plane(),
        };
        let n = 3 * mesh.n_faces();
        let pick = |list: &[prop::sample::Index]| list.iter().map(|i| i.index(n)).collect::<Vec<_>>();
        let base_edge_length = size * mesh.diagonal();
        let surface = scribble(mesh, &pick(&edges), &pick(&corners));
        check(&surface, &VsaOptions { base_edge_length, ..options(max_patches) });
    }
}
