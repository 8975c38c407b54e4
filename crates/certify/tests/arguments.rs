//! Any arguments: an error or a result, never a panic.

use certify::{MeasureOptions, Reference, certify, component_counts, connectivity, faulty_faces, faulty_faces_among};
use glam::DVec3;
use mesh_core::{FaceId, TriMesh};
use proptest::prelude::*;

/// Few positions on a small grid or anywhere, so that many are equal, and faces at random: neither manifold nor oriented.
fn mesh() -> impl Strategy<Value = TriMesh> {
    let coordinate = prop_oneof![
        4 => (-1i8..=1).prop_map(f64::from),
        4 => -1.0..1.0,
        1 => prop::sample::select(vec![-0.0, 5e-324, 1e-160, 1e75, 1e160, f64::MAX, f64::MIN]),
    ];
    let positions = prop::collection::vec(prop::array::uniform3(coordinate).prop_map(DVec3::from_array), 3..10);
    let faces = prop::collection::vec(prop::array::uniform3(0u32..10), 0..20);
    (positions, faces).prop_map(|(positions, faces)| {
        let n = positions.len() as u32;
        let faces = faces.into_iter().map(|f| f.map(|v| v % n)).filter(|f| f[0] != f[1] && f[1] != f[2] && f[2] != f[0]);
        TriMesh::new(positions, faces.collect()).unwrap()
    })
}

fn levels() -> impl Strategy<Value = u32> {
    prop_oneof![0u32..4, any::<u32>()]
}

proptest! {
    #[test]
    fn any_two_meshes_are_measured_or_refused(a in mesh(), b in mesh(), levels in levels(), samples in 0usize..50) {
        let Ok(reference) = Reference::new(a.clone()) else { return Ok(()) };
        prop_assert_eq!(reference.self_intersecting(), certify::self_intersecting(&a));
        if let Ok(certificate) = certify(&reference, &b, levels, &MeasureOptions { samples }) {
            let again = certify(&Reference::new(a).unwrap(), &b, levels, &MeasureOptions { samples }).unwrap();
            // Figures that are not numbers are not equal to themselves.
            prop_assert_eq!(format!("{certificate:?}"), format!("{again:?}"));
        }
    }

    #[test]
    fn faults_of_some_faces_are_those_of_all(a in mesh(), b in mesh(), some in prop::collection::vec(0u32..30, 0..30)) {
        let Ok(reference) = Reference::new(a) else { return Ok(()) };
        let some: Vec<FaceId> = some.into_iter().map(FaceId).collect();
        let (all, found) = (faulty_faces(&reference, &b), faulty_faces_among(&reference, &b, &some));
        let among = |faces: &[FaceId]| faces.iter().copied().filter(|f| some.contains(f)).collect::<Vec<_>>();
        prop_assert_eq!(&found.flipped, &among(&all.flipped));
        prop_assert_eq!(&found.degenerate, &among(&all.degenerate));
        prop_assert_eq!(found.faces(), among(&all.faces()));
    }

    #[test]
    fn any_mesh_has_counts_and_a_quality(mesh in mesh(), levels in levels()) {
        let faces: i64 = component_counts(&mesh).iter().map(|c| c.faces).sum();
        prop_assert_eq!(faces as usize, mesh.n_faces());
        prop_assert_eq!(certify::TopologyCounts::of(&mesh).faces, mesh.n_faces());
        let valences: usize = certify::quality(&mesh).valences.values().sum();
        prop_assert!(valences <= mesh.n_vertices() && certify::weld(&mesh).n_vertices() <= mesh.n_vertices());
        if let Ok(hierarchy) = connectivity(&mesh, levels) {
            prop_assert_eq!((hierarchy.depth(), hierarchy.base().faces << (2 * levels)), (levels, mesh.n_faces()));
        }
    }
}
