//! What can go wrong between sites and base mesh.

use region_map::PatchId;

/// Why there is no base mesh.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BaseError {
    /// Even the safest weights fold the chart of a patch in floating point: it is too long and thin. Split it.
    #[error("the chart of patch {0} collapses in floating point; split the patch and try again")]
    Collapsed(PatchId),
    /// The flat triangulation of a patch failed.
    #[error("the sites of patch {0} cannot be triangulated in its chart; split the patch and try again")]
    NotTriangulated(PatchId),
    /// The patches don't join to a mesh: a bug of ours.
    #[error("internal error: the patches do not join to a base mesh ({0}); please report this with the input file")]
    Internal(String),
}
