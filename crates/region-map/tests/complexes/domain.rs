//! Meshes over a surface: made, placed and checked.

use crate::{shapes, topology};
use glam::DVec3;
use mesh_core::{FaceId, IdVec, MeshError, SurfacePoint, TriMesh};
use region_map::{Domain, DomainError, RegionMap, RegionMapError, Surface};
use std::sync::Arc;

#[test]
fn a_mesh_over_itself_is_a_domain() {
    for (name, mesh, topology, network) in shapes() {
        let surface = Surface::new(mesh, topology, network).unwrap();
        let domain = Domain::identity(&surface);
        domain.check(surface.network()).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(domain.mesh.positions(), surface.mesh().positions(), "{name}");
        // Made of its parts it is the same.
        let again = Domain::new(domain.mesh.clone(), domain.region.clone()).unwrap();
        again.check(surface.network()).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(again.topology.faces(), domain.topology.faces(), "{name}");
    }
}

#[test]
fn placed_vertices_are_at_their_points_and_share_the_topology() {
    let surface = Surface::with_creases(fixtures::cube(2), 40.0).unwrap();
    let domain = Domain::identity(&surface);
    let mut region = domain.region.clone();
    // All vertices in the middle of some face.
    for (i, point) in region.points.iter_mut().enumerate() {
        *point = SurfacePoint::new(FaceId(i as u32), DVec3::ONE);
    }
    let placed = domain.placed(&surface, region.clone()).unwrap();
    for (v, point) in placed.region.points.enumerate() {
        assert_eq!(placed.mesh.position(v), point.position(surface.mesh()));
    }
    assert_eq!(placed.mesh.faces(), domain.mesh.faces());
    assert!(Arc::ptr_eq(&placed.topology, &domain.topology));

    region.points[mesh_core::VertexId(3)].barycentric = DVec3::splat(f64::NAN);
    assert!(matches!(domain.placed(&surface, region.clone()), Err(MeshError::NotFinite { .. })));
    region.points[mesh_core::VertexId(3)] = SurfacePoint::at_corner(FaceId(48), 0);
    assert!(matches!(domain.placed(&surface, region.clone()), Err(MeshError::NotFinite { vertex: 3 })));
    region.points = IdVec::from_vec(region.points.as_slice()[4..].to_vec());
    assert!(domain.placed(&surface, region).is_err());
}

#[test]
fn maps_of_other_meshes_and_what_is_no_manifold_are_refused() {
    let surface = Surface::smooth(fixtures::cube(1)).unwrap();
    let other = fixtures::cube(2);
    let region = RegionMap::identity(surface.topology(), surface.network());
    let wrong = |what, found, expected| RegionMapError::WrongSize { what, found, expected };
    let refused = Domain::new(other.clone(), region.clone()).unwrap_err();
    assert_eq!(refused, DomainError::Region(wrong("attachments", 8, 26)));
    let mut faces = surface.mesh().to_soup().triangles;
    faces.push(faces[0]);
    let twice = TriMesh::new(surface.mesh().positions().as_slice().to_vec(), faces).unwrap();
    assert!(matches!(Domain::new(twice, region), Err(DomainError::NotManifold(_))));

    let domain = Domain::identity(&surface);
    let check = |domain: Domain| domain.check(surface.network());
    assert_eq!(check(Domain { mesh: other, ..domain.clone() }), Err(wrong("the mesh", 26, 8)));
    let other_topology = Arc::new(topology(&fixtures::cube(2)));
    assert_eq!(check(Domain { topology: other_topology, ..domain }), Err(wrong("the mesh", 8, 26)));
}
