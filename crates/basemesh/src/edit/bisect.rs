//! More base vertices in a few places.

use crate::BaseError;
use crate::editor::Editor;
use mesh_core::VertexId;
use region_map::{BaseMesh, Surface};

/// Puts a new base vertex in the middle of some edges, one after the other: each divides the faces at its edge in two. Nothing else
/// changes: vertices keep their places and numbers, the new ones come last, in the order of the edges, which may end at new ones.
///
/// An edge on an arc is halved by arc length, any other one where the map has its middle. Fails where there is no such edge (any more),
/// and for a base mesh that does not fit the surface.
pub fn bisect(surface: &Surface, base: BaseMesh, edges: &[[VertexId; 2]]) -> Result<BaseMesh, BaseError> {
    base.check(surface)?;
    let mut editor = Editor::new(surface, base);
    for &[a, b] in edges {
        editor.split(a, b).ok_or(BaseError::NoSuchEdge(a, b))?;
    }
    editor.finish()
}
