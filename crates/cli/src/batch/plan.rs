//! A batch, checked and made ready, before any long work.

use super::child::Limits;
use super::line::Line;
use super::lines::Opening;
use super::{handed_on, inputs, names};
use crate::args::BatchArgs;
use crate::failure::{Failure, Kind};
use crate::plan::remesh_options;
use crate::talk::Talk;
use anyhow::Context as _;
use mesh_io::Format;
use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;

/// A checked `semireg batch`.
pub(super) struct BatchPlan {
    /// In the order of their paths.
    pub(super) files: Vec<BatchFile>,
    pub(super) out: PathBuf,
    /// The file of lines.
    pub(super) lines: PathBuf,
    /// Where results are until they are complete.
    pub(super) unfinished: PathBuf,
    pub(super) opening: Opening,
    pub(super) format: Format,
    /// What all files are remeshed with, as `remesh` takes it.
    pub(super) options: Vec<OsString>,
    /// Files at the same time.
    pub(super) jobs: usize,
    /// Threads for each.
    pub(super) threads: usize,
    pub(super) limits: Limits,
    pub(super) talk: Talk,
}

/// A file of a batch.
pub(super) struct BatchFile {
    /// An absolute path.
    pub(super) input: PathBuf,
    /// A path below the output folder.
    pub(super) output: PathBuf,
}

impl BatchPlan {
    /// Finds the files, names their results and makes the output folder.
    pub(super) fn new(args: &BatchArgs) -> anyhow::Result<Self> {
        // What is wrong with the options is told once, not of each file.
        remesh_options(&args.making, &args.result)?;
        let listed = args.list.as_deref().map(inputs::listed).transpose()?;
        let found = inputs::find(listed.as_ref().unwrap_or(&args.inputs), &args.out)?;
        let format = args.format;
        let results = names::results(&found.files, &found.root, format.extension())?;
        let all = found.files.into_iter().zip(results);
        let all: Vec<BatchFile> = all.map(|(input, output)| BatchFile { input, output }).collect();
        check_overwrite(&all, &args.out)?;
        let processors = thread::available_parallelism().map_or(1, usize::from);
        let jobs = args.jobs.map_or(processors, usize::from);
        let name = args.shard.map_or("results".to_owned(), |shard| format!("results-{shard}"));
        fs::create_dir_all(&args.out).with_context(|| format!("cannot make the folder {} (--out)", args.out.display()))?;
        Ok(Self {
            files: if let Some(shard) = args.shard { shard.pick(all) } else { all },
            out: args.out.clone(),
            lines: args.out.join(format!("{name}.jsonl")),
            unfinished: args.out.join(format!(".{name}.unfinished")),
            opening: opening(args),
            format,
            options: handed_on::handed_on(),
            jobs,
            threads: args.threads.map_or((processors / jobs).max(1), usize::from),
            limits: Limits { time: args.timeout.map(Duration::from_secs_f64), memory: args.memory },
            talk: args.talk,
        })
    }

    /// What is told of each file in its line: the options that its result depends on.
    pub(super) fn told_options(&self) -> Vec<String> {
        let format = format!("--format={}", self.format.extension());
        std::iter::once(format).chain(self.options.iter().map(|option| option.to_string_lossy().into_owned())).collect()
    }

    /// The files that are not done, and the lines of those that are. Fails where these were made with other options.
    pub(super) fn split(&self, done: Vec<Line>) -> anyhow::Result<(Vec<Line>, Vec<&BatchFile>)> {
        let options = self.told_options();
        if let Some(line) = done.iter().find(|line| line.options != options) {
            let (lines, [was, is]) = (self.lines.display(), [&line.options, &options].map(|options| options.join(" ")));
            let message = format!("{lines} has results of `{was}`, not `{is}`; give the same options, or name another --out");
            return Err(Failure::new(Kind::Usage, message).into());
        }
        let mut lines: BTreeMap<String, Line> = done.into_iter().map(|line| (line.input.clone(), line)).collect();
        let (mut kept, mut open) = (Vec::new(), Vec::new());
        for file in &self.files {
            match lines.remove(&file.input.display().to_string()) {
                Some(line) => kept.push(line),
                None => open.push(file),
            }
        }
        Ok((kept, open))
    }
}

fn opening(args: &BatchArgs) -> Opening {
    match (args.resume, args.force) {
        (true, _) => Opening::Resume,
        (_, true) => Opening::Anew,
        _ => Opening::New,
    }
}

/// No result takes the place of an input, by whatever name or link.
fn check_overwrite(files: &[BatchFile], out: &Path) -> Result<(), Failure> {
    let read: BTreeSet<PathBuf> = files.iter().filter_map(|file| fs::canonicalize(&file.input).ok()).collect();
    for BatchFile { output, .. } in files {
        let output = out.join(output);
        if fs::canonicalize(&output).is_ok_and(|place| read.contains(&place)) {
            let message = format!("would write over {}, which is an input; name another --out", output.display());
            return Err(Failure::new(Kind::Overwrite, message));
        }
    }
    Ok(())
}
