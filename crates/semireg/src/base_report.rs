//! What the stages up to the base mesh made, in figures.

use crate::BaseStages;

impl BaseStages {
    /// Patches, network corners and network arcs.
    pub fn cell_counts(&self) -> [usize; 3] {
        [self.patches.as_ref().map_or(0, |p| p.segmentation.n_patches), self.network.corners.len(), self.network.arcs.len()]
    }

    /// Length of the creases that were kept in the network, and of those that were left out as minor, in the units of the mesh.
    pub fn crease_length(&self) -> [f64; 2] {
        self.network.crease_lengths(&self.working.mesh)
    }
}
