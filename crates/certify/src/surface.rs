//! [`Surface`]: a mesh made ready for measuring.

use crate::edges::Edges;
use crate::weld::weld;
use mesh_core::{SurfaceIndex, TriMesh};

/// There is nothing to measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the mesh has no surface: {faces} faces and no area that is a number above 0")]
pub struct NoSurface {
    /// Number of faces.
    pub faces: usize,
}

/// A mesh with what all measures need of it. Face ids are those of the mesh.
pub struct Surface<'a> {
    /// The mesh as it is.
    pub(crate) mesh: &'a TriMesh,
    /// The mesh connected by position.
    pub(crate) welded: TriMesh,
    /// Edges of the welded mesh.
    pub(crate) welded_edges: Edges,
    /// Closest points on the mesh as it is.
    pub(crate) index: SurfaceIndex,
    /// Diagonal of the box, above 0.
    pub(crate) diagonal: f64,
}

impl<'a> Surface<'a> {
    /// Prepares a mesh. Fails on one without area, or with one that overflows.
    pub fn new(mesh: &'a TriMesh) -> Result<Self, NoSurface> {
        let area = mesh.total_area();
        if !(area > 0.0 && area.is_finite()) {
            return Err(NoSurface { faces: mesh.n_faces() });
        }
        let welded = weld(mesh);
        let welded_edges = Edges::of(welded.faces());
        Ok(Self { mesh, welded, welded_edges, index: SurfaceIndex::new(mesh), diagonal: mesh.diagonal() })
    }
}
