//! What the user typed, checked and made ready, before any long work.

use crate::args::{BaseArgs, MethodArg, RemeshArgs, SourceArgs, StagesArgs, Talk};
use crate::failure::{Failure, Kind};
use crate::{load, overwrite, stages};
use anyhow::Context as _;
use semireg::{MAX_TRIANGLES, Method, Options};
use std::fs::{self, File};
use std::path::{Path, PathBuf};

/// A checked `semireg remesh`.
pub(crate) struct RemeshPlan {
    pub(crate) input: PathBuf,
    pub(crate) output: PathBuf,
    /// A base mesh of the user's.
    pub(crate) base: Option<PathBuf>,
    pub(crate) options: Options,
    pub(crate) talk: Talk,
    pub(crate) stages: Option<PathBuf>,
}

/// A checked `semireg base` or `semireg stages`.
pub(crate) struct BasePlan {
    pub(crate) input: PathBuf,
    pub(crate) output: Option<PathBuf>,
    pub(crate) options: Options,
    pub(crate) talk: Talk,
    pub(crate) stages: Option<PathBuf>,
}

impl RemeshPlan {
    /// Checks that the result can be written, sets up the threads and takes over the options.
    pub(crate) fn new(args: RemeshArgs) -> anyhow::Result<Self> {
        check_size(args.source.base_vertices, args.levels)?;
        check_paper(&args)?;
        let pictures = args.stages.as_deref().map(|folder| stages::files(folder, true)).unwrap_or_default();
        check_overwrite(&args.source, args.base.as_deref(), &[pictures.as_slice(), std::slice::from_ref(&args.output)].concat())?;
        // First, as the result may go into the same folder.
        args.stages.as_deref().map(|folder| make_folder(folder, "--stages")).transpose()?;
        check_output(&args.output)?;
        overwrite::check_distinct(&args.output, &pictures)?;
        start_threads(&args.source)?;
        let mut options = Options { levels: args.levels, ..source_options(&args.source)? };
        options.fit = options.fit.filter(|_| !args.no_fit);
        if let Method::Paper(paper) = &mut options.method {
            *paper = args.paper.options();
        }
        let RemeshArgs { source, output, base, stages, .. } = args;
        Ok(Self { input: source.input, output, base, options, talk: source.talk, stages })
    }
}

impl BasePlan {
    /// Checks that the base mesh can be written, sets up the threads and takes over the options.
    pub(crate) fn base(args: BaseArgs) -> anyhow::Result<Self> {
        check_overwrite(&args.source, None, std::slice::from_ref(&args.output))?;
        check_output(&args.output)?;
        start_threads(&args.source)?;
        let options = source_options(&args.source)?;
        Ok(Self { input: args.source.input, output: Some(args.output), options, talk: args.source.talk, stages: None })
    }

    /// Makes the folder, sets up the threads and takes over the options.
    pub(crate) fn stages(args: StagesArgs) -> anyhow::Result<Self> {
        check_overwrite(&args.source, None, &stages::files(&args.dir, false))?;
        make_folder(&args.dir, "--dir")?;
        start_threads(&args.source)?;
        let options = source_options(&args.source)?;
        Ok(Self { input: args.source.input, output: None, options, talk: args.source.talk, stages: Some(args.dir) })
    }
}

/// Nothing that is read is written over, unless the user wants that.
fn check_overwrite(args: &SourceArgs, base: Option<&Path>, written: &[PathBuf]) -> Result<(), Failure> {
    if args.force {
        return Ok(());
    }
    let read = [Some(args.input.as_path()), base, args.marked_edges.as_deref()];
    overwrite::check(read.into_iter().flatten(), written)
}

fn make_folder(folder: &Path, option: &str) -> anyhow::Result<()> {
    fs::create_dir_all(folder).with_context(|| format!("cannot make the folder {} ({option})", folder.display()))
}

fn start_threads(args: &SourceArgs) -> anyhow::Result<()> {
    let Some(n) = args.threads else { return Ok(()) };
    rayon::ThreadPoolBuilder::new().num_threads(n.into()).build_global().context("cannot start the threads")
}

/// The options that all commands share.
fn source_options(args: &SourceArgs) -> anyhow::Result<Options> {
    let mut options = Options { seed: args.seed, method: args.method.into(), ..Options::default() };
    options.base_vertices = args.base_vertices.map(|n| n as usize);
    let features = &mut options.features;
    features.strong_angle = args.crease_angle.unwrap_or(features.strong_angle);
    features.weak_angle = args.weak_angle.unwrap_or(features.weak_angle.min(features.strong_angle));
    if features.weak_angle > features.strong_angle {
        let (weak, strong) = (features.weak_angle, features.strong_angle);
        let message =
            format!("--weak-angle {weak} is above the crease angle of {strong} degrees; lower it or raise --crease-angle");
        return Err(Failure::new(Kind::Usage, message).into());
    }
    options.marked_edges = args.marked_edges.as_deref().map(load::lines).transpose()?.unwrap_or_default();
    Ok(options)
}

/// What only the paper's method takes is given with no other.
fn check_paper(args: &RemeshArgs) -> Result<(), Failure> {
    match args.paper.given() {
        Some(option) if !matches!(args.source.method, MethodArg::Paper) => {
            let message = format!("{option} has no meaning without --method paper; add that or leave {option} out");
            Err(Failure::new(Kind::Usage, message))
        }
        _ => Ok(()),
    }
}

/// A closed surface has about two triangles a vertex.
fn check_size(base_vertices: Option<u32>, levels: u32) -> Result<(), Failure> {
    let triangles = (2 * u64::from(base_vertices.unwrap_or(0))) << (2 * levels);
    if triangles > MAX_TRIANGLES {
        let message = format!(
            "the result would have about {triangles} triangles, more than {MAX_TRIANGLES}; lower --base-vertices or --levels"
        );
        return Err(Failure::new(Kind::TooLarge, message));
    }
    Ok(())
}

/// The extension is known, and the folder is there and takes files.
fn check_output(output: &Path) -> anyhow::Result<()> {
    let name = output.display();
    mesh_io::writable_format(output).with_context(|| format!("cannot write {name}"))?;
    if output.is_dir() {
        return Err(Failure::new(Kind::Io, format!("cannot write {name}: it is a folder; name a file")).into());
    }
    let folder = output.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        let message = format!("cannot write {name}: there is no folder {}; make it or name another", folder.display());
        return Err(Failure::new(Kind::Io, message).into());
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
            let error = Failure::of(check_output(Path::new(output)).unwrap_err()).to_string();
            assert!(error.contains(part), "{error}");
        }
    }

    #[test]
    fn huge_results_are_refused() {
        assert!(check_size(Some(2000), 6).is_ok());
        assert!(check_size(Some(u32::MAX), 8).is_err());
    }
}
