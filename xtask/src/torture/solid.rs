//! A solid, and what came of it.

use super::judgement::End;
use std::path::PathBuf;

/// A solid in its file.
#[derive(Clone, Debug)]
pub(super) struct Solid {
    pub(super) seed: u64,
    pub(super) kind: String,
    pub(super) triangles: String,
    /// What was done to it after it was made.
    pub(super) disturbed: String,
    pub(super) input: PathBuf,
}

/// What came of a solid.
#[derive(Debug)]
pub(super) struct Judged {
    pub(super) seed: u64,
    pub(super) kind: String,
    pub(super) end: End,
    /// Of processor time.
    pub(super) seconds: f64,
}
