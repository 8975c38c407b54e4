//! Fits a coarse sphere to a fine one, as it is and flattened: `cargo run --release -p fit --example sphere`

use fit::{FitOptions, fit};
use glam::DVec3;
use mesh_core::{MeshError, TriMesh};
use region_map::{Domain, RegionMap, Surface};
use std::error::Error;

fn flattened(mesh: &TriMesh, by: f64) -> Result<TriMesh, MeshError> {
    mesh.with_positions(mesh.positions().iter().map(|&p| p * DVec3::new(1.0, 1.0, by)).collect())
}

fn main() -> Result<(), Box<dyn Error>> {
    for (name, by) in [("sphere", 1.0), ("lens", 0.2)] {
        let surface = Surface::smooth(flattened(&fixtures::icosphere(40), by)?)?;
        // The coarse mesh, with its vertices at the nearest points of the surface.
        let coarse = Domain::identity(&Surface::smooth(flattened(&fixtures::icosphere(10), by)?)?);
        let nearest = coarse.mesh.positions().iter().filter_map(|&p| surface.index().closest(p));
        let region = RegionMap { points: nearest.map(|c| c.point()).collect(), ..coarse.region.clone() };
        let domain = coarse.placed(&surface, region)?;

        let report = fit(&surface, &domain, &FitOptions::default())?.report;
        println!("{name}: mean distance {:.5} and greatest {:.5}", report.start.mean, report.start.max);
        println!("  {:.5} and {:.5} with offsets of {:.5} on average", report.end.mean, report.end.max, report.mean_offset);
    }
    Ok(())
}
