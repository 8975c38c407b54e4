//! Edits that were chosen elsewhere.

use crate::BaseError;
use crate::editor::{Editor, Filling};
use region_map::{BaseCounts, BaseEdit, BaseMesh, Surface};

/// The base mesh after edits, in their order, and its map with it. Vertices keep their order; of those taken away the numbers are closed.
///
/// Fails where an edit does not fit the mesh, or would leave no simplicial one.
pub fn edited(surface: &Surface<'_>, base: BaseMesh, edits: &[BaseEdit]) -> Result<BaseMesh, BaseError> {
    let counts = base.counts.clone();
    let mut editor = Editor::new(surface, base)?;
    for (i, edit) in edits.iter().enumerate() {
        let done = match edit {
            BaseEdit::Flip([a, b]) => editor.flip_anyway(*a, *b),
            BaseEdit::Split([a, b]) => editor.split(*a, *b).is_some(),
            BaseEdit::Remove { vertex, filling } => {
                let removal = editor.removal(*vertex, Filling::Given(filling));
                removal.is_some_and(|removal| editor.take_away_anyway(&removal))
            }
        };
        if !done {
            return Err(BaseError::Edit(i));
        }
    }
    let base = editor.finish()?;
    Ok(BaseMesh { counts: BaseCounts { made: base.mesh.n_vertices(), ..counts }, ..base })
}
