//! Why snapping fails.

use region_map::{NetworkError, RegionMapError, SurfaceError};

/// Why snapping fails.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SnapError {
    /// The region map does not fit the domain or the network.
    #[error(transparent)]
    Map(#[from] RegionMapError),
    /// The network of the surface contradicts its mesh.
    #[error(transparent)]
    Network(#[from] NetworkError),
    /// The finer network does not fit the mesh.
    #[error("snapping gave a network that does not fit: {0}; please report it with the input file")]
    Surface(#[from] SurfaceError),
    /// A position came out that is no number.
    #[error("snapping gave a position that is not finite: {0}; please report it with the input file")]
    Positions(#[from] mesh_core::MeshError),
}
