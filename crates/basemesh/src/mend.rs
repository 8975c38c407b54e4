//! What would end in triangles without area: ears, and needles in a base mesh from elsewhere.

use crate::BaseError;
use crate::arguments::check_base;
use crate::editor::Editor;
use crate::shape::{flip_gain, is_ear};
use mesh_core::VertexId;
use region_map::{BaseMesh, Surface};

/// A triangle of lower quality (AR) in a base mesh from elsewhere is a needle. Vertices that are off the surface can end up side by
/// side on it (block's QEM base of 524 vertices: 2e-5 of a mean edge apart).
const NEEDLE: f64 = 0.01;
/// Passes over the ears of a base mesh from elsewhere.
const EAR_ROUNDS: usize = 10;
/// Moves of the vertices of needles.
const NEEDLE_ROUNDS: usize = 5;

/// What was mended in a base mesh from elsewhere.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mended {
    /// Triangles with two edges on arcs that go on nearly straight at their common vertex: their subdivisions end in a triangle without
    /// area there. They were taken away by flips, or where those do not help by splits.
    pub ears: usize,
    /// Vertices of needles that were moved inside their sheet.
    pub moved: usize,
}

/// Mends what would end in triangles without area, and nothing else: see [`Mended`].
///
/// Fails where the base mesh does not fit the surface.
pub fn mend(surface: &Surface, base: BaseMesh) -> Result<(BaseMesh, Mended), BaseError> {
    check_base(surface, &base)?;
    let mut editor = Editor::new(surface, base);
    let mut mended = Mended::default();
    // A flip can leave the next ear of a row.
    for _ in 0..EAR_ROUNDS {
        let ears = mend_ears(&mut editor);
        mended.ears += ears;
        if ears == 0 {
            break;
        }
    }
    for _ in 0..NEEDLE_ROUNDS {
        let quality = |f: &[VertexId; 3]| mesh_core::aspect_ratio(f.map(|v| editor.position(v)));
        let mut crowded: Vec<VertexId> = editor.faces().into_iter().filter(|f| quality(f) < NEEDLE).flatten().collect();
        crowded.sort_unstable();
        crowded.dedup();
        mended.moved = mended.moved.max(crowded.into_iter().filter(|&v| editor.relax_vertex(v)).count());
    }
    Ok((editor.finish()?, mended))
}

/// Takes ears away: by a flip where that helps, else at a new vertex on the edge off the arcs, or where there is none (a disk inside a
/// small loop) inside. Returns how many there were.
pub(crate) fn mend_ears(editor: &mut Editor<'_>) -> usize {
    let mut ears = 0;
    for face in editor.faces() {
        if !editor.is_face(face) || !is_ear(editor, face) {
            continue;
        }
        let sides = [0, 1, 2].map(|i| [face[i], face[(i + 1) % 3]]);
        match sides.into_iter().find(|&[a, b]| editor.span(a, b).is_none()) {
            Some([a, b]) if flip_gain(editor, a, b) > 0.0 && editor.flip(a, b) => None,
            Some([a, b]) => editor.split(a, b),
            None => editor.split_face(face),
        };
        ears += 1;
    }
    ears
}
