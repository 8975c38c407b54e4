//! Meshes from files, as they are.

use anyhow::Context as _;
use mesh_core::{Soup, TriMesh};
use std::path::Path;

/// A mesh that was not cleaned.
pub(crate) struct Raw {
    pub(crate) mesh: TriMesh,
    /// Triangles that no mesh can hold, left out: an index is out of range, or two are the same.
    pub(crate) left_out: usize,
}

/// The mesh of a file without any repair: order and vertices stay.
pub(crate) fn raw(path: &Path) -> anyhow::Result<Raw> {
    let Soup { positions, mut triangles } = mesh_io::read(path)?.soup;
    let read = triangles.len();
    triangles.retain(|&[a, b, c]| a != b && b != c && c != a && [a, b, c].iter().all(|&v| (v as usize) < positions.len()));
    let left_out = read - triangles.len();
    let mesh = TriMesh::new(positions, triangles).with_context(|| path.display().to_string())?;
    Ok(Raw { mesh, left_out })
}
