//! Why a domain cannot be fitted.

use mesh_core::{FaceId, MeshError, VertexId};
use region_map::RegionMapError;

/// Why a domain cannot be fitted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FitError {
    /// The domain does not fit the surface.
    #[error(transparent)]
    Region(#[from] RegionMapError),
    /// A domain vertex of one sheet sits on a face of another.
    #[error("vertex {0} sits on a face outside of its sheet; project the domain again inside its sheets")]
    OtherSheet(VertexId),
    /// A face that is to stay still is none of the domain.
    #[error("face {0} is to stay still, and the domain has no such face")]
    NoFace(FaceId),
    /// A position is not finite.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}
