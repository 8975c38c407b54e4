//! Traces a base mesh onto a surface, and writes the base mesh subdivided by the map:
//! `cargo run -p trace-base --example trace -- [MESH BASE LEVELS OUT.obj]`

use mesh_core::{CleanOptions, TriMesh, clean};
use region_map::Surface;
use std::error::Error;
use std::path::Path;
use trace_base::{TracedBase, trace};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let read = |i: usize| -> Result<Option<TriMesh>, Box<dyn Error>> {
        let Some(path) = arguments.get(i) else { return Ok(None) };
        Ok(Some(clean(&mesh_io::read(Path::new(path))?.soup, &CleanOptions::default())?.mesh))
    };
    let surface = Surface::with_creases(read(0)?.unwrap_or_else(|| fixtures::l_block(8)), 40.0)?;
    let base = read(1)?.unwrap_or_else(|| fixtures::l_block(1));
    let levels = arguments.get(2).map_or(Ok(3), |a| a.parse())?;

    let traced = trace(&surface, &base)?;
    println!("{} of {} arcs followed", traced.surface.network().arcs.len(), surface.network().arcs.len());
    let base = match traced.base {
        TracedBase::Mapped(base) => base,
        TracedBase::Unmapped { reason, .. } => return Err(format!("no map: {reason}").into()),
    };
    let fine = subdiv::subdivide(&base.domain, levels)?;
    let placed = fine.origins.iter().map(|p| base.locate(p.face, p.barycentric).position(surface.mesh())).collect();
    let placed = fine.domain.mesh.with_positions(placed)?;
    println!("{} base faces, {} faces of {levels} levels placed by the map", base.mesh().n_faces(), placed.n_faces());
    if let Some(path) = arguments.get(3) {
        mesh_io::write(Path::new(path), &placed)?;
    }
    Ok(())
}
