//! The verb: a base mesh from elsewhere becomes one of the surface.

use crate::attach::attach;
use crate::foreign::Foreign;
use crate::place::region_map;
use crate::tracer::Tied;
use crate::{TraceError, Untraced};
use mesh_core::{Id as _, IdVec, TriMesh};
use region_map::{BaseMesh, Domain, MapFaceId, Surface};
use std::sync::Arc as Shared;

/// A base mesh from elsewhere, tied to a surface.
#[derive(Clone, Debug)]
pub struct Traced {
    /// The surface with those corners and arcs that the base mesh follows. The other creases are minor now.
    pub surface: Surface,
    /// The base mesh, its vertices on the surface, its faces in the order that they came in.
    pub base: TracedBase,
}

/// A base mesh with or without a map.
#[derive(Clone, Debug)]
pub enum TracedBase {
    /// All edges are traced.
    Mapped(BaseMesh),
    /// Some edges could not be traced: its subdivisions can only be projected by rays.
    Unmapped {
        /// The base mesh over the surface.
        domain: Domain,
        /// Why it has no map.
        reason: Untraced,
    },
}

impl TracedBase {
    /// The base mesh over the surface, with a map or without.
    pub fn domain(&self) -> &Domain {
        match self {
            Self::Mapped(base) => &base.domain,
            Self::Unmapped { domain, .. } => domain,
        }
    }
}

/// Ties a base mesh to a surface: puts its vertices on corners, arcs and sheets, and traces its edges as paths that do not cross.
///
/// The order of vertices and faces stays; components that face inwards are turned round. Where the edges cannot be traced, the base
/// mesh has no map.
///
/// Fails where the base mesh is no oriented manifold, where it has another topology than the surface, and where its borders do not run
/// along those of the surface.
pub fn trace(surface: &Surface, base: &TriMesh) -> Result<Traced, TraceError> {
    let foreign = Foreign::new(surface, base)?;
    let attached = attach(surface.mesh(), surface.topology(), surface.network(), &foreign)?;
    let surface = surface.with_network(attached.network.clone())?;
    let mut region = region_map(&surface, &foreign, &attached).map_err(TraceError::NoPlace)?;
    region.check(&foreign.topology, surface.network())?;
    let tied = Tied {
        surface: &surface,
        base: &foreign.mesh,
        topology: &foreign.topology,
        corners: &attached.corners,
        chains: &attached.chains,
        via: IdVec::filled(Vec::new(), foreign.topology.n_edges()),
    };
    let map = tied.map(&mut region);
    let positions = region.points.iter().map(|p| p.position(surface.mesh())).collect();
    let domain = Domain { mesh: foreign.mesh.with_positions(positions)?, topology: Shared::new(foreign.topology), region };
    let map_faces = (0..base.n_faces()).map(MapFaceId::new).collect();
    let base = match map {
        Ok(map) => TracedBase::Mapped(BaseMesh { domain, map, map_faces }),
        Err(reason) => TracedBase::Unmapped { domain, reason },
    };
    Ok(Traced { surface, base })
}
