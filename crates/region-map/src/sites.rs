//! Where the base vertices shall be.

use crate::{CellArcId, PatchId};
use mesh_core::{IdVec, SurfacePoint};

/// Sites of the base mesh (paper, section 3.2): the corners of the cells, and these.
#[derive(Clone, Debug, PartialEq)]
pub struct Sites {
    /// For every cell arc the arc lengths of its inner sites, rising, without both ends.
    pub on_arcs: IdVec<CellArcId, Vec<f64>>,
    /// For every patch its inner sites.
    pub in_patches: IdVec<PatchId, Vec<SurfacePoint>>,
}
