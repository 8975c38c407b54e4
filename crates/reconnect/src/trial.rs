//! Edits that were tried.

use crate::change::Change;
use crate::editable_base::FaceIndex;
use crate::region::RelaxedRegion;
use mesh_core::VertexId;

/// Where a vertex could be put in or taken away.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Site {
    Edge([VertexId; 2]),
    Vertex(VertexId),
}

/// An edit that makes the energy grow by too much to be tried in earnest.
pub(crate) struct Hopeless {
    /// The faces that were relaxed with it, in rising order.
    pub(crate) region: Vec<FaceIndex>,
    /// What the clock of the search showed.
    pub(crate) at: usize,
}

/// An edit that was tried.
pub(crate) struct Trial {
    /// By how much the energy falls.
    pub(crate) gain: f64,
    /// The faces that were relaxed with it, in rising order.
    pub(crate) region: Vec<FaceIndex>,
    pub(crate) change: Change,
    pub(crate) relaxed: RelaxedRegion,
    /// What the clock of the search showed.
    pub(crate) at: usize,
}
