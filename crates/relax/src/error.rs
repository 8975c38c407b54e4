//! Why a domain cannot be relaxed.

use mesh_core::{MeshError, VertexId};
use region_map::RegionMapError;

/// Why a domain cannot be relaxed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RelaxError {
    /// The region map is not one of this domain into this surface.
    #[error(transparent)]
    Map(#[from] RegionMapError),
    /// A domain vertex does not have one neighbour behind and one ahead on its arc.
    #[error("vertex {0} does not lie between two neighbours on its arc; project the domain again with arcs in order")]
    ArcOrder(VertexId),
    /// A domain vertex of one sheet sits on a face of another.
    #[error("vertex {0} sits on a face outside of its sheet; project the domain again inside its sheets")]
    OtherSheet(VertexId),
    /// A table of target areas has another length than the domain has faces, or an area that is not positive.
    #[error("the target areas must be positive, one for each of the {faces} faces")]
    TargetArea {
        /// Number of faces of the domain.
        faces: usize,
    },
    /// The faces are not the children of base faces, four of each in the order of `subdiv`.
    #[error("the domain is not a base mesh that was subdivided once; subdivide it by one level")]
    NotSubdivided,
    /// A position is not finite.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}
