//! Whatever the arguments are, there is a mesh or an error, and no panic.

use mesh_core::{Topology, TriMesh, VertexId};
use odd_arguments::{odd, shape, unit};
use proptest::prelude::*;
use refine::{RefineError, RefineOptions, refine};

fn topology(mesh: &TriMesh) -> Topology {
    Topology::new(mesh.faces(), mesh.n_vertices()).unwrap()
}

#[test]
fn what_is_wrong_is_named() {
    let mesh = fixtures::cube(1);
    let refused = |topology: &Topology, marked: &[[VertexId; 2]], options: RefineOptions| {
        refine(&mesh, topology, marked, &options).map(|_| ()).unwrap_err()
    };
    let fine = || RefineOptions::new(1.0);
    assert_eq!(refused(&topology(&fixtures::cube(2)), &[], fine()), RefineError::OtherMesh);
    for [a, b] in [[0, 8], [8, 0], [0, 0], [0, u32::MAX]].map(|e| e.map(VertexId)) {
        assert_eq!(refused(&topology(&mesh), &[[a, b]], fine()), RefineError::NotAnEdge(a, b));
    }
    let message = |options: RefineOptions| refused(&topology(&mesh), &[], options).to_string();
    assert_eq!(message(RefineOptions::new(0.0)), "refining option longest_edge is 0, it must be above 0");
    let negative = RefineOptions { shortest_edge: -1.0, ..fine() };
    assert_eq!(message(negative), "refining option shortest_edge is -1, it must be at least 0");
    let steep = RefineOptions { crease_angle: 181.0, ..fine() };
    assert_eq!(message(steep), "refining option crease_angle is 181, it must be 0 to 180 (degrees)");
    let warped = RefineOptions { flatness: f64::NAN, ..fine() };
    assert_eq!(message(warped), "refining option flatness is NaN, it must be at least 0");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn nothing_panics(
        which in 0..6usize,
        unit in unit(),
        marked in prop::collection::vec(prop_oneof![1 => [0..90u32, 0..90u32], 3 => Just([0, 1])], 0..3),
        longest_edge in prop_oneof![odd(), 0.05..1.0f64],
        shortest_edge in prop_oneof![odd(), 0.0..1.0f64],
        crease_angle in odd(),
        most_faces in prop_oneof![Just(0), 0..2000usize],
        flatness in prop_oneof![Just(1e-7), odd()],
    ) {
        let mesh = shape(which, unit);
        let marked: Vec<_> = marked.iter().map(|e| e.map(VertexId)).collect();
        let options = RefineOptions { longest_edge, shortest_edge, crease_angle, most_faces: Some(most_faces), flatness };
        if let Ok(refined) = refine(&mesh, &topology(&mesh), &marked, &options) {
            prop_assert!(refined.marked.iter().flatten().all(|v| (v.0 as usize) < refined.mesh.n_vertices()));
            prop_assert_eq!(refined.source_face.len(), refined.mesh.n_faces());
        }
    }
}
