//! What can go wrong between sites and base mesh.

use region_map::PatchId;

/// Why there is no base mesh.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BaseError {
    /// Patches that can't be laid flat: their charts collapse in floating point, shrink a part of the patch too much, or can't be
    /// triangulated. Split them and try again.
    #[error("{} patches are too long or too winding to lay flat, the first is patch {}; split them and try again", .0.len(), .0.first().map_or(0, |p| p.0))]
    Uncharted(Vec<PatchId>),
    /// The patches don't join to a mesh: a bug of ours.
    #[error("internal error: the patches do not join to a base mesh ({0}); please report this with the input file")]
    Internal(String),
}
