//! One run of the remesher, and what it took.

use crate::cost::{Cost, measured};
use crate::markdown::{error, reason};
use crate::process::within;
use anyhow::{Context, Result};
use serde_json::Value;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

/// A built program.
pub(super) struct Program {
    pub(super) binary: PathBuf,
    /// For its results.
    pub(super) folder: PathBuf,
    /// Processor seconds that a run may take.
    pub(super) limit: u64,
}

/// What to remesh.
#[derive(Clone, Debug)]
pub(super) struct Job {
    pub(super) name: String,
    pub(super) input: PathBuf,
    pub(super) base_vertices: usize,
    pub(super) levels: u32,
}

/// How a run ended.
pub(super) enum Run {
    /// The result checks.
    Done { report: Value, cost: Cost, output: PathBuf },
    /// Without a result: why, and what it took.
    Without { reason: String, cost: Cost },
}

impl Program {
    /// Remeshes with all stages on so many threads, then checks the result, which is not in the measure.
    pub(super) fn remesh(&self, job: &Job, threads: usize) -> Result<Run> {
        fs::create_dir_all(&self.folder).with_context(|| format!("cannot make {}", self.folder.display()))?;
        // In a format without text, so that most of the time is not spent on writing digits.
        let output = self.folder.join(format!("{}_{}_{}_{threads}.ply", job.name, job.base_vertices, job.levels));
        let mut args: Vec<OsString> = vec!["remesh".into(), job.input.clone().into(), "-o".into(), output.clone().into()];
        let (base, levels) = (format!("--base-vertices={}", job.base_vertices), format!("--levels={}", job.levels));
        args.extend([base, levels.clone(), format!("--threads={threads}"), "--json".into()].map(OsString::from));
        if output.exists() {
            fs::remove_file(&output)?;
        }
        let (ended, cost) = measured(self.limit, &self.binary, &args, &self.folder)?;
        let without = |reason: String| Ok(Run::Without { reason, cost });
        match ended.code {
            Some(0) => {}
            None if cost.processor_seconds > self.limit as f64 - 1.0 => return without(format!("stopped at {} s", self.limit)),
            Some(1) => return without(format!("refused: {}", reason(&ended.last_error, &[&job.input]))),
            _ => return without(format!("FAILED: {}", reason(&ended.last_error, &[&job.input]))),
        }
        let mut check = Command::new(&self.binary);
        let check = within(Duration::MAX, check.arg("check").arg(&output).arg(levels), &self.folder)?;
        if check.code != Some(0) {
            return without(format!("FAILED: the result does not check: {}", check.last_error));
        }
        let report = serde_json::from_str(&ended.stdout).context("the report is not JSON")?;
        Ok(Run::Done { report, cost, output })
    }

    /// What `inspect` or `compare` print.
    pub(super) fn ask(&self, verb: &str, files: &[&Path]) -> Result<Value> {
        fs::create_dir_all(&self.folder)?;
        let ended = within(Duration::MAX, Command::new(&self.binary).arg(verb).args(files).arg("--json"), &self.folder)?;
        serde_json::from_str(&ended.stdout).with_context(|| format!("{verb} {files:?} gave no JSON: {}", ended.last_error))
    }

    /// Triangles of a file.
    pub(super) fn triangles(&self, input: &Path) -> Result<usize> {
        let answer = self.ask("inspect", &[input])?;
        answer["counts"]["triangles"]
            .as_u64()
            .map(|n| n as usize)
            .with_context(|| format!("{} has no triangles", input.display()))
    }
}

impl Run {
    pub(super) fn cost(&self) -> Cost {
        match self {
            Self::Done { cost, .. } | Self::Without { cost, .. } => *cost,
        }
    }

    pub(super) fn report(&self) -> Option<&Value> {
        match self {
            Self::Done { report, .. } => Some(report),
            Self::Without { .. } => None,
        }
    }

    /// Vertices, AR mean, mean error, processor seconds and megabytes as cells. Without a result the first says why.
    pub(super) fn cells(&self) -> Vec<String> {
        let Cost { processor_seconds, megabytes, .. } = self.cost();
        let figures = match self {
            Self::Done { report, .. } => {
                let real = |key: &str, text: &dyn Fn(f64) -> String| report[key].as_f64().map_or("-".to_owned(), text);
                [real("vertices", &|n| n.to_string()), real("ar_mean", &quality), real("err_mean", &error)]
            }
            Self::Without { reason, .. } => [reason.clone(), "-".to_owned(), "-".to_owned()],
        };
        [&figures[..], &[seconds(processor_seconds), format!("{megabytes:.0}")]].concat()
    }
}

pub(super) fn quality(ar: f64) -> String {
    format!("{ar:.3}")
}

pub(super) fn seconds(seconds: f64) -> String {
    format!("{seconds:.*}", usize::from(seconds < 100.0))
}

/// How many times the one is in the other.
pub(super) fn ratio(a: f64, b: f64) -> String {
    if b > 0.0 { format!("{:.2}", a / b) } else { "-".to_owned() }
}
