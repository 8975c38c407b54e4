//! A ridge that fades out at both ends, left out of the network, and taken up by a row of edges.

use glam::DVec3;
use mesh_core::{TriMesh, VertexId};
use region_map::{Domain, Network, Surface};
use snap::{LetGo, SnapOptions, Track, snap};

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
    let smooth = Surface::smooth(mesh)?;
    let ridge = (4..=16).map(|x| VertexId(vertex(x, CELLS / 2))).collect();
    let surface = smooth.with_network(Network { minor: vec![ridge], ..smooth.network().clone() })?;

    // The domain is the surface and misses nothing.
    let options = SnapOptions { least_depth: 0.0, ..SnapOptions::default() };
    let snapped = snap(&surface, &Domain::identity(&surface), &Default::default(), &LetGo::default(), &options)?;
    for Track { edges, path, .. } in &snapped.tracks {
        println!("a crease of {} edges is followed by {} vertices of the domain", edges.len(), path.len());
    }
    println!("arcs: {} before, {} after", surface.network().arcs.len(), snapped.surface.network().arcs.len());
    Ok(())
}
