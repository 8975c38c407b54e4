//! Whatever the arguments are, there is a network or an error, and no panic.

use features::{FeatureError, FeatureOptions, detect};
use mesh_core::{Topology, TriMesh, VertexId};
use odd_arguments::{odd, shape, unit};
use proptest::prelude::*;

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
        rounded_width in odd(),
    ) {
        let mesh = shape(which, unit);
        let marked: Vec<_> = marked.iter().map(|e| e.map(VertexId)).collect();
        let options = FeatureOptions { strong_angle: angles[0], weak_angle: angles[1], persistence, rounded_width };
        if let Ok(network) = detect(&mesh, &topology(&mesh), &marked, base_edge_length, &options) {
            // It is a network of this mesh.
            prop_assert!(region_map::Surface::new(mesh.clone(), topology(&mesh), network).is_ok());
        }
    }
}
