//! Remeshes a file, or a fixture without one: `cargo run --release -p semireg --example remesh -- [IN.obj [OUT.obj]]`

use semireg::{Options, remesh};
use std::error::Error;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let files: Vec<String> = std::env::args().skip(1).collect();
    let soup = match files.first() {
        Some(path) => mesh_io::read(Path::new(path))?.soup,
        None => fixtures::l_block(8).to_soup(),
    };
    let options = Options { base_vertices: Some(150), ..Options::default() };
    let remeshed = remesh(&soup, &options)?;
    let base = &remeshed.report.base;
    println!("base vertices: asked {}, made {}", base.asked, base.made);
    println!(
        "{} vertices, {} faces at level {}",
        remeshed.mesh.n_vertices(),
        remeshed.mesh.n_faces(),
        remeshed.report.certificate.levels
    );
    for time in &remeshed.report.seconds.0 {
        println!("{:10} {:6.2} s", time.stage, time.seconds);
    }
    if let Some(path) = files.get(1) {
        mesh_io::write(Path::new(path), &remeshed.mesh)?;
    }
    Ok(())
}
