//! What would end in triangles without area, in a base mesh from elsewhere: straight corners and needles.

use crate::BaseError;
use crate::editor::Editor;
use crate::improve::open_straight_corners;
use mesh_core::VertexId;
use region_map::{BaseMesh, Surface};

/// A triangle of lower quality (AR) in a base mesh from elsewhere is a needle. Vertices that are off the surface can end up side by
/// side on it (block's QEM base of 524 vertices: 2e-5 of a mean edge apart).
const NEEDLE: f64 = 0.01;
/// Passes over the straight corners of a base mesh from elsewhere: a flip can leave the next one of a row.
const STRAIGHT_ROUNDS: usize = 10;
/// Moves of the vertices of needles.
const NEEDLE_ROUNDS: usize = 5;

/// A base mesh from elsewhere, mended.
#[derive(Clone, Debug)]
pub struct Mended {
    /// The base mesh. Vertices that were there keep their numbers.
    pub base: BaseMesh,
    /// Triangles that had a straight corner: two edges on arcs that go on nearly straight at their common vertex, where all their
    /// subdivisions would have a triangle without area. They were flipped, or where that does not help split.
    pub straight_corners: usize,
    /// Vertices of needles that were moved inside their sheet.
    pub moved: usize,
}

/// Mends what would end in triangles without area, and nothing else: see [`Mended`].
///
/// Fails where the base mesh does not fit the surface.
pub fn mend(surface: &Surface, base: BaseMesh) -> Result<Mended, BaseError> {
    base.check(surface)?;
    let mut editor = Editor::new(surface, base);
    let (mut straight_corners, mut moved) = (0, 0);
    for _ in 0..STRAIGHT_ROUNDS {
        let found = open_straight_corners(&mut editor);
        straight_corners += found;
        if found == 0 {
            break;
        }
    }
    for _ in 0..NEEDLE_ROUNDS {
        let quality = |f: &[VertexId; 3]| mesh_core::aspect_ratio(f.map(|v| editor.position(v)));
        let mut crowded: Vec<VertexId> = editor.faces().into_iter().filter(|f| quality(f) < NEEDLE).flatten().collect();
        crowded.sort_unstable();
        crowded.dedup();
        moved = moved.max(crowded.into_iter().filter(|&v| editor.relax_vertex(v)).count());
    }
    Ok(Mended { base: editor.finish()?, straight_corners, moved })
}
