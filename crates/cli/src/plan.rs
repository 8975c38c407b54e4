//! What the user typed, checked and made ready, before any long work.

use crate::args::RemeshArgs;
use anyhow::{Context as _, bail};
use mesh_io::Format;
use semireg::{MAX_TRIANGLES, Options};
use std::fs::{self, File};
use std::path::{Path, PathBuf};

/// A checked `semireg remesh`.
pub(crate) struct RemeshPlan {
    pub(crate) input: PathBuf,
    pub(crate) output: PathBuf,
    pub(crate) options: Options,
    pub(crate) json: bool,
    pub(crate) stages: Option<PathBuf>,
}

impl RemeshPlan {
    /// Checks that the result can be written, sets up the threads and takes over the options.
    pub(crate) fn new(args: RemeshArgs) -> anyhow::Result<Self> {
        check_size(args.base_vertices, args.levels)?;
        // First, as the result may go into the same folder.
        if let Some(folder) = &args.stages {
            fs::create_dir_all(folder).with_context(|| format!("cannot make the folder {} (--stages)", folder.display()))?;
        }
        check_output(&args.output)?;
        if let Some(n) = args.threads {
            rayon::ThreadPoolBuilder::new().num_threads(n.into()).build_global().context("cannot start the threads")?;
        }
        let mut options = Options { levels: args.levels, seed: args.seed, ..Options::default() };
        options.base_vertices = args.base_vertices.map(|n| n as usize);
        if let Some(angle) = args.crease_angle {
            options.features.strong_angle = angle;
            options.features.weak_angle = options.features.weak_angle.min(angle);
        }
        Ok(Self { input: args.input, output: args.output, options, json: args.json, stages: args.stages })
    }
}

/// A closed surface has about two triangles a vertex.
fn check_size(base_vertices: Option<u32>, levels: u32) -> anyhow::Result<()> {
    let triangles = (2 * u64::from(base_vertices.unwrap_or(0))) << (2 * levels);
    if triangles > MAX_TRIANGLES {
        bail!("the result would have about {triangles} triangles, more than {MAX_TRIANGLES}; lower --base-vertices or --levels");
    }
    Ok(())
}

/// The extension is known, and the folder is there and takes files.
fn check_output(output: &Path) -> anyhow::Result<()> {
    let name = output.display();
    if Format::from_path(output).is_none() {
        bail!("cannot write {name}: the extension names no mesh format; use obj, ply, stl, off, gltf or glb");
    }
    if output.is_dir() {
        bail!("cannot write {name}: it is a folder; name a file");
    }
    let folder = output.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        bail!("cannot write {name}: there is no folder {}; make it or name another", folder.display());
    }
    let probe = folder.join(format!(".semireg-{}.tmp", std::process::id()));
    File::create(&probe).with_context(|| format!("cannot write into the folder {}; check its permissions", folder.display()))?;
    fs::remove_file(&probe).with_context(|| format!("cannot remove {}", probe.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_written_is_told_first() {
        for (output, part) in [
            ("out.xyz", "names no mesh format"),
            ("no/such/folder/out.obj", "there is no folder no/such/folder"),
            ("src", "names no mesh format"),
        ] {
            let error = check_output(Path::new(output)).unwrap_err().to_string();
            assert!(error.contains(part), "{error}");
        }
    }

    #[test]
    fn huge_results_are_refused() {
        assert!(check_size(Some(2000), 6).is_ok());
        assert!(check_size(Some(u32::MAX), 8).is_err());
    }
}
