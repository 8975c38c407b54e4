//! [`Displacement`]: a base mesh and the numbers of its levels.

use crate::Coefficients;
use mesh_core::TriMesh;

/// A base mesh and how the new vertices of each level are displaced from the middles of edges.
///
/// The numbers of a level are in the order of its new vertices, which is that of the edges of the level before: as its faces have them first.
#[derive(Clone, Debug, PartialEq)]
pub struct Displacement {
    /// The mesh of level 0, an oriented manifold. Its vertices are in every level, in the same place.
    pub base: TriMesh,
    /// Levels 1, 2 and so on.
    pub levels: Vec<LevelDisplacement>,
}

/// The displacements of the new vertices of a level, in the units of the mesh. [`Frame`](crate::Frame) has the axes.
#[derive(Clone, Debug, PartialEq)]
pub struct LevelDisplacement {
    /// Along the normal: one number for each new vertex.
    pub scalar: Coefficients,
    /// Along the edge and across it: two numbers for each new vertex.
    pub residual: Coefficients,
}

/// What is done with the tangential residual.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Residual {
    /// It is added: the mesh comes back to rounding, or to quantisation.
    #[default]
    Kept,
    /// It is taken as 0: every vertex is displaced along a normal.
    Dropped,
}

impl Displacement {
    /// The number of the finest level.
    pub fn finest(&self) -> u32 {
        self.levels.len() as u32
    }
}
