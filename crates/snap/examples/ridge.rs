//! A ridge that fades out at both ends, left out of the network, and taken up by a row of edges.

use glam::DVec3;
use mesh_core::{Topology, TriMesh, VertexId};
use region_map::{ArcKind, Network, RegionMap, SheetNormals, Surface};
use snap::{LetGo, SnapOptions, snap};

const CELLS: u32 = 20;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let vertex = |x: u32, y: u32| y * (CELLS + 1) + x;
    let at = |i: u32| {
        let [x, y] = [i % (CELLS + 1), i / (CELLS + 1)].map(|k| f64::from(k) / f64::from(CELLS) - 0.5);
        DVec3::new(x, y, -y.abs() * (1.2 - 4.0 * x.abs()).max(0.0))
    };
    let cells = (0..CELLS * CELLS).map(|i| vertex(i % CELLS, i / CELLS));
    let faces = cells.flat_map(|a| [[a, a + 1, a + CELLS + 2], [a, a + CELLS + 2, a + CELLS + 1]]).collect();
    let mesh = TriMesh::new((0..(CELLS + 1).pow(2)).map(at).collect(), faces)?;
    let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
    let kinds = topology.edge_ids().map(|e| topology.is_border_edge(e).then_some(ArcKind::Border)).collect();
    let ridge = (4..=16).map(|x| VertexId(vertex(x, CELLS / 2))).collect();
    let network = Network::trace(&mesh, &topology, &kinds, |_| false, vec![ridge]);
    let normals = SheetNormals::new(&mesh, &topology, &network);
    let surface = Surface { mesh: &mesh, topology: &topology, network: &network, normals: &normals };

    let map = RegionMap::identity(&topology, &network);
    // The domain is the surface and misses nothing.
    let options = SnapOptions { least_depth: 0.0, ..SnapOptions::default() };
    let snapped = snap(&surface, &mesh, &topology, &map, &LetGo::default(), &options)?;
    for (edges, path) in &snapped.tracks {
        println!("a crease of {} edges is followed by {} vertices of the domain", edges.len(), path.len());
    }
    println!("arcs: {} before, {} after", network.arcs.len(), snapped.network.arcs.len());
    Ok(())
}
