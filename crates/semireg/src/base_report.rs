//! What the stages up to the base mesh made, in figures.

use crate::BaseStages;
use mesh_core::VertexId;
use region_map::ArcKind;

impl BaseStages {
    /// Patches, network corners and network arcs.
    pub fn cell_counts(&self) -> [usize; 3] {
        [self.segmentation.n_patches, self.network.corners.len(), self.network.arcs.len()]
    }

    /// Length of the creases that were kept in the network, and of those that were left out as minor, in the units of the mesh.
    pub fn crease_length(&self) -> [f64; 2] {
        let kept = self.network.arcs.iter().filter(|a| a.kind == ArcKind::Sharp).map(|a| a.length()).sum();
        let length = |chain: &[VertexId]| -> f64 { chain.windows(2).map(|w| self.working.mesh.distance(w[0], w[1])).sum() };
        [kept, self.network.minor.iter().map(|c| length(c)).sum()]
    }
}
