//! Traces a base mesh onto a surface, and writes the base mesh subdivided by the map:
//! `cargo run -p trace-base --example trace -- [MESH BASE LEVELS OUT.obj]`

use mesh_core::{CleanOptions, Topology, TriMesh, clean, equilateral_edge_length};
use std::error::Error;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let read = |i: usize| -> Result<Option<TriMesh>, Box<dyn Error>> {
        let Some(path) = arguments.get(i) else { return Ok(None) };
        Ok(Some(clean(&mesh_io::read(Path::new(path))?.soup, &CleanOptions::default())?.mesh))
    };
    let mesh = read(0)?.unwrap_or_else(|| fixtures::l_block(8));
    let base = read(1)?.unwrap_or_else(|| fixtures::l_block(1));
    let levels = arguments.get(2).map_or(Ok(3), |a| a.parse())?;

    let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
    let base_edge_length = equilateral_edge_length(mesh.total_area(), base.n_vertices());
    let options = features::FeatureOptions { base_edge_length, ..Default::default() };
    let network = features::detect(&mesh, &topology, &options)?;
    let traced = trace_base::trace(&mesh, &topology, &network, &base)?;
    println!("{} of {} arcs followed", traced.network.arcs.len(), network.arcs.len());
    if let Some(reason) = traced.untraced {
        println!("no map: {reason}");
        return Ok(());
    }
    let base = &traced.base;
    let domain = subdiv::subdivide(&base.mesh, &base.region, levels)?;
    let placed = domain.origins.iter().map(|p| base.locate(p.face, p.barycentric).position(&mesh)).collect();
    let placed = domain.mesh.with_positions(placed)?;
    println!("{} base faces, {} faces of {levels} levels placed by the map", base.mesh.n_faces(), placed.n_faces());
    if let Some(path) = arguments.get(3) {
        mesh_io::write(Path::new(path), &placed)?;
    }
    Ok(())
}
