//! What can go wrong with a file.

use std::io;
use std::path::{Path, PathBuf};

/// Why a file was not read.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The extension is not that of a format we know.
    #[error("{}: the extension names no mesh format; use obj, ply, stl, off, gltf or glb", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
    /// The file could not be read at all.
    #[error("cannot read {}; check the path and its permissions", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The contents break the rules of the format.
    #[error("{}{}: {what}; {remedy}", path.display(), line.map(|l| format!(":{l}")).unwrap_or_default())]
    Malformed {
        /// The file; `<bytes>` when the contents were given by themselves.
        path: PathBuf,
        /// The line, counted from 1, in text formats.
        line: Option<usize>,
        /// What is wrong.
        what: String,
        /// What to do.
        remedy: &'static str,
    },
    /// The contents are right but use a part of the format that we do not read.
    #[error("{}: {what}; {remedy}", path.display())]
    Unsupported {
        /// The file; `<bytes>` when the contents were given by themselves.
        path: PathBuf,
        /// What is not supported.
        what: String,
        /// What to do.
        remedy: &'static str,
    },
}

/// Why a mesh was not written. The target is as it was before.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The extension is not that of a format we know.
    #[error("{}: the extension names no mesh format; use obj, ply, stl, off, gltf or glb", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
    /// Files are read compressed, but not written so.
    #[error("{}: compressed files are read, but not written; leave .gz off, and compress the file afterwards", path.display())]
    Packed {
        /// The file.
        path: PathBuf,
    },
    /// The file could not be written.
    #[error("cannot write {}; check that its directory exists and can be written to", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A coordinate is too large for a format that stores f32.
    #[error("vertex {vertex} is too large for single precision; write obj, ply or off instead")]
    NotSinglePrecision {
        /// The vertex.
        vertex: usize,
    },
    /// The mesh needs more than the 4 GB that the format can hold.
    #[error("the mesh is too large for {format}; write obj, ply or off instead")]
    TooLarge {
        /// The format.
        format: &'static str,
    },
    /// Several levels for a format that holds one mesh.
    #[error("{} can hold one mesh only; write gltf or glb, or each level into a file of its own", path.display())]
    OneLevel {
        /// The file.
        path: PathBuf,
    },
    /// A level has other vertices than the first ones of the finest, or there is none.
    #[error("level {level} is no coarser level of the finest: its vertices are not the first ones of that")]
    NoLevel {
        /// The number of the level.
        level: usize,
    },
    /// Not one colour for each face.
    #[error("{colors} colours for {faces} faces; give one for each face")]
    ColorCount {
        /// Number of colours given.
        colors: usize,
        /// Number of faces.
        faces: usize,
    },
    /// A list of attributes that is not one of the mesh.
    #[error("{what}: {found} entries where the mesh needs {expected}; give one for each")]
    AttributeCount {
        /// Of what.
        what: String,
        /// Number of entries given.
        found: usize,
        /// Number of vertices or faces.
        expected: usize,
    },
    /// A line that ends nowhere.
    #[error("a line ends at vertex {vertex}, but there are only {vertices}; give lines between vertices of the mesh")]
    NoSuchVertex {
        /// The vertex.
        vertex: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// Points beside the mesh that no mesh can hold.
    #[error("the coloured points cannot be written: {0}")]
    Points(mesh_core::MeshError),
}

const EXPORT_AGAIN: &str = "correct it or export the file again";
const PACK_AGAIN: &str = "compress it again, or copy it again from where it came";

/// What a reader of one format found wrong; it becomes a [`ReadError`] where the path is known.
#[derive(Debug)]
pub(crate) enum Fault {
    Malformed { line: Option<usize>, what: String },
    Packed { what: String },
    Unsupported { what: String, remedy: &'static str },
    Io { path: PathBuf, source: io::Error },
}

impl Fault {
    /// A fault in a line of text, counted from 1.
    pub(crate) fn line(line: usize, what: impl Into<String>) -> Self {
        Self::Malformed { line: Some(line), what: what.into() }
    }
    /// A fault in binary data, or of the file as a whole.
    pub(crate) fn data(what: impl Into<String>) -> Self {
        Self::Malformed { line: None, what: what.into() }
    }
    /// A fault of a compressed file, whatever it holds.
    pub(crate) fn packed(what: impl Into<String>) -> Self {
        Self::Packed { what: what.into() }
    }
    /// Something that we do not read.
    pub(crate) fn unsupported(what: impl Into<String>, remedy: &'static str) -> Self {
        Self::Unsupported { what: what.into(), remedy }
    }
    /// The same, said of a part of the file.
    pub(crate) fn of(self, part: &str) -> Self {
        match self {
            Self::Malformed { line, what } => Self::Malformed { line, what: format!("{part}: {what}") },
            Self::Packed { what } => Self::Packed { what: format!("{part}: {what}") },
            Self::Unsupported { what, remedy } => Self::Unsupported { what: format!("{part}: {what}"), remedy },
            Self::Io { .. } => self,
        }
    }
    /// The error of the file at `path`.
    pub(crate) fn at(self, path: &Path) -> ReadError {
        let path = path.to_owned();
        match self {
            Self::Malformed { line, what } => ReadError::Malformed { path, line, what, remedy: EXPORT_AGAIN },
            Self::Packed { what } => ReadError::Malformed { path, line: None, what, remedy: PACK_AGAIN },
            Self::Unsupported { what, remedy } => ReadError::Unsupported { path, what, remedy },
            Self::Io { path, source } => ReadError::Io { path, source },
        }
    }
}
