//! Any arguments: an error or a result, never a panic.

use glam::{DVec2, DVec3};
use mesh_core::{
    Bounds, CleanOptions, FaceId, HalfedgeId, Line, Soup, SurfaceIndex, SurfacePoint, Topology, TriMesh, VertexId, angles,
    aspect_ratio, cheapest_filling, clean, closest_on_triangle, exact, inspect, inverse_mean_ratio, normal, walk,
};
use proptest::prelude::*;

/// Any number: ordinary ones often, and the extremes.
fn number() -> impl Strategy<Value = f64> {
    let extremes =
        vec![0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX, f64::MIN, f64::MIN_POSITIVE, 5e-324, 1e154];
    prop_oneof![4 => -2.0..2.0, 1 => prop::sample::select(extremes), 1 => any::<f64>()]
}

fn vector() -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(number()).prop_map(DVec3::from_array)
}

fn index() -> impl Strategy<Value = u32> {
    prop_oneof![8 => 0u32..9, 1 => any::<u32>(), 1 => Just(u32::MAX)]
}

fn faces() -> impl Strategy<Value = Vec<[u32; 3]>> {
    prop::collection::vec(prop::array::uniform3(index()), 0..12)
}

/// Two tetrahedra, closed and open, with any finite positions.
fn mesh() -> impl Strategy<Value = TriMesh> {
    prop::collection::vec(vector(), 8).prop_map(|positions| {
        let finite = |p: DVec3| DVec3::from_array(p.to_array().map(|x| if x.is_finite() { x } else { f64::MAX }));
        let faces = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2], [4, 5, 6], [4, 6, 7], [4, 7, 5]];
        TriMesh::new(positions.into_iter().map(finite).collect(), faces.to_vec()).unwrap()
    })
}

fn face() -> impl Strategy<Value = FaceId> {
    index().prop_map(FaceId)
}

proptest! {
    #[test]
    fn meshes_and_topologies_of_anything(
        positions in prop::collection::vec(vector(), 0..9),
        faces in faces(),
        n in 0usize..12,
    ) {
        if let Ok(mesh) = TriMesh::new(positions.clone(), faces.clone()) {
            prop_assert!(mesh.position_arrays().iter().flatten().all(|x| x.is_finite()));
            prop_assert!(mesh.face_arrays().iter().flatten().all(|&v| (v as usize) < positions.len()));
            let _ = mesh.with_positions(positions.iter().copied().take(n).collect());
            let _ = (mesh.diagonal(), mesh.total_area(), mesh.bounds());
        }
        if let Ok(topology) = Topology::new(&faces.iter().map(|f| f.map(VertexId)).collect(), n) {
            let loops = topology.border_loops();
            let border = topology.edge_ids().filter(|&e| topology.is_border_edge(e)).count();
            prop_assert_eq!(loops.iter().map(Vec::len).sum::<usize>(), border);
            let _ = (topology.genus(), topology.components());
        }
        let soup = Soup { positions, triangles: faces };
        let _ = inspect(&soup);
        let _ = clean(&soup, &CleanOptions::default());
    }

    #[test]
    fn clusters_of_any_faces(mesh in mesh(), faces in prop::collection::vec(face(), 0..9)) {
        let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
        let clusters = topology.clusters(&faces);
        let asked: std::collections::BTreeSet<FaceId> = faces.into_iter().filter(|f| f.0 < 7).collect();
        prop_assert_eq!(clusters.into_iter().flatten().collect::<std::collections::BTreeSet<_>>(), asked);
    }

    #[test]
    fn queries_of_any_index(
        mesh in mesh(),
        faces in prop::collection::vec(face(), 0..9),
        points in prop::collection::vec(vector(), 2..6),
        distance in number(),
    ) {
        for index in [SurfaceIndex::new(&mesh), SurfaceIndex::of_faces(&mesh, faces)] {
            for &p in &points {
                let closest = index.closest(p);
                let _ = (index.closest_within(p, distance), index.closest_where(p, |f| f.0 % 2 == 0));
                let _ = (index.opposes(p, points[0]), index.nearest_opposes(p, points[0]));
                let _ = index.first_hits_both_ways(p, points[1]);
                prop_assert!(p.is_finite() || closest.is_none());
            }
            prop_assert_eq!(index.closest_of_each(&points).len(), points.len());
            prop_assert!(index.faces_that_meet(|_, _| false).is_empty());
        }
    }

    #[test]
    fn walks_from_and_to_anywhere(mesh in mesh(), face in face(), weights in vector(), way in vector(), other in faces()) {
        let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
        let start = SurfacePoint { face, barycentric: weights };
        let walked = walk(&mesh, &topology, start, way, |e| e.0 % 3 != 0);
        prop_assert_eq!(face.0 >= 7, walked.end.face.0 >= 7);
        // A topology of another mesh.
        if let Ok(topology) = Topology::new(&other.iter().map(|f| f.map(VertexId)).collect(), 9) {
            prop_assert!(walk(&mesh, &topology, start, way, |_| true).stopped);
        }
    }

    #[test]
    fn geometry_of_any_points(p in prop::array::uniform5(vector()), corner in any::<usize>(), face in face()) {
        let triangle = [p[0], p[1], p[2]];
        let _ = (normal(triangle), aspect_ratio(triangle), angles(triangle), inverse_mean_ratio(triangle, p[3]));
        let _ = (closest_on_triangle(p[3], triangle), Line::new(p[3], p[4]).map(|line| line.crossing(triangle)));
        let _ = (exact::collinear(p[0], p[1], p[2]), exact::orient3d(p[0], p[1], p[2], p[3]));
        let flat = p.map(|p| DVec2::new(p.x, p.y));
        let _ = exact::orient2d(flat[0], flat[1], flat[2]);
        let _ = Bounds::of(triangle).map(|b| (b.meets(&Bounds { min: p[3], max: p[4] }), b.centre(), b.diagonal()));
        prop_assert!(SurfacePoint::at_corner(face, corner).barycentric.element_sum() == 1.0);
        prop_assert!(SurfacePoint::new(face, p[0]).barycentric.min_element() >= 0.0);
        let h = HalfedgeId::of(face, corner);
        let _ = (h.next(), h.prev(), h.face(), h.corner());
    }

    #[test]
    fn fillings_of_any_costs(n in 0usize..9, costs in prop::collection::vec(prop::option::of(number()), 9)) {
        let cost = |t: [usize; 3]| costs[(t[0] + 2 * t[1] + 3 * t[2]) % 9];
        if let Some(triangles) = cheapest_filling(n, |i, j| (i + j) % 4 != 3, cost) {
            prop_assert_eq!(triangles.len(), n.max(2) - 2);
        }
    }
}
