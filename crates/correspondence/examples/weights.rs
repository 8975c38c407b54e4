//! Maps a cube to itself, its vertices lifted: `cargo run -p correspondence --example weights`

use correspondence::{FaceOrder, Map, Source, Start};
use mesh_core::{CleanOptions, FaceId, clean};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let soup = fixtures::cube(1).to_soup();
    let cleaned = clean(&soup, &CleanOptions::default())?;
    let lifted = cleaned.mesh.with_positions(cleaned.mesh.positions().iter().map(|p| 1.01 * *p).collect())?;
    let start = |(v, &position)| {
        let face = cleaned.topology.faces_at(v).next().unwrap_or(FaceId(0));
        Start { face, position }
    };
    let starts = cleaned.mesh.positions().enumerate().map(start).collect();
    let map = Map::new(&Source { soup: &soup, cleaned: &cleaned }, &lifted, 0, &starts, FaceOrder::Children)?;
    for (v, [x, y, z]) in map.source_barycentric.iter().enumerate() {
        println!("vertex {v}: triangle {:2} at {x:.3} {y:.3} {z:.3}, offset {:.4}", map.source_face[v], map.offset[v]);
    }
    Ok(())
}
