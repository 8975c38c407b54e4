//! The folder of `--displacement`: the base mesh, and the displacements of all levels.

use crate::displacement_arrays::arrays;
use crate::displacement_figures::DisplacementFigures;
use crate::failure::{Failure, Kind};
use anyhow::Context as _;
use displacement::{EncodeOptions, encode, figures};
use mesh_core::TriMesh;
use mesh_io::{Attributes, ControlMesh, Format, Settings, WriteError};
use std::path::{Path, PathBuf};

/// The arrays, from which the mesh can be decoded.
pub(crate) const ARRAYS: &str = "displacement.npz";
const USDA: &str = "base.usda";
const GLB: &str = "base.glb";
const FIGURES: &str = "displacement.json";

/// Every file of a folder.
pub(crate) fn files(folder: &Path) -> Vec<PathBuf> {
    [ARRAYS, USDA, GLB, FIGURES].iter().map(|name| folder.join(name)).collect()
}

/// What the files are made from.
pub(crate) struct Contents<'a> {
    /// The finest level that is written, in our order of faces.
    pub(crate) mesh: &'a TriMesh,
    /// Its number.
    pub(crate) level: u32,
    pub(crate) bits: Option<u8>,
    /// Edges of the base mesh that are sharp.
    pub(crate) creases: &'a [[u32; 2]],
    /// Vertices of the base mesh that stay where they are when it is subdivided.
    pub(crate) corners: &'a [u32],
}

/// Writes all files into a folder that exists, or none; returns the figures.
pub(crate) fn write(folder: &Path, contents: &Contents) -> anyhow::Result<DisplacementFigures> {
    let Contents { mesh, level, bits, creases, corners } = *contents;
    let displacement = encode(mesh, level, &EncodeOptions { bits }).context("cannot make the displacement of the result")?;
    let name = folder.display().to_string();
    let figures = DisplacementFigures::new(name, bits, &figures(&displacement, mesh)?);
    let base = &displacement.base;
    let lines = Settings { attributes: &Attributes::default(), lines: creases };
    let files = [
        (ARRAYS, mesh_io::array_bytes(&arrays(&displacement))?),
        (USDA, mesh_io::usda_bytes(&ControlMesh { mesh: base, creases, corners }).map_err(told)?),
        (GLB, mesh_io::write_bytes_with(base, &lines, Format::Glb).map_err(told)?),
        (FIGURES, (serde_json::to_string_pretty(&figures)? + "\n").into_bytes()),
    ];
    mesh_io::write_files(&files.map(|(name, bytes)| (folder.join(name), bytes)))?;
    Ok(figures)
}

/// Single precision is no choice of the user's here.
fn told(error: WriteError) -> anyhow::Error {
    match error {
        WriteError::NotSinglePrecision { vertex } => {
            let what = format!("vertex {vertex} is too large for the single precision of {USDA} and {GLB}");
            Failure::new(Kind::Format, format!("{what}; scale the input down, or leave --displacement out")).into()
        }
        other => other.into(),
    }
}
