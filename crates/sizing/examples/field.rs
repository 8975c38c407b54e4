//! Where a fixture wants shorter edges: `cargo run -p sizing --example field -- [EDGE_LENGTH]`

use region_map::Surface;
use sizing::{SizingOptions, sizing};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let wanted: Option<f64> = std::env::args().nth(1).map(|a| a.parse()).transpose()?;
    let surface = Surface::with_creases(fixtures::blob(20), 40.0)?;
    let diagonal = surface.mesh().diagonal();
    let edge_length = wanted.unwrap_or(0.2 * diagonal);
    let options = SizingOptions::new(edge_length);
    let field = sizing(&surface, &options)?;
    println!("edges of {edge_length:.3} on a box of diagonal {diagonal:.3}");
    for tenth in 5..12 {
        let (from, to) = (f64::from(tenth) / 10.0, f64::from(tenth + 1) / 10.0);
        let n = field.relative.iter().filter(|h| (from..to).contains(*h)).count();
        println!("relative length {from:.1} to {to:.1}: {n} vertices");
    }
    println!("greatest length: {} vertices", field.relative.iter().filter(|h| **h == options.range).count());
    Ok(())
}
