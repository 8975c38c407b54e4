//! What can be wrong with what is encoded or decoded.

use correspondence::CorrespondenceError;
use mesh_core::{MeshError, TopologyError};

/// Why there is no displacement, or no mesh.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DisplacementError {
    /// The mesh has not the levels that were asked for.
    #[error(transparent)]
    Levels(#[from] CorrespondenceError),
    /// The faces of a level are not an oriented manifold.
    #[error("level {level} is not an oriented manifold: {source}")]
    NotManifold {
        /// The level.
        level: u32,
        /// Where it is none.
        source: TopologyError,
    },
    /// The new vertices of a level are not numbered by the edges that they are in the middle of.
    #[error("the new vertices of level {level} are not in the order of the edges of level {}; give a mesh as it was remeshed", level - 1)]
    OtherNumbering {
        /// The level.
        level: u32,
    },
    /// Quantisation to so many bits is not possible.
    #[error("numbers cannot be quantised to {0} bits; ask for 2 to 24")]
    Bits(u8),
    /// There is no such level.
    #[error("there is no level {level}: the finest is level {finest}; ask for one from 0 to that")]
    NoLevel {
        /// The level asked for.
        level: u32,
        /// The finest level.
        finest: u32,
    },
    /// A level has not as many numbers as it needs.
    #[error("level {level} has {found} {what} where its edges need {expected}; write the displacement again")]
    Count {
        /// The level.
        level: u32,
        /// Which numbers.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
    /// A level makes no mesh: a displacement or a coordinate is not finite, or too large.
    #[error("the displacements of level {level} make no mesh: {source}")]
    NoMesh {
        /// The level.
        level: u32,
        /// What is wrong with the mesh.
        source: MeshError,
    },
    /// Figures are asked of another mesh than the one that was encoded.
    #[error("the mesh has other faces than the finest level of the displacement; give the mesh that was encoded")]
    OtherMesh,
}
