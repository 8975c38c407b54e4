//! Reading a file of any format.

use crate::document::Document;
use crate::error::{Fault, ReadError};
use crate::npz::{self, Array};
use crate::{Format, gltf, obj, off, packed, ply, stl};
use std::fs;
use std::io::Read;
use std::path::Path;

/// Reads a file; its extension tells the format, that before `.gz` where it is compressed by gzip. A file without faces gives a
/// document without triangles.
///
/// What is in a compressed file may take 200 times its size or 64 MiB, whichever is more, and at most 4 GiB. A gltf file may name buffers in files beside it, which are read too.
pub fn read(path: &Path) -> Result<Document, ReadError> {
    let format = readable_format(path).ok_or_else(|| ReadError::UnknownFormat { path: path.to_owned() })?;
    let mut bytes = fs::read(path).map_err(|source| ReadError::Io { path: path.to_owned(), source })?;
    if packed::name_inside(path).is_some() {
        bytes = packed::unpack(&bytes).map_err(|fault| fault.at(path))?;
    }
    let directory = path.parent().unwrap_or(Path::new(""));
    parse(&bytes, format, Some(directory)).map_err(|fault| fault.at(path))
}

/// Reads the contents of a file. A gltf file must hold its buffers; one that names other files is refused.
pub fn read_bytes(bytes: &[u8], format: Format) -> Result<Document, ReadError> {
    parse(bytes, format, None).map_err(|fault| fault.at(Path::new("<bytes>")))
}

/// Reads what a stream holds up to its end, standard input say; compressed by gzip or not, which its first bytes tell. `name` stands for
/// the path in errors.
///
/// The limits of [`read()`] hold. A gltf file must hold its buffers.
pub fn read_from(stream: &mut impl Read, name: &str, format: Format) -> Result<Document, ReadError> {
    let name = Path::new(name);
    let mut bytes = Vec::new();
    stream.read_to_end(&mut bytes).map_err(|source| ReadError::Io { path: name.to_owned(), source })?;
    if packed::is_packed(&bytes) {
        bytes = packed::unpack(&bytes).map_err(|fault| fault.at(name))?;
    }
    parse(&bytes, format, None).map_err(|fault| fault.at(name))
}

/// Reads the arrays of an npz, as `numpy.savez` and `numpy.savez_compressed` write it, whatever the extension of `path`: `float64`, `int64` and
/// `int32` in C order, little endian. An npy, as `numpy.save` writes it, has one array without a name.
///
/// Fails for what is no npz, is damaged, or holds arrays of another kind. The limits of [`read()`] hold.
pub fn read_arrays(path: &Path) -> Result<Vec<Array<'static>>, ReadError> {
    let bytes = fs::read(path).map_err(|source| ReadError::Io { path: path.to_owned(), source })?;
    npz::read(&bytes).map_err(|fault| fault.at(path))
}

/// The same of the contents of a file.
pub fn read_arrays_bytes(bytes: &[u8]) -> Result<Vec<Array<'static>>, ReadError> {
    npz::read(bytes).map_err(|fault| fault.at(Path::new("<bytes>")))
}

/// The format that [`read()`] would take a file of this name for: that of its extension, before `.gz` where there is one.
pub fn readable_format(path: &Path) -> Option<Format> {
    Format::from_path(packed::name_inside(path).as_deref().unwrap_or(path))
}

fn parse(bytes: &[u8], format: Format, directory: Option<&Path>) -> Result<Document, Fault> {
    match format {
        Format::Obj => obj::read(bytes),
        Format::Ply => ply::read(bytes),
        Format::Stl => stl::read(bytes),
        Format::Off => off::read(bytes),
        Format::Gltf | Format::Glb => gltf::read(bytes, directory),
    }
}
