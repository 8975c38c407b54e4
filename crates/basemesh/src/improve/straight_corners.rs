//! Straight corners: triangles between two arcs that are one line.

use super::shape::{IdealValences, flip_gain, has_straight_corner};
use crate::editor::Editor;

/// Takes straight corners away: by a flip where that helps, else at a new vertex on the edge off the arcs, or where there is none (a disk
/// inside a small loop) inside. Returns how many triangles had one.
pub(crate) fn open_straight_corners(editor: &mut Editor<'_>) -> usize {
    let mut found = 0;
    for face in editor.faces() {
        if !editor.is_face(face) || !has_straight_corner(editor, face) {
            continue;
        }
        let sides = [0, 1, 2].map(|i| [face[i], face[(i + 1) % 3]]);
        match sides.into_iter().find(|&[a, b]| editor.span(a, b).is_none()) {
            Some([a, b]) if flip_gain(editor, &mut IdealValences::default(), a, b) > 0.0 && editor.flip(a, b) => None,
            Some([a, b]) => editor.split(a, b),
            None => editor.split_face(face),
        };
        found += 1;
    }
    found
}
