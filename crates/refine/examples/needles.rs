//! A CAD part of needles and long strips, in better triangles: `cargo run -p refine --example needles`

use mesh_core::{Topology, TriMesh, aspect_ratio};
use refine::{RefineOptions, refine};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let mesh = fixtures::cad(32);
    let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
    let mean_quality =
        |mesh: &TriMesh| mesh.faces().ids().map(|f| aspect_ratio(mesh.triangle(f))).sum::<f64>() / mesh.n_faces() as f64;
    println!("{} triangles of mean quality {:.3}", mesh.n_faces(), mean_quality(&mesh));
    for share in [0.2, 0.1, 0.05] {
        let refined = refine(&mesh, &topology, &[], &RefineOptions::new(share * mesh.diagonal()))?;
        let (n, quality) = (refined.mesh.n_faces(), mean_quality(&refined.mesh));
        println!("no edge over {share} of the diagonal: {n} triangles of mean quality {quality:.3}");
    }
    Ok(())
}
