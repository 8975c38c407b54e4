//! Why a domain cannot be relaxed.

use mesh_core::{FaceId, MeshError, VertexId};
use region_map::RegionMapError;

/// Why a domain cannot be relaxed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RelaxError {
    /// An option is out of its range.
    #[error("the option {name} is {value}; it must be from {least} to {most}")]
    Option {
        /// Which.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The least value that it may have.
        least: f64,
        /// The greatest.
        most: f64,
    },
    /// A vertex that is to be held is not in the domain.
    #[error("vertex {0}, which is to be held, is not in the domain")]
    NoSuchVertex(VertexId),
    /// A face that is to be relaxed is not in the domain.
    #[error("face {0}, which is to be relaxed, is not in the domain")]
    NoSuchFace(FaceId),
    /// The region map is not one of this domain into this surface.
    #[error(transparent)]
    Region(#[from] RegionMapError),
    /// A domain vertex does not have one neighbour behind and one ahead on its arc.
    #[error("vertex {0} does not lie between two neighbours on its arc; project the domain again with arcs in order")]
    ArcOrder(VertexId),
    /// A domain vertex of one sheet sits on a face of another.
    #[error("vertex {0} sits on a face outside of its sheet; project the domain again inside its sheets")]
    OtherSheet(VertexId),
    /// A base edge length is not above 0, or not finite.
    #[error("the base edge length is {0}; it must be above 0 and finite")]
    BaseEdgeLength(f64),
    /// A position is not finite.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}
