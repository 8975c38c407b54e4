//! Writing a file of any format.

use crate::error::WriteError;
use crate::{Format, gltf, obj, off, packed, ply, stl};
use glam::DVec3;
use mesh_core::TriMesh;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// Writes a mesh; the extension of `path` tells the format. Faces and vertices keep their order (stl has no vertices of its own).
///
/// Coordinates are kept to the last bit in obj, ply and off and rounded to f32 in the others. Atomic: the bytes go to a temporary
/// file in the same directory, which then takes the place of the target; nothing is left of it on failure.
pub fn write(path: &Path, mesh: &TriMesh) -> Result<(), WriteError> {
    replace(path, &write_bytes(mesh, writable_format(path)?)?)
}

/// The format that [`write()`] would write to this path. Fails for a name that it would refuse: without the extension of a format,
/// or ending in `.gz`.
pub fn writable_format(path: &Path) -> Result<Format, WriteError> {
    if packed::name_inside(path).is_some() {
        return Err(WriteError::Packed { path: path.to_owned() });
    }
    Format::from_path(path).ok_or_else(|| WriteError::UnknownFormat { path: path.to_owned() })
}

/// Writes a ply with one colour for each face, whatever the extension of `path`; atomic as [`write()`] is.
///
/// Coloured `points` that lie on the mesh become vertices without faces, after those of the mesh.
pub fn write_colored_ply(
    path: &Path,
    mesh: &TriMesh,
    face_colors: &[[u8; 3]],
    points: &[(DVec3, [u8; 3])],
) -> Result<(), WriteError> {
    if face_colors.len() != mesh.n_faces() {
        return Err(WriteError::ColorCount { colors: face_colors.len(), faces: mesh.n_faces() });
    }
    replace(path, &ply::write(mesh, Some(&ply::Colors { faces: face_colors, points })))
}

/// The bytes that [`write()`] would put into the file.
pub fn write_bytes(mesh: &TriMesh, format: Format) -> Result<Vec<u8>, WriteError> {
    match format {
        Format::Obj => Ok(obj::write(mesh)),
        Format::Ply => Ok(ply::write(mesh, None)),
        Format::Stl => stl::write(mesh),
        Format::Off => Ok(off::write(mesh)),
        Format::Gltf => gltf::write_json(mesh),
        Format::Glb => gltf::write_binary(mesh),
    }
}

/// Puts a file in the place of `path`, which keeps its old contents when that fails.
fn replace(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    let temporary = temporary_beside(path);
    let written = fs::write(&temporary, bytes).and_then(|()| fs::rename(&temporary, path));
    written.map_err(|source: io::Error| {
        // It may never have been made; the first error is the one to tell.
        let _ = fs::remove_file(&temporary);
        WriteError::Io { path: path.to_owned(), source }
    })
}

/// A name in the same directory that no other writer has: process and count make it so.
fn temporary_beside(path: &Path) -> PathBuf {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    let count = COUNT.fetch_add(1, Ordering::Relaxed);
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!(".{name}.{}-{count}.tmp", std::process::id()))
}
