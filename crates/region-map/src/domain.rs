//! [`Domain`]: a mesh over a surface, as it goes from stage to stage.

use crate::{Network, RegionMap, RegionMapError, Surface};
use glam::DVec3;
use mesh_core::{Id as _, MeshError, SurfacePoint, Topology, TopologyError, TriMesh};
use std::sync::Arc as Shared;

/// A mesh over a surface: a base mesh, and every level that is subdivided from it.
///
/// Stages take a domain and give one with the same faces in another place, or with more faces.
#[derive(Clone, Debug)]
pub struct Domain {
    /// Vertices and faces.
    pub mesh: TriMesh,
    /// Their connectivity, shared by all domains that differ in places only.
    pub topology: Shared<Topology>,
    /// Where every vertex, edge and face belongs on the surface.
    pub region: RegionMap,
}

/// Why a mesh and a region map are no domain.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DomainError {
    /// The mesh is not an oriented manifold.
    #[error("the domain mesh is not an oriented manifold: {0}")]
    NotManifold(#[from] TopologyError),
    /// The region map is of another mesh.
    #[error(transparent)]
    Region(#[from] RegionMapError),
}

impl Domain {
    /// A mesh with its region map. Fails where the mesh is no oriented manifold or the map is of another size.
    pub fn new(mesh: TriMesh, region: RegionMap) -> Result<Self, DomainError> {
        let topology = Shared::new(Topology::new(mesh.faces(), mesh.n_vertices())?);
        region.check_sizes(&topology)?;
        Ok(Self { mesh, topology, region })
    }

    /// The working mesh as a domain over itself: every vertex where it is.
    pub fn identity(surface: &Surface) -> Self {
        let region = RegionMap::identity(surface.topology(), surface.network());
        Self { mesh: surface.mesh().clone(), topology: surface.shared_topology(), region }
    }

    /// The same faces with every vertex at its point of another region map.
    ///
    /// Fails where the map has another number of vertices; and with [`MeshError::NotFinite`] where the point of a vertex leads to a
    /// coordinate that is not finite, or is on a face that the surface does not have.
    pub fn placed(&self, surface: &Surface, region: RegionMap) -> Result<Self, MeshError> {
        let n_faces = surface.mesh().n_faces();
        let position =
            |p: &SurfacePoint| if p.face.index() < n_faces { p.position(surface.mesh()) } else { DVec3::splat(f64::NAN) };
        let positions = region.points.iter().map(position).collect();
        Ok(Self { mesh: self.mesh.with_positions(positions)?, topology: self.topology.clone(), region })
    }

    /// Checks that the mesh, its topology and its region map fit each other and the network: see [`RegionMap::check`].
    pub fn check(&self, network: &Network) -> Result<(), RegionMapError> {
        let sizes = [
            ("the mesh", self.mesh.n_vertices(), self.topology.n_vertices()),
            ("the mesh", self.mesh.n_faces(), self.topology.n_faces()),
        ];
        match sizes.into_iter().find(|(_, found, expected)| found != expected) {
            Some((what, found, expected)) => Err(RegionMapError::WrongSize { what, found, expected }),
            None => self.region.check(&self.topology, network),
        }
    }
}
