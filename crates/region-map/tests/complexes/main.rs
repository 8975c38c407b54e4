//! Networks, cells and maps on shapes with known answers.

mod arguments;
mod base_map;
mod cells;
mod check;
mod domain;
mod network;
mod surface;

use glam::DVec3;
use mesh_core::{Topology, TriMesh, VertexId};
use region_map::{ArcKind, Network};

fn topology(mesh: &TriMesh) -> Topology {
    Topology::new(mesh.faces(), mesh.n_vertices()).expect("a manifold")
}

/// Border edges, edges of more than 40 degrees, and those between marked vertices.
fn marked_network(
    mesh: &TriMesh,
    topology: &Topology,
    is_marked: impl Fn(DVec3) -> bool,
    is_corner: impl Fn(VertexId) -> bool,
) -> Network {
    let mut kinds = ArcKind::by_angle(mesh, topology, 40.0);
    for e in topology.edge_ids().filter(|&e| topology.ends(e).into_iter().all(|v| is_marked(mesh.position(v)))) {
        kinds[e].get_or_insert(ArcKind::Marked);
    }
    Network::trace(mesh, topology, &kinds, is_corner, Vec::new()).expect("tables of one mesh")
}

fn crease_network(mesh: &TriMesh, topology: &Topology) -> Network {
    marked_network(mesh, topology, |_| false, |_| false)
}

/// A sphere with a marked quarter of its equator: an arc that ends inside its only sheet, twice.
fn sphere_with_dart() -> (TriMesh, Topology, Network) {
    let mesh = fixtures::uv_sphere(16);
    let topology = topology(&mesh);
    let on_quarter = |p: DVec3| p.z.abs() < 1e-9 && p.x > -1e-9 && p.y > -1e-9;
    let network = marked_network(&mesh, &topology, on_quarter, |_| false);
    (mesh, topology, network)
}

/// Shapes with every kind of arc: between corners, loops, borders, darts, and corners without arcs.
fn shapes() -> Vec<(&'static str, TriMesh, Topology, Network)> {
    let plain = [
        ("cube", fixtures::cube(3)),
        ("box of twelve", fixtures::cube(1)),
        ("L", fixtures::l_block(2)),
        ("cylinder", fixtures::cylinder(0.5, 1.0, 12)),
        ("cone", fixtures::cone(1.0, 1.0, 12)),
        ("torus", fixtures::torus(1.0, 0.4, 12, 8)),
        ("shell", fixtures::shell(8)),
        ("plane", fixtures::plane()),
        ("two boxes", fixtures::crossing_boxes(1)),
        ("part", fixtures::part(4)),
        ("brick", fixtures::brick(8)),
    ];
    let mut all: Vec<_> = plain
        .into_iter()
        .map(|(name, mesh)| {
            let topology = topology(&mesh);
            let network = crease_network(&mesh, &topology);
            (name, mesh, topology, network)
        })
        .collect();
    let (mesh, dart_topology, network) = sphere_with_dart();
    all.push(("dart", mesh, dart_topology, network));
    let cone = fixtures::cone(1.0, 1.0, 12);
    let cone_topology = topology(&cone);
    let with_tip = marked_network(&cone, &cone_topology, |_| false, |v| cone.position(v).z > 0.999);
    all.push(("cone with tip", cone, cone_topology, with_tip));
    all
}
