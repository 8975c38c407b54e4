//! What can be wrong with what is handed in.

use mesh_core::{FaceId, VertexId};

/// Why there are no levels, or no map.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum CorrespondenceError {
    /// The faces are no subdivision of so many levels, in the order of the file `levels.rs`.
    #[error(
        "the faces are not {levels} subdivisions of a base mesh with the children of face f at 4f to 4f + 3 (face {face} of level {level})"
    )]
    NotSubdivided {
        /// Levels asked for.
        levels: u32,
        /// The level of the face whose children are not what they should be.
        level: u32,
        /// That face.
        face: usize,
    },
    /// There is no such level.
    #[error("there is no level {level}: the finest is level {finest}; ask for one from 0 to that")]
    NoLevel {
        /// The level asked for.
        level: u32,
        /// The finest level.
        finest: u32,
    },
    /// The cleaned mesh is of another soup.
    #[error("the cleaned mesh is of another soup; give the one that it was made of")]
    OtherSoup,
    /// Not one start for each vertex.
    #[error("{starts} starts for {vertices} vertices; give one for each")]
    StartCount {
        /// Starts given.
        starts: usize,
        /// Vertices of the result.
        vertices: usize,
    },
    /// A start is on a face that the cleaned mesh does not have, or its position is not finite.
    #[error("the start of vertex {0} is on face {1}, which the input does not have, or is not finite")]
    NoStart(VertexId, FaceId),
}
