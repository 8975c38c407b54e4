//! Why two meshes cannot be measured.

use mesh_core::TriMesh;

/// There is nothing to measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the mesh has no surface: {faces} faces and no area that is a number above 0")]
pub struct NoSurface {
    /// Number of faces.
    pub faces: usize,
}

impl NoSurface {
    /// Fails on a mesh without area, or with one that overflows.
    pub(crate) fn check(mesh: &TriMesh) -> Result<(), Self> {
        let area = mesh.total_area();
        if area > 0.0 && area.is_finite() { Ok(()) } else { Err(Self { faces: mesh.n_faces() }) }
    }
}

/// Two meshes are not measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum MeasureError {
    /// The original.
    #[error("original: {0}")]
    Original(NoSurface),
    /// The remeshed one.
    #[error("remeshed: {0}")]
    Remeshed(NoSurface),
    /// The caller has ended it ([`crate::Reference::with_interrupt`]).
    #[error("measuring was interrupted")]
    Interrupted,
}
