//! More base vertices in a few places.

use crate::BaseError;
use crate::editor::Editor;
use mesh_core::VertexId;
use region_map::{BaseCounts, BaseMesh, Surface};

/// Puts a new base vertex in the middle of some edges, one after the other: each divides the faces at its edge in two. Nothing else
/// changes: vertices keep their places and numbers, the new ones come last, in the order of the edges, which may end at new ones.
///
/// An edge on an arc is halved by arc length, any other one where the map has its middle. Fails where there is no such edge (any more),
/// and for a base mesh that is not manifold.
pub fn bisect(surface: &Surface<'_>, base: BaseMesh, edges: &[[VertexId; 2]]) -> Result<BaseMesh, BaseError> {
    let counts = base.counts.clone();
    let mut editor = Editor::new(surface, base)?;
    for &[a, b] in edges {
        let is_done = editor.is_edge(a, b) && editor.split(a, b).is_some();
        is_done.then_some(()).ok_or_else(|| BaseError::Internal(format!("there is no edge from {a} to {b} to bisect")))?;
    }
    let mut base = editor.finish()?;
    base.counts = BaseCounts { made: base.mesh.n_vertices(), ..counts };
    Ok(base)
}
