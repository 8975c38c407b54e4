//! Repairs a broken cube, and walks once round it: `cargo run -p mesh-core --example clean`

use glam::DVec3;
use mesh_core::{CleanOptions, SurfaceIndex, clean, walk};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    // A cube with a face turned over, one doubled, and one that is a line.
    let mut soup = fixtures::cube(4).to_soup();
    soup.triangles[7].swap(0, 1);
    soup.triangles.push(soup.triangles[20]);
    soup.triangles.push([0, 1, 1]);
    let cleaned = clean(&soup, &CleanOptions::default())?;
    println!("{} triangles in, {} out: {:?}", soup.triangles.len(), cleaned.mesh.n_faces(), cleaned.report);
    println!("Euler number {}, area {}", cleaned.topology.euler(), cleaned.mesh.total_area());

    let start = SurfaceIndex::new(&cleaned.mesh).closest(DVec3::new(0.3, 0.4, 1.0)).ok_or("no surface")?.point();
    let walked = walk(&cleaned.mesh, &cleaned.topology, start, 4.0 * DVec3::X, |_| true);
    println!("from {} four edges of the cube straight on: {}", start.position(&cleaned.mesh), walked.end.position(&cleaned.mesh));
    Ok(())
}
