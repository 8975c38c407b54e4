//! Where a fixture wants shorter edges: `cargo run -p sizing --example field -- [EDGE_LENGTH]`

use mesh_core::Topology;
use region_map::{SheetNormals, Surface};
use sizing::{SizingOptions, sizing};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let wanted: Option<f64> = std::env::args().nth(1).map(|a| a.parse()).transpose()?;
    let mesh = fixtures::blob(20);
    let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
    let network = features::detect(&mesh, &topology, &Default::default())?;
    let normals = SheetNormals::new(&mesh, &topology, &network);
    let surface = Surface { mesh: &mesh, topology: &topology, network: &network, normals: &normals };
    let edge_length = wanted.unwrap_or(0.2 * mesh.diagonal());
    let field = sizing(&surface, &SizingOptions::new(edge_length));
    println!("edges of {edge_length:.3} on a box of diagonal {:.3}", mesh.diagonal());
    for tenth in 5..10 {
        let (from, to) = (f64::from(tenth) / 10.0, f64::from(tenth + 1) / 10.0);
        let n = field.relative.iter().filter(|h| (from..to).contains(*h)).count();
        println!("relative length {from:.1} to {to:.1}: {n} vertices");
    }
    println!("full length: {} vertices", field.relative.iter().filter(|h| **h == 1.0).count());
    Ok(())
}
