//! `-` on the command line: standard input in the place of a file that is read, standard output in that of one that is written.

use crate::failure::{Failure, Kind};
use crate::print;
use mesh_core::TriMesh;
use mesh_io::{Attributes, Document, Format, ReadError, Settings, WriteError, writable_format};
use std::fmt::{self, Display, Formatter};
use std::io;
use std::path::{Path, PathBuf};

/// Where a mesh is read from.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Source {
    File(PathBuf),
    StandardInput(Format),
}

/// Where a mesh is written to.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Target {
    File(PathBuf),
    StandardOutput(Format),
}

/// Whether a path means standard input or output.
pub(crate) fn is_stream(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Fails where a format is given and nothing goes through `-` that has it.
pub(crate) fn check_meant(option: &str, format: Option<Format>, is_used: bool) -> Result<(), Failure> {
    if format.is_none() || is_used {
        return Ok(());
    }
    let message = format!("{option} is the format of what goes through `-`, and nothing does; leave it out: extensions tell");
    Err(Failure::new(Kind::Usage, message))
}

fn needed(stream: &str) -> Failure {
    let formats = Format::ALL.map(Format::extension).join(", ");
    Failure::new(Kind::Usage, format!("`-` has no extension that tells the format of {stream}; add --format: {formats}"))
}

impl Source {
    /// A file, or standard input in this format.
    pub(crate) fn new(path: &Path, format: Option<Format>) -> Result<Self, Failure> {
        if !is_stream(path) {
            return Ok(Self::File(path.to_owned()));
        }
        format.map(Self::StandardInput).ok_or_else(|| needed("standard input"))
    }

    /// The folder that it is in; the present one for standard input.
    pub(crate) fn folder(&self) -> &Path {
        match self {
            Self::File(path) => path.parent().unwrap_or(Path::new("")),
            Self::StandardInput(_) => Path::new(""),
        }
    }

    /// Reads it to its end; standard input may be compressed by gzip.
    pub(crate) fn read(&self) -> Result<Document, ReadError> {
        match self {
            Self::File(path) => mesh_io::read(path),
            Self::StandardInput(format) => mesh_io::read_from(&mut io::stdin().lock(), &self.to_string(), *format),
        }
    }
}

impl Display for Source {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::File(path) => path.display().fmt(f),
            Self::StandardInput(_) => f.write_str("standard input"),
        }
    }
}

impl Target {
    /// A file, or standard output in this format.
    pub(crate) fn new(path: &Path, format: Option<Format>) -> Result<Self, Failure> {
        if !is_stream(path) {
            return Ok(Self::File(path.to_owned()));
        }
        format.map(Self::StandardOutput).ok_or_else(|| needed("standard output"))
    }

    /// The file; none for standard output.
    pub(crate) fn file(&self) -> Option<&Path> {
        match self {
            Self::File(path) => Some(path),
            Self::StandardOutput(_) => None,
        }
    }

    /// The folder that it is in; the present one for standard output.
    pub(crate) fn folder(&self) -> &Path {
        self.file().and_then(Path::parent).unwrap_or(Path::new(""))
    }

    /// The format that it has.
    pub(crate) fn format(&self) -> Result<Format, WriteError> {
        match self {
            Self::File(path) => writable_format(path),
            Self::StandardOutput(format) => Ok(*format),
        }
    }

    /// Writes the mesh, and nothing beside.
    pub(crate) fn write(&self, mesh: &TriMesh) -> anyhow::Result<()> {
        self.write_with(mesh, &Settings { attributes: &Attributes::default(), lines: &[] })
    }

    /// Writes the mesh with what belongs to it.
    pub(crate) fn write_with(&self, mesh: &TriMesh, settings: &Settings) -> anyhow::Result<()> {
        let format = match self {
            Self::File(path) => return Ok(mesh_io::write_with(path, mesh, settings)?),
            Self::StandardOutput(format) => *format,
        };
        print::bytes(print::Stream::Output, &mesh_io::write_bytes_with(mesh, settings, format)?)
    }
}

impl Display for Target {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::File(path) => path.display().fmt(f),
            Self::StandardOutput(_) => f.write_str("standard output"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dash_needs_a_format_and_a_file_none() {
        assert_eq!(Source::new("-".as_ref(), Some(Format::Stl)).unwrap(), Source::StandardInput(Format::Stl));
        assert_eq!(Source::new("./-".as_ref(), None).unwrap(), Source::File("./-".into()));
        assert_eq!(Target::new("-.obj".as_ref(), Some(Format::Ply)).unwrap(), Target::File("-.obj".into()));
        let error = Target::new("-".as_ref(), None).unwrap_err();
        assert!(error.exit_code() == 2 && error.to_string().contains("add --format: obj, ply"), "{error}");
    }

    #[test]
    fn a_format_that_nothing_has_is_told() {
        assert!(check_meant("--format", None, false).is_ok() && check_meant("--format", Some(Format::Obj), true).is_ok());
        assert_eq!(check_meant("--format", Some(Format::Obj), false).unwrap_err().exit_code(), 2);
    }
}
