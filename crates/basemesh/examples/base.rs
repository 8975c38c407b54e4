//! A base mesh of a torus by both ways, and its map there and back: `cargo run -p basemesh --example base -- [BASE_VERTICES]`

use basemesh::{BaseOptions, build, decimate};
use glam::DVec3;
use mesh_core::aspect_ratio;
use region_map::{BaseMesh, Cells, Sizing, Surface};
use segment_cvt::{CvtOptions, sample};
use segment_vsa::{VsaOptions, segment};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let base_vertices = std::env::args().nth(1).map_or(Ok(100), |a| a.parse())?;
    let surface = Surface::smooth(fixtures::torus(1.0, 0.4, 48, 24))?;
    let sizing = Sizing::uniform(surface.mesh());

    // Patches, sites in them, and their triangulation, as it is and improved. Any chart will do here: no patch is split.
    let (segmentation, _) = segment(&surface, &VsaOptions { max_patches: 12, ..Default::default() })?;
    let cells = Cells::trace(&surface, &segmentation)?;
    let sites = sample(&surface, &cells, &sizing, &CvtOptions { base_vertices, ..Default::default() })?.sites;
    let options = BaseOptions { base_vertices, max_shrunk: 1.0, ..Default::default() };
    let raw = build(&surface, &cells, &sites, &sizing, &BaseOptions { rounds: 0, ..options.clone() })?;
    show("patches, as triangulated", &surface, &raw);
    show("patches, improved", &surface, &build(&surface, &cells, &sites, &sizing, &options)?);

    // The torus itself, coarsened.
    show("decimation", &surface, &decimate(&surface, &sizing, &options)?);
    Ok(())
}

fn show(way: &str, surface: &Surface, base: &BaseMesh) {
    let mesh = base.mesh();
    let quality: f64 = mesh.faces().ids().map(|f| aspect_ratio(mesh.triangle(f))).sum();
    println!("{way}: {} vertices, {} faces", mesh.n_vertices(), mesh.n_faces());
    println!("  mean quality {:.3}, {} edits of the map", quality / mesh.n_faces() as f64, base.map.n_edits());
    let error = |f| {
        let point = base.locate(f, DVec3::splat(1.0 / 3.0));
        let back = base.map.find(point).map(|(face, w)| base.map.locate(face, w));
        let [there, back] = [Some(point), back].map(|p| p.map_or(DVec3::INFINITY, |p| p.position(surface.mesh())));
        back.distance(there)
    };
    println!("  there and back: {:.1e}", mesh.faces().ids().map(error).fold(0.0, f64::max));
}
