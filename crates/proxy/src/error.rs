//! Why there is no proxy.

use mesh_core::{MeshError, TopologyError, VertexId};
use region_map::{RegionMapError, SurfaceError};

/// Why there is no proxy, or a domain cannot be brought from it to its surface.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ProxyError {
    /// An option is out of its range.
    #[error("option {name} is {value}: faces and longest_edge must be above 0, distance 0 or more")]
    Option {
        /// Which.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// The domain is not one on the proxy.
    #[error("the domain is of another surface: {0}")]
    OtherSurface(#[from] RegionMapError),
    /// A vertex of the domain is at a face that the proxy does not have.
    #[error("vertex {0} is at a face that the proxy does not have")]
    NoSuchFace(VertexId),
    /// The surface is not the one that the proxy stands for.
    #[error("the proxy stands for another surface")]
    NotOfSurface,
    /// A fault of this program: what is left is no mesh.
    #[error("collapsing left a broken mesh, please report this: {0}")]
    BrokenMesh(#[from] MeshError),
    /// A fault of this program: what is left is no oriented manifold.
    #[error("collapsing left a mesh that is not manifold, please report this: {0}")]
    BrokenTopology(#[from] TopologyError),
    /// A fault of this program: the network was lost.
    #[error("collapsing left a broken network, please report this: {0}")]
    BrokenNetwork(#[from] SurfaceError),
    /// A fault of this program: an edge of an arc was lost.
    #[error("collapsing lost an edge of an arc, please report this: from vertex {0} to {1}")]
    LostArcEdge(VertexId, VertexId),
}
