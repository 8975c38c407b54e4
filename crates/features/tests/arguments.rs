//! Whatever the arguments are, there is a network or an error, and no panic.

use features::{FeatureError, FeatureOptions, detect};
use mesh_core::{Topology, TriMesh, VertexId};
use proptest::prelude::*;

/// Numbers that nobody means to hand in, and ordinary ones.
fn odd() -> impl Strategy<Value = f64> {
    let special = [0.0, -0.0, -1.0, 1.0, 1e-300, 1e300, f64::MAX, f64::MIN_POSITIVE, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    prop_oneof![prop::sample::select(special.to_vec()), 0.0..200.0f64, -1.0..2.0f64]
}

/// A unit of length, so that areas and volumes may be no numbers.
fn unit() -> impl Strategy<Value = f64> {
    prop_oneof![3 => Just(1.0), 1 => prop::sample::select(vec![1e-200, 1e-160, 1e-80, 1e80, 1e160, 1e300])]
}

fn shape(which: usize, unit: f64) -> TriMesh {
    let mesh = match which {
        0 => fixtures::plane(),
        1 => fixtures::cube(2),
        2 => fixtures::cylinder(0.5, 1.0, 8),
        3 => fixtures::torus(1.0, 0.4, 8, 6),
        4 => fixtures::cone(1.0, 1.0, 8),
        _ => fixtures::shell(8),
    };
    let scaled = mesh.positions().iter().map(|&p| unit * (p / mesh.diagonal())).collect();
    mesh.with_positions(scaled).unwrap()
}

fn topology(mesh: &TriMesh) -> Topology {
    Topology::new(mesh.faces(), mesh.n_vertices()).unwrap()
}

#[test]
fn the_topology_of_another_mesh_is_refused() {
    let [small, large] = [1, 2].map(fixtures::cube);
    let mut turned = small.to_soup().triangles;
    turned.reverse();
    let turned = TriMesh::new(small.positions().as_slice().to_vec(), turned).unwrap();
    for other in [large, turned] {
        let refused = detect(&small, &topology(&other), &[], 0.0, &FeatureOptions::default());
        assert_eq!(refused.unwrap_err(), FeatureError::OtherMesh);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn nothing_panics(
        which in 0..6usize,
        unit in unit(),
        marked in prop::collection::vec([0..90u32, 0..90u32], 0..3),
        base_edge_length in odd(),
        angles in prop_oneof![Just([40.0, 25.0]), [odd(), odd()]],
        persistence in odd(),
    ) {
        let mesh = shape(which, unit);
        let marked: Vec<_> = marked.iter().map(|e| e.map(VertexId)).collect();
        let options = FeatureOptions { strong_angle: angles[0], weak_angle: angles[1], persistence };
        if let Ok(network) = detect(&mesh, &topology(&mesh), &marked, base_edge_length, &options) {
            // It is a network of this mesh.
            prop_assert!(region_map::Surface::new(mesh.clone(), topology(&mesh), network).is_ok());
        }
    }
}
