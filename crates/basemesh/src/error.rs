//! What can go wrong between sites and base mesh.

use mesh_core::VertexId;
use region_map::{BaseMeshError, PatchId, RegionMapError};

/// Why there is no base mesh.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BaseError {
    /// Patches that can't be laid flat: their charts collapse in floating point, shrink a part of the patch too much, or can't be
    /// triangulated. Split them and try again.
    #[error("{} patches are too long or too winding to lay flat, the first is patch {}; split them and try again", .0.len(), .0.first().map_or(0, |p| p.0))]
    Uncharted(Vec<PatchId>),
    /// An option is out of its range.
    #[error("the option {name} is {found}; it must be {expected}")]
    Option {
        /// Name of the option.
        name: &'static str,
        /// Its value.
        found: String,
        /// Its range, in words.
        expected: &'static str,
    },
    /// Two arguments are not of the same surface.
    #[error("{0} is not of this surface, or contradicts itself")]
    OtherSurface(&'static str),
    /// The vertices, edges and faces of a given base mesh are not where its region map says.
    #[error("the base mesh does not fit the surface: {0}")]
    Unfit(#[from] RegionMapError),
    /// There is no such edge (any more).
    #[error("there is no edge between base vertices {0} and {1}")]
    NoSuchEdge(VertexId, VertexId),
    /// The patches don't join to a mesh: a bug of ours.
    #[error("internal error: the patches do not join to a base mesh ({0}); please report this with the input file")]
    Internal(String),
}

impl From<BaseMeshError> for BaseError {
    fn from(error: BaseMeshError) -> Self {
        match error {
            BaseMeshError::Region(e) => Self::Unfit(e),
            BaseMeshError::OtherSurface(what) => Self::OtherSurface(what),
        }
    }
}
