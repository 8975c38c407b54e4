//! Meshes from files, as they are.

use anyhow::{Context as _, bail};
use glam::DVec3;
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

/// The lines of a file, by the positions of their ends.
pub(crate) fn lines(path: &Path) -> anyhow::Result<Vec<[DVec3; 2]>> {
    let (document, name) = (mesh_io::read(path)?, path.display());
    if document.lines.is_empty() {
        bail!("{name} has no lines; give them as `l` of an obj or as the element `edge` of a ply");
    }
    let position = |v: u32| document.soup.positions.get(v as usize).copied();
    let ends = |(i, &[a, b]): (usize, &[u32; 2])| {
        let ends = position(a).zip(position(b)).map(|(a, b)| [a, b]);
        ends.with_context(|| format!("{name}: line segment {} has an end that is no vertex of the file; correct it", i + 1))
    };
    document.lines.iter().enumerate().map(ends).collect()
}
