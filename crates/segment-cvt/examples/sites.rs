//! Sites on a cylinder cut into its three sides, the round one in two: `cargo run -p segment-cvt --example sites -- [BASE_VERTICES]`

use region_map::{Cells, PatchId, Segmentation, Sizing, Surface};
use segment_cvt::{CvtOptions, sample};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let base_vertices = std::env::args().nth(1).map_or(Ok(60), |a| a.parse())?;
    let surface = Surface::with_creases(fixtures::cylinder(0.5, 1.5, 48), 45.0)?;
    let mesh = surface.mesh();
    let patch = |f| match mesh.normal(f).z {
        z if z.abs() < 0.5 => PatchId(u32::from(mesh.centroid(f).x > 0.0)),
        z => PatchId(if z > 0.0 { 2 } else { 3 }),
    };
    let segmentation = Segmentation { patch_of_face: mesh.faces().ids().map(patch).collect(), n_patches: 4 };
    let cells = Cells::trace(&surface, &segmentation)?;

    let options = CvtOptions { base_vertices, ..CvtOptions::default() };
    let sampled = sample(&surface, &cells, &Sizing::uniform(mesh), &options)?;
    println!("asked {base_vertices}, needed {}, made {}", sampled.budget.needed, sampled.budget.total);
    println!("edge length {:.3}, {} corners", sampled.budget.edge_length, cells.corners.len());
    for (arc, steps) in sampled.sites.on_arcs.enumerate() {
        println!("arc {arc}: length {:.3}, {} segments", cells.arcs[arc].length(), steps.len() + 1);
    }
    for (patch, inner) in sampled.sites.in_patches.enumerate() {
        println!("patch {patch}: {} sites inside", inner.len());
    }
    Ok(())
}
