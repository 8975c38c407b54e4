//! Whatever the arguments are, there is a result or an error.

use mesh_core::{TriMesh, VertexId};
use odd_arguments::{damaged, id, value};
use proptest::prelude::*;
use region_map::{Domain, Surface};
use subdiv::{SubdivDomain, SubdivError, carried_over, subdivide};

fn is_sound(level: &SubdivDomain, base: &TriMesh) -> bool {
    let n = base.n_faces() << (2 * level.level);
    level.domain.mesh.n_faces() == n && level.origins.len() == level.domain.mesh.n_vertices()
}

proptest! {
    #[test]
    fn subdividing_gives_a_result_or_an_error(
        kind in 0..12u32,
        i in id(),
        value in value(),
        levels in prop_oneof![0..4u32, prop::sample::select(vec![16, 31, 32, 64, u32::MAX])],
    ) {
        let surface = Surface::with_creases(fixtures::cylinder(1.0, 1.0, 8), 40.0).unwrap();
        let base = damaged(&Domain::identity(&surface), kind, i, value, fixtures::l_block(1));
        match subdivide(&base, levels) {
            Ok(level) => prop_assert!(is_sound(&level, &base.mesh)),
            Err(SubdivError::TooLarge { .. }) => prop_assert!(levels > 4),
            Err(_) => {}
        }
    }

    #[test]
    fn carrying_over_gives_a_result_or_an_error(
        kinds in [0..16u32, 0..16u32],
        i in id(),
        value in value(),
        edges in prop::collection::vec([id(), id()], 0..4),
    ) {
        let surface = Surface::with_creases(fixtures::cylinder(1.0, 1.0, 8), 40.0).unwrap();
        let base = Domain::identity(&surface);
        let finest = subdivide(&base, 1).unwrap().domain;
        let [before, after] = [(&finest, kinds[0]), (&base, kinds[1])].map(|(domain, kind)| damaged(domain, kind, i, value, fixtures::l_block(1)));
        let edges: Vec<_> = edges.into_iter().map(|edge| edge.map(VertexId)).collect();
        if let Ok(Some(carried)) = carried_over(&surface, &before, &base.mesh, &after, &edges) {
            prop_assert_eq!(carried.domain.mesh.n_faces(), finest.mesh.n_faces());
            prop_assert!(carried.new_faces.is_empty());
        }
    }
}
