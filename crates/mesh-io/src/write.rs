//! Writing a file of any format.

use crate::attributes::Attributes;
use crate::error::WriteError;
use crate::npz::Array;
use crate::settings::{Level, Settings};
use crate::{Format, gltf, npz, obj, off, packed, ply, stl};
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

/// The same with attributes and lines.
///
/// Where a vertex has several normals or texture coordinates, a gltf gets copies of it, after all vertices of the mesh; `extras` of the gltf mesh
/// says of which vertices (`semireg`, `copy_of`), and [`read`](crate::read()) puts them together again. Triangles of a gltf keep their order
/// through its primitives, of which there is one for each run of triangles of the same material. A ply gets normals where every vertex has
/// only one.
///
/// Fails where an array of the attributes is neither empty nor as long as the mesh has vertices or triangles, or a line names a vertex that is
/// not there.
pub fn write_with(path: &Path, mesh: &TriMesh, settings: &Settings) -> Result<(), WriteError> {
    replace(path, &write_bytes_with(mesh, settings, writable_format(path)?)?)
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
    let plain = |c: [u8; 3]| [f64::from(c[0]) / 255.0, f64::from(c[1]) / 255.0, f64::from(c[2]) / 255.0, 1.0];
    let mut attributes = Attributes { face_colors: face_colors.iter().copied().map(plain).collect(), ..Attributes::default() };
    if points.is_empty() {
        return replace(path, &ply::write(mesh, &Settings { attributes: &attributes, lines: &[] }));
    }
    attributes.colors = vec![plain(GREY); mesh.n_vertices()];
    attributes.colors.extend(points.iter().map(|(_, color)| plain(*color)));
    let positions = mesh.positions().iter().copied().chain(points.iter().map(|(p, _)| *p)).collect();
    let with_points = TriMesh::new(positions, mesh.face_arrays()).map_err(WriteError::Points)?;
    replace(path, &ply::write(&with_points, &Settings { attributes: &attributes, lines: &[] }))
}

/// Vertices of the mesh where points have colours.
const GREY: [u8; 3] = [205; 3];

/// Writes the levels of a mesh, the coarsest first, into one gltf or glb: each as a mesh of its own, named `level 0` and so on. Atomic as
/// [`write()`] is.
///
/// The scene shows the finest one alone, with its lines; those of the others are left out. The extension `MSFT_lod` names the others as its
/// coarser stand-ins; what does not know it reads the finest, as [`crate::read()`] does. Materials are those of the finest one.
///
/// Fails for another format, without levels, and where the vertices of a level are not the first ones of the next.
pub fn write_levels(path: &Path, levels: &[Level]) -> Result<(), WriteError> {
    levels.iter().try_for_each(|level| level.settings.check(level.mesh))?;
    let bytes = match writable_format(path)? {
        Format::Gltf => gltf::write_json(levels)?,
        Format::Glb => gltf::write_binary(levels)?,
        _ => return Err(WriteError::OneLevel { path: path.to_owned() }),
    };
    replace(path, &bytes)
}

/// Writes arrays into an npz, the format of `numpy.savez`, whatever the extension of `path`; atomic as [`write()`] is. The same arrays
/// give the same bytes.
pub fn write_arrays(path: &Path, arrays: &[Array]) -> Result<(), WriteError> {
    let bytes = array_bytes(arrays).map_err(|source| WriteError::Io { path: path.to_owned(), source })?;
    replace(path, &bytes)
}

/// The bytes that [`write_arrays`] would put into the file. Fails for names and arrays that are too long for a zip file.
pub fn array_bytes(arrays: &[Array]) -> io::Result<Vec<u8>> {
    npz::write(arrays)
}

/// Writes several files that belong together: the contents of each go to a temporary file beside it, and only when all are written do these
/// take the places of the targets.
///
/// Nothing is left on failure but, where a target cannot be replaced, those before it in the list.
pub fn write_files(files: &[(PathBuf, Vec<u8>)]) -> Result<(), WriteError> {
    let temporary: Vec<PathBuf> = files.iter().map(|(path, _)| temporary_beside(path)).collect();
    let failed = |path: &Path, source| WriteError::Io { path: path.to_owned(), source };
    let pairs = || files.iter().zip(&temporary);
    let written = pairs().try_for_each(|((path, bytes), temporary)| fs::write(temporary, bytes).map_err(|e| failed(path, e)));
    let replaced = written
        .and_then(|()| pairs().try_for_each(|((path, _), temporary)| fs::rename(temporary, path).map_err(|e| failed(path, e))));
    if replaced.is_err() {
        // Some were never made; the first error is the one to tell.
        temporary.iter().for_each(|path| drop(fs::remove_file(path)));
    }
    replaced
}

/// The bytes that [`write()`] would put into the file.
pub fn write_bytes(mesh: &TriMesh, format: Format) -> Result<Vec<u8>, WriteError> {
    write_bytes_with(mesh, &Settings { attributes: &Attributes::default(), lines: &[] }, format)
}

/// The bytes that [`write_with`] would put into the file.
pub fn write_bytes_with(mesh: &TriMesh, settings: &Settings, format: Format) -> Result<Vec<u8>, WriteError> {
    settings.check(mesh)?;
    match format {
        Format::Obj => Ok(obj::write(mesh, settings)),
        Format::Ply => Ok(ply::write(mesh, settings)),
        Format::Stl => stl::write(mesh),
        Format::Off => Ok(off::write(mesh)),
        Format::Gltf => gltf::write_json(&[Level { mesh, settings: *settings }]),
        Format::Glb => gltf::write_binary(&[Level { mesh, settings: *settings }]),
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
