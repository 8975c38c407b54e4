//! Relaxes a fixture over its own surface: `cargo run --release -p relax --example itself`

use mesh_core::Topology;
use region_map::{RegionMap, SheetNormals, Surface};
use relax::{RelaxOptions, relax};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    for (name, mesh) in [("blob", fixtures::blob(10)), ("cylinder", fixtures::cylinder(0.5, 1.5, 24))] {
        let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
        let network = features::detect(&mesh, &topology, &Default::default())?;
        let normals = SheetNormals::new(&mesh, &topology, &network);
        let surface = Surface { mesh: &mesh, topology: &topology, network: &network, normals: &normals };
        let map = RegionMap::identity(&topology, &network);
        let report = relax(&surface, &mesh, &topology, &map, &RelaxOptions::default())?.report;
        println!("{name}: mean quality {:.3}", report.start.ar_mean);
        println!("  {:.3} after {} quadric iterations", report.after_quadric.ar_mean, report.quadric_iterations);
        println!("  {:.3} after {} Newton steps, {} inverted", report.end.ar_mean, report.shape_steps, report.end.inverted);
    }
    Ok(())
}
