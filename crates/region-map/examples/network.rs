//! Corners, arcs and sheets of a fixture: `cargo run -p region-map --example network`

use region_map::{Domain, Surface};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let surface = Surface::with_creases(fixtures::part(6), 40.0)?;
    let network = surface.network();
    println!("{} corners, {} arcs, {} sheets", network.corners.len(), network.arcs.len(), network.n_sheets);
    for (id, arc) in network.arcs.enumerate() {
        let ends = arc.corners.map_or("a loop".to_owned(), |[a, b]| format!("from corner {a} to {b}"));
        println!("arc {id}: {ends}, length {:.3}, between sheets {:?}", arc.length(), arc.sheets);
    }
    let domain = Domain::identity(&surface);
    domain.check(network)?;
    println!("vertices of the mesh as a domain over itself: {:?}", domain.region.class_counts());
    Ok(())
}
