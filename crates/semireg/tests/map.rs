//! The map of whole results: exact, on the right part, and near.

use glam::DVec3;
use mesh_core::{FaceId, Soup, TriMesh, normal};
use semireg::{FaceOrder, Map, Options, Remeshed, remesh};

fn remeshed(soup: &Soup, base_vertices: usize) -> Remeshed {
    remesh(soup, &Options { base_vertices: Some(base_vertices), levels: Some(2), ..Options::default() }).unwrap()
}

/// Every vertex of the mesh is where the map says, to 1e-12 of the diagonal.
fn check_exact(soup: &Soup, mesh: &TriMesh, map: &Map) {
    for (v, p) in mesh.positions().iter().enumerate() {
        let corners @ [a, b, c] = soup.triangles[map.source_face[v] as usize].map(|v| soup.positions[v as usize]);
        let [_, y, z] = map.source_barycentric[v];
        let rebuilt = a + y * (b - a) + z * (c - a) + map.offset[v] * normal(corners);
        assert!(rebuilt.distance(*p) <= 1e-12 * mesh.diagonal(), "vertex {v}: {}", rebuilt.distance(*p));
    }
}

/// The share of a mesh's size that an input vertex and its point are apart at most.
fn greatest_gap(soup: &Soup, mesh: &TriMesh, map: &Map) -> f64 {
    let gap = |(v, &face): (usize, &i64)| {
        let [a, b, c] = mesh.triangle(FaceId(face as u32));
        let [x, y, z] = map.result_barycentric[v];
        (x * a + y * b + z * c).distance(soup.positions[v]) / mesh.diagonal()
    };
    map.result_face.iter().enumerate().filter(|(_, face)| **face >= 0).map(gap).fold(0.0, f64::max)
}

#[test]
fn results_are_rebuilt_from_input_and_map() {
    for (name, soup, base_vertices) in [
        ("cube", fixtures::cube(4).to_soup(), 40),
        ("torus", fixtures::torus(1.0, 0.4, 32, 16).to_soup(), 60),
        ("wreck", fixtures::wreck(4), 60),
        ("crossing boxes", fixtures::crossing_boxes(3).to_soup(), 80),
        ("plate", fixtures::cuboid(DVec3::new(1.0, 1.0, 0.02), 6).to_soup(), 60),
    ] {
        let remeshed = remeshed(&soup, base_vertices);
        for level in 0..=2 {
            let (mesh, map) = (remeshed.level(level).unwrap(), remeshed.map(&soup, level, FaceOrder::Children).unwrap());
            check_exact(&soup, &mesh, &map);
            assert_eq!((map.parents.len(), map.base_face.len()), (level as usize, mesh.n_faces()), "{name}");
        }
        let map = remeshed.map(&soup, 2, FaceOrder::Children).unwrap();
        // Feet are beside their triangles by little, where the fit lifted vertices.
        let least = map.source_barycentric.iter().flatten().copied().fold(0.0, f64::min);
        assert!(least > -0.5, "{name}: {least}");
        let error = remeshed.report.certificate.measures.distance.worse().max;
        let gap = greatest_gap(&soup, &remeshed.mesh, &map);
        assert!(gap <= 2.0 * error + 1e-3, "{name}: {gap}, error {error}");
    }
}

/// On a thin plate no vertex has its triangle on the other side.
#[test]
fn no_vertex_of_a_thin_plate_changes_sides() {
    let soup = fixtures::cuboid(DVec3::new(1.0, 1.0, 0.01), 8).to_soup();
    let remeshed = remeshed(&soup, 80);
    let map = remeshed.map(&soup, 2, FaceOrder::Children).unwrap();
    let topology = mesh_core::Topology::new(remeshed.mesh.faces(), remeshed.mesh.n_vertices()).unwrap();
    for v in remeshed.mesh.positions().ids() {
        let triangle = soup.triangles[map.source_face[v.0 as usize] as usize].map(|v| soup.positions[v as usize]);
        let around = topology.fan(v).map(|h| remeshed.mesh.normal(h.face()).dot(normal(triangle)));
        assert!(around.fold(-1.0, f64::max) > 0.9, "vertex {v}");
    }
}

/// The same map for the faces in SubdivNet's order: each number names the same face.
#[test]
fn the_map_follows_the_order_of_the_faces() {
    let soup = fixtures::wreck(4);
    let remeshed = remeshed(&soup, 60);
    let [ours, theirs] = [FaceOrder::Children, FaceOrder::SubdivNet].map(|order| {
        let mesh = order.ordered(&remeshed.mesh, 2).unwrap();
        (remeshed.map(&soup, 2, order).unwrap(), mesh)
    });
    assert!(ours.0.result_face != theirs.0.result_face);
    assert_eq!(FaceOrder::SubdivNet.restored(&theirs.1, 2).unwrap(), ours.1);
    for (&f, &g) in ours.0.result_face.iter().zip(&theirs.0.result_face) {
        assert_eq!(f < 0, g < 0);
        if f >= 0 {
            assert_eq!(ours.1.face(FaceId(f as u32)), theirs.1.face(FaceId(g as u32)));
        }
    }
    // A base face is known by its first corner, which its first child of all keeps.
    let base = remeshed.level(0).unwrap();
    for (map, mesh) in [&ours, &theirs] {
        for f in base.faces().ids() {
            let first = mesh.faces().iter().zip(&map.base_face).find(|(face, b)| **b == f.0 && face[0] == base.face(f)[0]);
            assert!(first.is_some(), "{f}");
        }
    }
}
