//! `semireg decode DIR`: the mesh that a folder of displacements stands for.

use crate::decode_args::DecodeArgs;
use crate::displacement_arrays::displacement;
use crate::displacement_folder::{ARRAYS, files};
use crate::failure::{Failure, Kind};
use crate::overwrite;
use crate::plan::check_output;
use crate::print::{self, Table};
use displacement::{DisplacementError, Residual};
use serde::Serialize;
use std::path::Path;

#[derive(Serialize)]
struct Decoded {
    version: &'static str,
    folder: String,
    output: String,
    level: u32,
    /// The finest level that there is.
    finest_level: u32,
    /// Whether the tangential residual was used.
    residual: bool,
    vertices: usize,
    faces: usize,
}

/// Decodes a level and writes it.
pub(crate) fn run(args: &DecodeArgs) -> anyhow::Result<()> {
    let target = args.target()?;
    if let Some(output) = target.file() {
        if !args.force {
            overwrite::check(files(&args.folder).iter().map(AsRef::as_ref), &[output.to_owned()])?;
        }
        check_output(output)?;
    }
    let path = args.folder.join(ARRAYS);
    check_folder(&args.folder, &path)?;
    let displacement = displacement(&path, mesh_io::read_arrays(&path)?)?;
    let finest = displacement.finest();
    let level = args.level.unwrap_or(finest);
    let residual = if args.no_residual { Residual::Dropped } else { Residual::Kept };
    let mesh = displacement.decode(level, residual).map_err(|e| failure(&path, e))?;
    target.write(&mesh)?;
    let decoded = Decoded {
        version: env!("CARGO_PKG_VERSION"),
        folder: args.folder.display().to_string(),
        output: target.to_string(),
        level,
        finest_level: finest,
        residual: !args.no_residual,
        vertices: mesh.n_vertices(),
        faces: mesh.n_faces(),
    };
    print::report(args.talk(), &decoded, || table(&decoded), || table(&decoded))
}

/// A folder without displacements is told as such.
fn check_folder(folder: &Path, path: &Path) -> Result<(), Failure> {
    if path.is_file() {
        return Ok(());
    }
    let message = format!("there is no {ARRAYS} in {}; name a folder that remesh --displacement wrote", folder.display());
    Err(Failure::new(Kind::Io, message))
}

/// An error of the library as one of the file.
fn failure(path: &Path, error: DisplacementError) -> Failure {
    match error {
        DisplacementError::NoLevel { level, finest } => {
            let message = format!("--level {level} is above the finest level, {finest}; lower it");
            Failure::new(Kind::Usage, message)
        }
        error => Failure::new(Kind::Parse, format!("{}: {error}", path.display())),
    }
}

fn table(decoded: &Decoded) -> Table {
    let Decoded { output, level, finest_level, vertices, faces, .. } = decoded;
    let mut table = Table::default();
    table.row("written", output);
    table.row("level", format!("{level} of {finest_level}: {vertices} vertices, {faces} faces"));
    table.row("residual", if decoded.residual { "used" } else { "left out" });
    table
}
