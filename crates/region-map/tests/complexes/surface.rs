//! The surface: what it checks, what its copies share, and where its indices find their points.

use crate::{crease_network, topology};
use glam::DVec3;
use mesh_core::{EdgeId, FaceId, HalfedgeId, SurfaceIndex, Topology, TriMesh, VertexId};
use region_map::{ArcId, CornerId, Network, NetworkError, SheetId, Surface, SurfaceError};

fn cube() -> Surface {
    Surface::with_creases(fixtures::cube(3), 40.0).unwrap()
}

#[test]
fn creases_are_those_of_the_angle_and_a_smooth_surface_has_none() {
    let counts = |s: &Surface| (s.network().corners.len(), s.network().arcs.len(), s.network().n_sheets);
    assert_eq!(counts(&cube()), (8, 12, 6));
    for smooth in [Surface::smooth(fixtures::cube(3)).unwrap(), Surface::with_creases(fixtures::cube(3), 90.1).unwrap()] {
        assert_eq!(counts(&smooth), (0, 0, 1));
    }
    // Borders are arcs whatever the angle.
    assert_eq!(counts(&Surface::smooth(fixtures::plane()).unwrap()), (0, 1, 1));
}

#[test]
fn an_index_is_built_once_and_shared_by_copies_and_by_other_networks() {
    let surface = cube();
    let copy = surface.clone();
    let smooth = Network::trace(
        surface.mesh(),
        surface.topology(),
        &region_map::ArcKind::by_angle(surface.mesh(), surface.topology(), 180.0),
        |_| false,
        Vec::new(),
    );
    let other = surface.with_network(smooth.unwrap()).unwrap();
    let first: &SurfaceIndex = copy.index();
    for same in [surface.index(), copy.index(), other.index(), other.clone().index()] {
        assert!(std::ptr::eq(same, first));
    }
    assert!(std::ptr::eq(surface.mesh(), other.mesh()) && std::ptr::eq(surface.topology(), other.topology()));
    // What depends on the network is shared by copies alone.
    assert!(std::ptr::eq(surface.normals(), copy.normals()));
    assert!(!std::ptr::eq(surface.normals(), other.normals()));
    let of_sheet = |s: &Surface| s.sheet_index(SheetId(0)).map(|i| i as *const SurfaceIndex);
    assert!(of_sheet(&surface).is_some() && of_sheet(&surface) == of_sheet(&copy) && of_sheet(&surface) != of_sheet(&other));
}

#[test]
fn a_sheet_index_knows_the_faces_of_its_sheet_alone() {
    let surface = cube();
    let network = surface.network();
    for sheet in (0..network.n_sheets as u32).map(SheetId) {
        let face = network.sheet_of_face.enumerate().find(|(_, s)| **s == sheet).unwrap().0;
        let normal = surface.mesh().normal(face);
        // The point opposite to the middle of the sheet: the whole surface is near, the sheet a side away.
        let opposite = DVec3::splat(0.5) - 0.5 * normal;
        let at = |index: &SurfaceIndex| index.closest(opposite).unwrap().face;
        assert_ne!(network.sheet_of_face[at(surface.index())], sheet);
        assert_eq!(network.sheet_of_face[at(surface.sheet_index(sheet).unwrap())], sheet);
    }
    assert!(surface.sheet_index(SheetId(6)).is_none() && surface.sheet_index(SheetId(u32::MAX)).is_none());
}

#[test]
fn parts_of_different_meshes_are_refused() {
    let [small, large] = [fixtures::cube(1), fixtures::cube(2)];
    let parts = |mesh: &TriMesh| (topology(mesh), crease_network(mesh, &topology(mesh)));
    let [(t, n), (large_t, large_n)] = [&small, &large].map(parts);
    assert!(Surface::new(small.clone(), t.clone(), n.clone()).is_ok());
    let wrong = |what, found, expected| SurfaceError::Network(NetworkError::WrongSize { what, found, expected });
    let refused = |mesh: &TriMesh, topology: &Topology, network: &Network| {
        Surface::new(mesh.clone(), topology.clone(), network.clone()).unwrap_err()
    };
    assert_eq!(refused(&small, &large_t, &large_n), wrong("the topology's list of vertices", 26, 8));
    assert_eq!(refused(&small, &t, &large_n), wrong("the list of sheets", 48, 12));
    let short_edges = Network { arc_of_edge: large_n.arc_of_edge.clone(), ..n.clone() };
    assert_eq!(refused(&small, &t, &short_edges), wrong("the list of arcs at edges", 72, 18));
    let short_vertices = Network { corner_of_vertex: large_n.corner_of_vertex.clone(), ..n };
    assert_eq!(refused(&small, &t, &short_vertices), wrong("the list of corners at vertices", 26, 8));
    let surface = Surface::new(large, large_t, large_n).unwrap();
    assert_eq!(surface.with_network(short_vertices).unwrap_err(), wrong("the list of sheets", 12, 48));
}

/// What spoils a network.
type Change<'a> = dyn Fn(&mut Network) + 'a;

#[test]
fn what_contradicts_itself_is_refused() {
    let surface = cube();
    let (mesh, topology) = (surface.mesh(), surface.topology());
    let refused = |change: &Change| {
        let mut network = surface.network().clone();
        change(&mut network);
        let mut messages = [
            surface.with_network(network.clone()).unwrap_err().to_string(),
            Surface::new(mesh.clone(), topology.clone(), network).unwrap_err().to_string(),
        ];
        assert_eq!(messages[0], messages[1]);
        std::mem::take(&mut messages[0])
    };
    let (no_vertex, no_corner, no_arc, no_sheet) = (VertexId(56), CornerId(8), ArcId(12), SheetId(6));
    let (v, e, f, a, c) = (VertexId(0), EdgeId(0), FaceId(0), ArcId(0), CornerId(0));
    let of_arc = "the network contradicts itself: an arc has no edge, tables of different lengths, or parts that are not there";
    let cases: [(&str, &Change); 13] = [
        ("the network contradicts itself: there are more sheets than faces", &|n| n.n_sheets = usize::MAX),
        ("the network contradicts itself: a face is in a sheet that is not there", &|n| n.sheet_of_face[f] = no_sheet),
        ("the network contradicts itself: an edge is on an arc that is not there", &|n| n.arc_of_edge[e] = Some(no_arc)),
        ("the network contradicts itself: a vertex is at a corner that is not there", &|n| {
            n.corner_of_vertex[v] = Some(no_corner)
        }),
        ("the network contradicts itself: a corner is at a vertex that is not there", &|n| n.corners[c] = no_vertex),
        ("a minor crease runs through vertex 56, which is not there", &|n| n.minor.push(vec![no_vertex])),
        (of_arc, &|n| n.arcs[a].vertices[1] = no_vertex),
        (of_arc, &|n| n.arcs[a].vertices.clear()),
        (of_arc, &|n| n.arcs[a].lengths.clear()),
        (of_arc, &|n| n.arcs[a].halfedges.clear()),
        (of_arc, &|n| n.arcs[a].halfedges[0] = HalfedgeId::of(FaceId(108), 0)),
        (of_arc, &|n| n.arcs[a].corners = Some([c, no_corner])),
        (of_arc, &|n| n.arcs[a].sheets[1] = Some(no_sheet)),
    ];
    for (message, change) in cases {
        assert_eq!(refused(change), message);
    }
    let mut turned = mesh.to_soup().triangles;
    turned.reverse();
    let turned = TriMesh::new(mesh.positions().as_slice().to_vec(), turned).unwrap();
    let other = Surface::new(turned, topology.clone(), surface.network().clone()).unwrap_err();
    assert_eq!(other, SurfaceError::OtherTopology);
}

#[test]
fn a_vertex_without_faces_and_what_is_no_manifold_are_refused() {
    let plane = fixtures::plane();
    let positions = plane.positions().iter().copied().chain([DVec3::Z]).collect();
    let with_spare = TriMesh::new(positions, plane.to_soup().triangles).unwrap();
    let refused = Surface::smooth(with_spare).unwrap_err();
    assert_eq!(refused, SurfaceError::UnusedVertex(VertexId(4)));
    assert_eq!(refused.to_string(), "vertex 4 belongs to no face; clean the mesh first");

    let twice = TriMesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z], vec![[0, 1, 2], [0, 1, 3]]).unwrap();
    assert!(matches!(Surface::smooth(twice), Err(SurfaceError::NotManifold(_))));
}
