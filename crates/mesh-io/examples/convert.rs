//! Prints what a mesh file holds and writes it in another format:
//! `cargo run -p mesh-io --example convert -- IN.obj [OUT.glb]`

use mesh_core::TriMesh;
use std::error::Error;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let files: Vec<String> = std::env::args().skip(1).collect();
    let input = files.first().ok_or("give a mesh file")?;
    let document = mesh_io::read(Path::new(input))?;
    println!("{input}: {} vertices, {} triangles", document.soup.positions.len(), document.soup.triangles.len());
    println!("{} polygons, {} with more than 3 sides", document.n_polygons, document.n_polygons_above_3);
    println!("{} polygons with an index out of range", document.polygons_out_of_range.len());
    for extra in &document.extras {
        println!("not taken over: {extra}");
    }
    if let Some(output) = files.get(1) {
        let mesh = TriMesh::new(document.soup.positions, document.soup.triangles)?;
        mesh_io::write(Path::new(output), &mesh)?;
    }
    Ok(())
}
