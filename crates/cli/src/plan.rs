//! What the user typed, checked and made ready, before any long work.

use crate::args::{BaseArgs, MakingArgs, MethodArg, RemeshArgs, ResultArgs, SourceArgs, StagesArgs};
use crate::failure::{Failure, Kind};
use crate::kept::FeaturesArg;
use crate::marks::Marks;
use crate::outputs::Outputs;
use crate::relaxation_args::RelaxationArg;
use crate::stream::{Source, Target};
use crate::talk::Talk;
use crate::{load, overwrite, stages};
use anyhow::Context as _;
use features::FeatureOptions;
use semireg::{Goal, MAX_TRIANGLES, Options, Relaxation, USUAL_LEVELS};
use std::fs::{self, File};
use std::path::{Path, PathBuf};

/// A checked `semireg remesh`.
pub(crate) struct RemeshPlan {
    pub(crate) input: Source,
    pub(crate) outputs: Outputs,
    /// Whether the user wants several results: then the report has a list of them.
    pub(crate) is_several: bool,
    /// A base mesh of the user's.
    pub(crate) base: Option<PathBuf>,
    pub(crate) options: Options,
    /// A size of the result that is asked for.
    pub(crate) goal: Option<Goal>,
    /// Edges of the input to keep.
    pub(crate) marks: Marks,
    /// Whether the output has positions and triangles alone.
    pub(crate) plain: bool,
    pub(crate) talk: Talk,
    pub(crate) stages: Option<PathBuf>,
    /// Whether the run ends with standard input.
    pub(crate) end_with_stdin: bool,
}

/// A checked `semireg base` or `semireg stages`.
pub(crate) struct BasePlan {
    pub(crate) input: Source,
    pub(crate) output: Option<Target>,
    pub(crate) options: Options,
    /// Edges of the input to keep.
    pub(crate) marks: Marks,
    pub(crate) talk: Talk,
    pub(crate) stages: Option<PathBuf>,
}

impl RemeshPlan {
    /// Checks that the result can be written, sets up the threads and takes over the options.
    pub(crate) fn new(args: RemeshArgs) -> anyhow::Result<Self> {
        let mut options = remesh_options(&args.source.making, &args.result)?;
        let (input, output) = args.streams.ends(&args.source.input, &args.output)?;
        let pictures = args.stages.as_deref().map(|folder| stages::files(folder, true)).unwrap_or_default();
        let goal = args.result.goal.goal(args.result.levels);
        if goal.is_none() && args.outputs.level.is_some() {
            // Who asks for a level counts on the usual ones.
            options.levels = options.levels.or(Some(USUAL_LEVELS));
        }
        let levels = goal.map_or(options.levels, |goal| goal.levels);
        let outputs = Outputs::new(&args.outputs, &output, levels, args.source.making.seed)?;
        let files = outputs.files();
        check_overwrite(&args.source, args.base.as_deref(), &[pictures.as_slice(), files.as_slice()].concat())?;
        // First, as the result may go into the same folder.
        args.stages.as_deref().map(|folder| make_folder(folder, "--stages")).transpose()?;
        outputs.folders().try_for_each(|folder| make_folder(folder, "--displacement"))?;
        output.file().map(check_output).transpose()?;
        files.iter().try_for_each(|file| check_place(file))?;
        files.iter().try_for_each(|file| overwrite::check_distinct(file, &pictures))?;
        overwrite::check_different(&files)?;
        start_threads(&args.source)?;
        add_files(&mut options, &args.source)?;
        let (talk, marks, is_several) = (args.talk(), Marks::asked(&args.source.making), args.outputs.variants.is_some());
        let RemeshArgs { base, stages, end_with_stdin, result, .. } = args;
        Ok(Self { input, outputs, is_several, base, options, goal, marks, plain: result.plain, talk, stages, end_with_stdin })
    }
}

/// The options of a remeshing, but for those that belong to one input.
pub(crate) fn remesh_options(making: &MakingArgs, result: &ResultArgs) -> Result<Options, Failure> {
    let mut options = base_options(making)?;
    options.levels = result.levels;
    check_size(making.base_vertices, result.levels)?;
    options.fit = options.fit.filter(|_| !result.no_fit);
    options.relaxation = relaxation(making, result)?;
    Ok(options)
}

impl BasePlan {
    /// Checks that the base mesh can be written, sets up the threads and takes over the options.
    pub(crate) fn base(args: BaseArgs) -> anyhow::Result<Self> {
        let (input, output) = args.streams.ends(&args.source.input, &args.output)?;
        if let Some(file) = output.file() {
            check_overwrite(&args.source, None, &[file.to_owned()])?;
            check_output(file)?;
        }
        start_threads(&args.source)?;
        let options = source_options(&args.source)?;
        let marks = Marks::asked(&args.source.making);
        Ok(Self { input, output: Some(output), options, marks, talk: args.talk(), stages: None })
    }

    /// Makes the folder, sets up the threads and takes over the options.
    pub(crate) fn stages(args: StagesArgs) -> anyhow::Result<Self> {
        let input = args.stream.source(&args.source.input)?;
        check_overwrite(&args.source, None, &stages::files(&args.dir, false))?;
        make_folder(&args.dir, "--dir")?;
        start_threads(&args.source)?;
        let options = source_options(&args.source)?;
        let marks = Marks::asked(&args.source.making);
        Ok(Self { input, output: None, options, marks, talk: args.source.talk, stages: Some(args.dir) })
    }
}

/// Nothing that is read is written over, unless the user wants that.
fn check_overwrite(args: &SourceArgs, base: Option<&Path>, written: &[PathBuf]) -> Result<(), Failure> {
    if args.force {
        return Ok(());
    }
    let read = [Some(args.input.as_path()), base, args.marked_edges.as_deref(), args.density.as_deref()];
    overwrite::check(read.into_iter().flatten(), written)
}

fn make_folder(folder: &Path, option: &str) -> anyhow::Result<()> {
    fs::create_dir_all(folder).with_context(|| format!("cannot make the folder {} ({option})", folder.display()))
}

fn start_threads(args: &SourceArgs) -> anyhow::Result<()> {
    let Some(n) = args.threads else { return Ok(()) };
    rayon::ThreadPoolBuilder::new().num_threads(n.into()).build_global().context("cannot start the threads")
}

/// The options of a base mesh of one input.
fn source_options(args: &SourceArgs) -> anyhow::Result<Options> {
    let mut options = base_options(&args.making)?;
    add_files(&mut options, args)?;
    Ok(options)
}

/// Adds what other files than the input say.
fn add_files(options: &mut Options, args: &SourceArgs) -> anyhow::Result<()> {
    options.marked_edges = args.marked_edges.as_deref().map(load::lines).transpose()?.unwrap_or_default();
    options.density = args.density.as_deref().map(load::density).transpose()?;
    Ok(())
}

/// The options that all commands share.
fn base_options(args: &MakingArgs) -> Result<Options, Failure> {
    let mut options = Options { seed: args.seed, method: args.method.into(), ..Options::default() };
    options.base_vertices = args.base_vertices.map(|n| n as usize);
    options.clean.close_t_vertices = args.close_t_vertices;
    options.gradation = args.gradation.unwrap_or(options.gradation);
    check_features(args)?;
    let features = &mut options.features;
    if args.features != FeaturesArg::Creases {
        features.strong_angle = FeatureOptions::NO_CREASES;
    }
    features.strong_angle = args.crease_angle.unwrap_or(features.strong_angle);
    features.weak_angle = args.weak_angle.unwrap_or(features.weak_angle.min(features.strong_angle));
    if features.weak_angle > features.strong_angle {
        let (weak, strong) = (features.weak_angle, features.strong_angle);
        let message =
            format!("--weak-angle {weak} is above the crease angle of {strong} degrees; lower it or raise --crease-angle");
        return Err(Failure::new(Kind::Usage, message));
    }
    Ok(options)
}

/// Angles are given only where creases are looked for.
fn check_features(args: &MakingArgs) -> Result<(), Failure> {
    let given = [("--crease-angle", args.crease_angle), ("--weak-angle", args.weak_angle)];
    match given.iter().find(|(_, angle)| angle.is_some()) {
        Some((option, _)) if args.features != FeaturesArg::Creases => {
            let features = args.features.name();
            let message = format!("{option} has no meaning with --features {features}; leave one of them out");
            Err(Failure::new(Kind::Usage, message))
        }
        _ => Ok(()),
    }
}

/// How the finest level is relaxed: as its base mesh is made, where nothing else is asked for.
fn relaxation(making: &MakingArgs, result: &ResultArgs) -> Result<Relaxation, Failure> {
    let default = if matches!(making.method, MethodArg::Paper) { RelaxationArg::Paper } else { RelaxationArg::Shape };
    result.relaxation.relaxation(default).map_err(|option| {
        let message = format!("{option} has no meaning without --relaxation paper; add that or leave {option} out");
        Failure::new(Kind::Usage, message)
    })
}

/// A closed surface has about two triangles a vertex.
fn check_size(base_vertices: Option<u32>, levels: Option<u32>) -> Result<(), Failure> {
    let triangles = (2 * u64::from(base_vertices.unwrap_or(0))) << (2 * levels.unwrap_or(0));
    if triangles > MAX_TRIANGLES {
        let message = format!(
            "the result would have about {triangles} triangles, more than {MAX_TRIANGLES}; lower --base-vertices or --levels"
        );
        return Err(Failure::new(Kind::TooLarge, message));
    }
    Ok(())
}

/// The extension is known, and the folder is there and takes files.
pub(crate) fn check_output(output: &Path) -> anyhow::Result<()> {
    mesh_io::writable_format(output).with_context(|| format!("cannot write {}", output.display()))?;
    check_place(output)
}

/// It is no folder, and the folder that it is in takes files.
fn check_place(output: &Path) -> anyhow::Result<()> {
    let name = output.display();
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
        assert!(check_size(Some(2000), Some(6)).is_ok());
        assert!(check_size(Some(u32::MAX), Some(8)).is_err());
    }
}
