//! Why no better connectivity can be searched for.

use mesh_core::VertexId;
use relax::RelaxError;

/// Why no better connectivity can be searched for.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReconnectError {
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
    /// The domain does not fit the surface, or an option of the shape energy is out of its range.
    #[error(transparent)]
    Relax(#[from] RelaxError),
    /// The faces are not the children of base faces, four of each in the order of `subdiv`.
    #[error("the domain is not a base mesh that was subdivided once; subdivide it by one level")]
    NotSubdivided,
    /// The sizing field is of another mesh.
    #[error("the sizing field has {found} entries; the surface has {expected} vertices")]
    SizingOfAnotherMesh {
        /// Its length.
        found: usize,
        /// Number of vertices of the working mesh.
        expected: usize,
    },
    /// The sizing field asks for an edge length that is none.
    #[error("the sizing field asks for the relative edge length {length} at vertex {vertex}; it must be above 0 and finite")]
    Sizing {
        /// A vertex of the working mesh.
        vertex: VertexId,
        /// What it asks for there.
        length: f64,
    },
}
