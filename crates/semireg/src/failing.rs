//! The triangles for which the certificate would refuse a mesh.

use certify::{DEGENERATE_ASPECT_RATIO, Surface, flipped};
use mesh_core::{FaceId, TriMesh, aspect_ratio};
use std::collections::BTreeSet;

/// What the certificate says of the triangles of a mesh.
pub(crate) struct Failing {
    /// Those that face against the input and those of next to no area, in rising order.
    pub(crate) faces: Vec<FaceId>,
    /// How many face against the input.
    pub(crate) flipped: usize,
}

impl Failing {
    pub(crate) fn of(mesh: &TriMesh, input: &Surface) -> Self {
        let is_degenerate = |f: &FaceId| aspect_ratio(mesh.triangle(*f)) < DEGENERATE_ASPECT_RATIO;
        let flipped = flipped(input, mesh);
        let faces: BTreeSet<FaceId> = flipped.iter().copied().chain(mesh.faces().ids().filter(is_degenerate)).collect();
        Self { faces: faces.into_iter().collect(), flipped: flipped.len() }
    }
}
