//! The line of a face.

use std::fmt::Write as _;

/// Appends the line of a face with these corners, vertices counted from 0.
pub(super) fn push_face(text: &mut String, corners: impl Iterator<Item = i64>) {
    text.push('f');
    for corner in corners {
        // Writing to a String cannot fail.
        let _ = write!(text, " {}", corner + 1);
    }
    text.push('\n');
}
