//! One file of a batch, from its start to its line.

use super::child::{self, Ended, Limits};
use super::line::{Line, Outcome};
use super::plan::{BatchFile, BatchPlan};
use crate::failure::{Failure, Kind};
use anyhow::Context as _;
use std::fs::{self, File};
use std::io;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// Remeshes a file in a process of its own and puts the result in its place; `number` tells it from the others of this run. None when it
/// was stopped. Fails only where the batch cannot go on.
pub(super) fn remesh(plan: &BatchPlan, file: &BatchFile, number: usize, stop: impl Fn() -> bool) -> anyhow::Result<Option<Line>> {
    // Unlike all others, even where the children of a batch that was killed have not ended yet.
    let folder = plan.unfinished.join(format!("{}-{number}", std::process::id()));
    fs::create_dir_all(&folder).with_context(|| format!("cannot make the folder {}", folder.display()))?;
    let result = folder.join("result").with_extension(plan.format.extension());
    let start = Instant::now();
    let mut command = command(plan, file, &result)?;
    command.stdout(new_file(&folder, "stdout")?).stderr(new_file(&folder, "stderr")?);
    let ended = child::run(&mut command, plan.limits, stop).context("cannot start a process for a file")?;
    let seconds = start.elapsed().as_secs_f64();
    let outcome = outcome(&ended, plan.limits, &folder).map(|outcome| match put(plan, file, &result, &outcome) {
        Ok(()) => outcome,
        Err(e) => Outcome::Failed(Failure::of(e)),
    });
    // What cannot be removed now is with the whole folder, at the end or when the batch is resumed.
    fs::remove_dir_all(&folder).ok();
    Ok(outcome.map(|outcome| {
        let output = matches!(outcome, Outcome::Made { .. }).then(|| file.output.display().to_string());
        Line { input: file.input.display().to_string(), output, seconds, options: plan.told_options(), outcome }
    }))
}

fn command(plan: &BatchPlan, file: &BatchFile, result: &Path) -> anyhow::Result<Command> {
    let mut command = Command::new(std::env::current_exe().context("cannot find this program to start it for a file")?);
    command.args(["remesh", "--json", "--quiet", "--end-with-stdin"]).args(&plan.options);
    command.arg("--threads").arg(plan.threads.to_string()).arg("--output").arg(result).arg("--").arg(&file.input);
    Ok(command)
}

fn new_file(folder: &Path, name: &str) -> anyhow::Result<File> {
    let path = folder.join(name);
    File::create(&path).with_context(|| format!("cannot make {}", path.display()))
}

/// How the file came out by what its process did and said; none where it was stopped.
fn outcome(ended: &Ended, limits: Limits, folder: &Path) -> Option<Outcome> {
    let failed = |kind, message: String| Some(Outcome::Failed(Failure::new(kind, message)));
    match ended {
        Ended::Stopped => None,
        Ended::OverTime => {
            let seconds = limits.time.unwrap_or_default().as_secs_f64();
            failed(
                Kind::Timeout,
                format!("not done after {seconds} s; raise --timeout, or ask for fewer base vertices or levels"),
            )
        }
        Ended::OverMemory => {
            let gib = limits.memory.unwrap_or_default();
            failed(Kind::Memory, format!("took more than {gib} GiB; raise --memory, or ask for fewer base vertices or levels"))
        }
        Ended::ByItself(status) => {
            fs::read(folder.join("stdout")).ok().and_then(|json| Outcome::of_report(&json)).or_else(|| {
                let said = fs::read(folder.join("stderr")).unwrap_or_default();
                let said = String::from_utf8_lossy(&said);
                let last = said.trim_end().lines().last().unwrap_or("it said nothing");
                failed(Kind::Crash, format!("its process ended without a report ({status}): {last}"))
            })
        }
    }
}

/// Puts a result, complete as it is, in its place.
fn put(plan: &BatchPlan, file: &BatchFile, result: &Path, outcome: &Outcome) -> anyhow::Result<()> {
    if let Outcome::Failed(_) = outcome {
        return Ok(());
    }
    let place = plan.out.join(&file.output);
    let made = place.parent().map_or(Ok(()), fs::create_dir_all).and_then(|()| fs::rename(result, &place));
    made.map_err(|e: io::Error| {
        anyhow::Error::from(e).context(format!("cannot write {}; check the permissions of its folder", place.display()))
    })
}
