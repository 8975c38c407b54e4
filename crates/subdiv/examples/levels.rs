//! Counts of a fixture, taken as its own base mesh, at the first levels: `cargo run -p subdiv --example levels -- [LEVELS]`

use mesh_core::{IdVec, Topology};
use region_map::{Network, RegionMap};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let levels: u32 = std::env::args().nth(1).map_or(Ok(4), |a| a.parse())?;
    let base = fixtures::torus(1.0, 0.4, 12, 8);
    let topology = Topology::new(base.faces(), base.n_vertices())?;
    let network = Network::trace(&base, &topology, &IdVec::filled(None, topology.n_edges()), |_| false, Vec::new());
    let region = RegionMap::identity(&topology, &network);
    println!("level  vertices     faces");
    for level in 0..=levels {
        let domain = subdiv::subdivide(&base, &region, level)?;
        println!("{level:5} {:9} {:9}", domain.mesh.n_vertices(), domain.mesh.n_faces());
    }
    Ok(())
}
