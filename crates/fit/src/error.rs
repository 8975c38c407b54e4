//! Why a domain cannot be fitted.

use mesh_core::{MeshError, VertexId};
use region_map::RegionMapError;

/// Why a domain cannot be fitted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FitError {
    /// The region map is not one of this domain into this surface.
    #[error(transparent)]
    Map(#[from] RegionMapError),
    /// A domain vertex of one sheet sits on a face of another.
    #[error("vertex {0} sits on a face outside of its sheet; project the domain again inside its sheets")]
    OtherSheet(VertexId),
    /// A position is not finite.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}
