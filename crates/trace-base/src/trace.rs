//! The verb: a base mesh from elsewhere becomes one of the surface.

use crate::attach::attach;
use crate::foreign::Foreign;
use crate::place::region_map;
use crate::tracer::Tied;
use crate::{TraceError, Untraced};
use mesh_core::{Id as _, IdVec, Topology, TriMesh};
use region_map::{BaseCounts, BaseMap, BaseMesh, MapFaceId, Network};

/// A base mesh from elsewhere, tied to a surface.
#[derive(Clone, Debug)]
pub struct Traced {
    /// What of the network the base mesh follows. Creases that it does not are minor now.
    pub network: Network,
    /// The base mesh, its vertices on the surface, its faces in the order that they came in. Without charts where it has no map.
    pub base: BaseMesh,
    /// Why it has no map.
    pub untraced: Option<Untraced>,
}

/// Ties a base mesh to a surface: puts its vertices on corners, arcs and sheets, and traces its edges as paths that do not cross.
///
/// The order of vertices and faces stays; components that face inwards are turned round. Where the edges cannot be traced, the base
/// mesh has no map, and its subdivisions can only be projected by rays.
pub fn trace(mesh: &TriMesh, topology: &Topology, network: &Network, base: &TriMesh) -> Result<Traced, TraceError> {
    let foreign = Foreign::new(mesh, topology, base)?;
    let attached = attach(mesh, topology, network, &foreign)?;
    let mut region = region_map(mesh, topology, &foreign, &attached);
    region.check(&foreign.topology, &attached.network)?;
    let tied = Tied {
        mesh,
        network: &attached.network,
        base: &foreign.mesh,
        topology: &foreign.topology,
        corners: &attached.corners,
        chains: &attached.chains,
        via: IdVec::filled(Vec::new(), foreign.topology.n_edges()),
    };
    let (map, untraced) = match tied.map(&mut region) {
        Ok(map) => (map, None),
        Err(untraced) => (BaseMap::new(IdVec::new(), &[]), Some(untraced)),
    };
    let positions = region.points.iter().map(|p| p.position(mesh)).collect();
    let n = base.n_vertices();
    let base = BaseMesh {
        mesh: foreign.mesh.with_positions(positions)?,
        region,
        map,
        map_faces: (0..base.n_faces()).map(MapFaceId::new).collect(),
        counts: BaseCounts { asked: n, needed: n, made: n, reason: String::new() },
    };
    Ok(Traced { network: attached.network, base, untraced })
}
