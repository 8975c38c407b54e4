//! Corners, arcs and sheets of a fixture: `cargo run -p region-map --example network`

use mesh_core::Topology;
use region_map::{ArcKind, Network, RegionMap};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let mesh = fixtures::part(6);
    let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
    let network = Network::trace(&mesh, &topology, &ArcKind::by_angle(&mesh, &topology, 40.0), |_| false, Vec::new());
    println!("{} corners, {} arcs, {} sheets", network.corners.len(), network.arcs.len(), network.n_sheets);
    for (id, arc) in network.arcs.enumerate() {
        let ends = arc.corners.map_or("a loop".to_owned(), |[a, b]| format!("from corner {a} to {b}"));
        println!("arc {id}: {ends}, length {:.3}, between sheets {:?}", arc.length(), arc.sheets);
    }
    let map = RegionMap::identity(&topology, &network);
    map.check(&topology, &network)?;
    println!("vertices at corners, on arcs, in sheets: {:?}", map.class_counts());
    Ok(())
}
