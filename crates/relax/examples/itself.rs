//! Relaxes a fixture over its own surface: `cargo run --release -p relax --example itself`

use region_map::{Domain, Surface};
use relax::{RelaxOptions, relax};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    for (name, mesh) in [("blob", fixtures::blob(10)), ("cylinder", fixtures::cylinder(0.5, 1.5, 24))] {
        let surface = Surface::with_creases(mesh, 40.0)?;
        let report = relax(&surface, &Domain::identity(&surface), &RelaxOptions::default())?.report;
        println!("{name}: mean quality {:.3}", report.start.ar_mean);
        println!("  {:.3} after {} quadric iterations", report.after_quadric.ar_mean, report.quadric_iterations);
        println!("  {:.3} after {} Newton steps, {} inverted", report.end.ar_mean, report.shape_steps, report.end.inverted);
    }
    Ok(())
}
