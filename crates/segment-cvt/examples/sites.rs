//! Sites on a cylinder cut into its three sides, the round one in two: `cargo run -p segment-cvt --example sites -- [BASE_VERTICES]`

use mesh_core::Topology;
use region_map::{ArcKind, Cells, Network, PatchId, Segmentation, Sizing};
use segment_cvt::{CvtOptions, sample};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let base_vertices = std::env::args().nth(1).map_or(Ok(60), |a| a.parse())?;
    let mesh = fixtures::cylinder(0.5, 1.5, 48);
    let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
    let is_rim = |e| topology.edge_faces(e).1.is_some_and(|g| mesh.normal(topology.edge_faces(e).0).dot(mesh.normal(g)) < 0.7);
    let kinds = topology.edge_ids().map(|e| is_rim(e).then_some(ArcKind::Sharp)).collect();
    let network = Network::trace(&mesh, &topology, &kinds, |_| false, Vec::new());
    let patch = |f| match mesh.normal(f).z {
        z if z.abs() < 0.5 => PatchId(u32::from(mesh.centroid(f).x > 0.0)),
        z => PatchId(if z > 0.0 { 2 } else { 3 }),
    };
    let segmentation = Segmentation { patch_of_face: mesh.faces().ids().map(patch).collect(), n_patches: 4 };
    let cells = Cells::trace(&mesh, &topology, &network, &segmentation)?;

    let options = CvtOptions { base_vertices, ..CvtOptions::default() };
    let sampled = sample(&mesh, &cells, &Sizing::uniform(&mesh), &options)?;
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
