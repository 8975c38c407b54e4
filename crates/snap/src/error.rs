//! Why snapping fails.

use region_map::RegionMapError;

/// Why snapping fails.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SnapError {
    /// The region map does not fit the domain or the network.
    #[error(transparent)]
    Map(#[from] RegionMapError),
    /// A position came out that is no number.
    #[error("snapping gave a position that is not finite: {0}; please report it with the input file")]
    Positions(#[from] mesh_core::MeshError),
}
