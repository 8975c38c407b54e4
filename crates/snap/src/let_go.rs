//! What shall be left as it is.

use mesh_core::{EdgeId, VertexId};
use std::collections::BTreeSet;

/// What shall not be snapped to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LetGo {
    /// Bends, by their vertices of the working mesh.
    pub bends: BTreeSet<VertexId>,
    /// Edges of minor creases.
    pub minor: BTreeSet<EdgeId>,
}
