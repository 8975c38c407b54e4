//! Edits that are chosen elsewhere.

use crate::BaseError;
use crate::editor::{Editor, Filling};
use region_map::{BaseEdit, BaseMesh, Surface};

/// A base mesh under edits that are chosen elsewhere, and its map with it.
pub struct Replay<'a> {
    editor: Editor<'a>,
}

impl<'a> Replay<'a> {
    /// Begins with a base mesh. Fails when it does not fit the surface.
    pub fn new(surface: &'a Surface, base: BaseMesh) -> Result<Self, BaseError> {
        base.check(surface)?;
        Ok(Self { editor: Editor::new(surface, base) })
    }

    /// Carries an edit out. False, changing nothing, where the mesh has no such vertex or edge, where it would not be simplicial then, and
    /// where a new face would face against the surface.
    pub fn edit(&mut self, edit: &BaseEdit) -> bool {
        let editor = &mut self.editor;
        match edit {
            BaseEdit::Flip([a, b]) => editor.flip(*a, *b),
            BaseEdit::Split([a, b]) => editor.split(*a, *b).is_some(),
            BaseEdit::Remove { vertex, filling } => {
                let hole = editor.hole(*vertex);
                let removal = hole.as_ref().and_then(|hole| editor.removal(hole, Filling::Given(filling)));
                removal.is_some_and(|removal| editor.take_away(&removal))
            }
        }
    }

    /// The base mesh as it is now. Vertices keep their order; those taken away leave no gap in the numbers.
    pub fn finish(self) -> Result<BaseMesh, BaseError> {
        self.editor.finish()
    }
}
