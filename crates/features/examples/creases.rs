//! Creases of a clean part and of a noisy scan of it: `cargo run -p features --example creases -- [BASE_EDGE_LENGTH]`

use features::{FeatureOptions, detect};
use mesh_core::Topology;
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let wanted: Option<f64> = std::env::args().nth(1).map(|a| a.parse()).transpose()?;
    for (name, mesh) in [("part", fixtures::part(8)), ("scan", fixtures::scan(8))] {
        let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
        for base_edge_length in [0.0, wanted.unwrap_or(0.05 * mesh.diagonal())] {
            let network = detect(&mesh, &topology, &[], base_edge_length, &FeatureOptions::default())?;
            println!(
                "{name} at {base_edge_length:.3}: {} corners, {} arcs of length {:.2}, {} sheets, {} chains left out",
                network.corners.len(),
                network.arcs.len(),
                network.total_length(),
                network.n_sheets,
                network.minor.len()
            );
        }
    }
    Ok(())
}
