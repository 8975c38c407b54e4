//! Fits a coarse sphere to a fine one, as it is and flattened: `cargo run --release -p fit --example sphere`

use fit::{FitOptions, fit};
use glam::DVec3;
use mesh_core::{MeshError, SurfaceIndex, Topology, TriMesh};
use region_map::{Network, RegionMap, SheetNormals, Surface};
use std::error::Error;

fn flattened(mesh: &TriMesh, by: f64) -> Result<TriMesh, MeshError> {
    mesh.with_positions(mesh.positions().iter().map(|&p| p * DVec3::new(1.0, 1.0, by)).collect())
}

fn main() -> Result<(), Box<dyn Error>> {
    for (name, by) in [("sphere", 1.0), ("lens", 0.2)] {
        let (mesh, coarse) = (flattened(&fixtures::icosphere(40), by)?, flattened(&fixtures::icosphere(10), by)?);
        let (topology, domain_topology) =
            (Topology::new(mesh.faces(), mesh.n_vertices())?, Topology::new(coarse.faces(), coarse.n_vertices())?);
        let no_arcs =
            |mesh: &TriMesh, t: &Topology| Network::trace(mesh, t, &t.edge_ids().map(|_| None).collect(), |_| false, vec![]);
        let network = no_arcs(&mesh, &topology);
        let normals = SheetNormals::new(&mesh, &topology, &network);
        let surface = Surface { mesh: &mesh, topology: &topology, network: &network, normals: &normals };
        let mut map = RegionMap::identity(&domain_topology, &no_arcs(&coarse, &domain_topology));
        let index = SurfaceIndex::new(&mesh);
        map.points = coarse.positions().iter().filter_map(|&p| index.closest(p)).map(|c| c.point()).collect();
        let domain = coarse.with_positions(map.points.iter().map(|p| p.position(&mesh)).collect())?;

        let report = fit(&surface, &domain, &domain_topology, &map, &FitOptions::default())?.report;
        println!("{name}: mean distance {:.5} and greatest {:.5}", report.start.mean, report.start.max);
        println!("  {:.5} and {:.5} with offsets of {:.5} on average", report.end.mean, report.end.max, report.mean_offset);
    }
    Ok(())
}
