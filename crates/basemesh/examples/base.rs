//! A base mesh of a torus, and its map both ways: `cargo run -p basemesh --example base -- [BASE_VERTICES]`

use basemesh::{BaseOptions, build};
use glam::DVec3;
use mesh_core::{Topology, aspect_ratio};
use region_map::{Cells, SheetNormals, Sizing, Surface};
use segment_cvt::{CvtOptions, sample};
use segment_vsa::{VsaOptions, segment};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let base_vertices = std::env::args().nth(1).map_or(Ok(100), |a| a.parse())?;
    let mesh = fixtures::torus(1.0, 0.4, 48, 24);
    let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
    let network = features::detect(&mesh, &topology, &Default::default())?;
    let normals = SheetNormals::new(&mesh, &topology, &network);
    let surface = Surface { mesh: &mesh, topology: &topology, network: &network, normals: &normals };
    let vsa = VsaOptions { max_patches: 12, ..Default::default() };
    let (segmentation, _) = segment(&mesh, &topology, &network, &vsa)?;
    let cells = Cells::trace(&mesh, &topology, &network, &segmentation)?;
    let wanted = CvtOptions { base_vertices, ..Default::default() };
    let sites = sample(&mesh, &cells, &Sizing::uniform(&mesh), &wanted)?.sites;

    // The triangulation of the sites, and what the improvement makes of it. Any chart will do here: no patch is split.
    for rounds in [0, 10] {
        let options = BaseOptions { base_vertices, rounds, max_shrunk: 1.0 };
        let base = build(&surface, &cells, &sites, &Sizing::uniform(&mesh), &options)?;
        let quality: f64 = base.mesh.faces().ids().map(|f| aspect_ratio(base.mesh.triangle(f))).sum();
        println!("{rounds} rounds: {} vertices, {} faces", base.mesh.n_vertices(), base.mesh.n_faces());
        println!("  mean quality {:.3}, {} edits of the map", quality / base.mesh.n_faces() as f64, base.map.n_edits());
        let middle = DVec3::splat(1.0 / 3.0);
        let error = |f| {
            let point = base.locate(f, middle);
            let back = base.map.find(point).map(|(face, w)| base.map.locate(face, w));
            back.map_or(f64::INFINITY, |back| back.position(&mesh).distance(point.position(&mesh)))
        };
        println!("  there and back: {:.1e}", base.mesh.faces().ids().map(error).fold(0.0, f64::max));
    }
    Ok(())
}
