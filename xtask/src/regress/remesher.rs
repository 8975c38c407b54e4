//! One run of the binary, and what came of it.

use crate::process::within;
use anyhow::{Context, Result};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

/// The binary, a folder for its results, and the time it may take.
pub(super) struct Remesher {
    binary: PathBuf,
    folder: PathBuf,
    limit: Duration,
}

/// What to remesh, and how.
pub(super) struct Request<'a> {
    pub(super) input: &'a Path,
    pub(super) base_vertices: Option<usize>,
    pub(super) levels: u32,
    /// `None`: one for each processor.
    pub(super) threads: Option<usize>,
}

/// What came of a run.
pub(super) enum Outcome {
    /// Exit 0, and `semireg check` passes the file.
    Remeshed { output: PathBuf, report: Value, seconds: f64 },
    /// Exit 1 with its reason.
    Refused { reason: String, seconds: f64 },
    /// Stopped at the limit.
    Stopped { seconds: f64 },
    /// Anything else: a panic, a result that does not check.
    Failed { fault: String },
}

/// Column names of [`Outcome::row`].
pub(super) const HEADER: &str =
    "model                     status    asked   made       v     ar    p01   agl  err mean   err max  cover  flip  seconds";

impl Remesher {
    pub(super) fn new(binary: &Path, folder: &Path, limit: Duration) -> Result<Self> {
        fs::create_dir_all(folder).with_context(|| format!("cannot make {}", folder.display()))?;
        Ok(Self { binary: binary.to_owned(), folder: folder.to_owned(), limit })
    }

    /// Remeshes and checks the result.
    pub(super) fn run(&self, request: &Request) -> Result<Outcome> {
        let name = request.input.file_name().unwrap_or_default().to_string_lossy();
        let folder = self.folder.join(&*name);
        fs::create_dir_all(&folder).with_context(|| format!("cannot make {}", folder.display()))?;
        let output = folder.join("result.obj");
        let levels = request.levels.to_string();
        let mut command = Command::new(&self.binary);
        command.arg("remesh").arg(request.input).arg("-o").arg(&output).args(["--json", "--levels", &levels]);
        command.args(request.base_vertices.map(|n| format!("--base-vertices={n}")));
        command.args(request.threads.map(|n| format!("--threads={n}")));
        let ended = within(self.limit, &mut command, &folder)?;
        Ok(match ended.code {
            Some(0) => self.checked(output, &ended.stdout, &levels, ended.seconds)?,
            Some(1) if ended.last_error.starts_with("error: ") && !ended.last_error.contains("internal error") => {
                Outcome::Refused { reason: ended.last_error, seconds: ended.seconds }
            }
            Some(code) => Outcome::Failed { fault: format!("exit {code}: {}", ended.last_error) },
            None => Outcome::Stopped { seconds: ended.seconds },
        })
    }

    /// The file must say by itself that it is what the report promises.
    fn checked(&self, output: PathBuf, report: &str, levels: &str, seconds: f64) -> Result<Outcome> {
        let Ok(report) = serde_json::from_str::<Value>(report) else {
            return Ok(Outcome::Failed { fault: "the report is not JSON".to_owned() });
        };
        let check =
            within(self.limit, Command::new(&self.binary).arg("check").arg(&output).args(["--levels", levels]), &self.folder)?;
        let clean = report["flipped"] == 0 && report["degenerate"] == 0;
        Ok(match check.code {
            Some(0) if clean => Outcome::Remeshed { output, report, seconds },
            Some(0) => Outcome::Failed { fault: "the report has flipped or degenerate triangles".to_owned() },
            _ => Outcome::Failed { fault: format!("the result does not check: {}", check.last_error) },
        })
    }
}

impl Outcome {
    /// What must not happen on any input.
    pub(super) fn fault(&self) -> Option<String> {
        match self {
            Self::Failed { fault } => Some(fault.clone()),
            Self::Stopped { seconds } => Some(format!("stopped after {seconds:.0} s")),
            _ => None,
        }
    }

    /// The same, where the time that a run takes does not count.
    pub(super) fn fault_but_time(&self) -> Option<String> {
        self.fault().filter(|_| !matches!(self, Self::Stopped { .. }))
    }

    /// A row of the table.
    pub(super) fn row(&self, name: &str) -> String {
        match self {
            Self::Remeshed { report, seconds, .. } => format!("{name:25} ok {} {seconds:8.1}", figures(report)),
            Self::Refused { reason, seconds } => format!("{name:25} refused {seconds:.1} s  {reason}"),
            Self::Stopped { seconds } => format!("{name:25} stopped after {seconds:.0} s"),
            Self::Failed { fault } => format!("{name:25} FAILED  {fault}"),
        }
    }
}

fn figures(report: &Value) -> String {
    let whole = |pointer: &str| report.pointer(pointer).and_then(Value::as_u64).unwrap_or(0);
    let real = |key: &str| report[key].as_f64().unwrap_or(f64::NAN);
    let cover = report["crease_cover"].as_f64().map_or("-".to_owned(), |c| format!("{c:.3}"));
    format!(
        "{:>12} {:6} {:7} {:6.3} {:6.3} {:5.1} {:9.2e} {:9.2e} {cover:>6} {:5}",
        whole("/base_vertices/asked"),
        whole("/base_vertices/made"),
        whole("/vertices"),
        real("ar_mean"),
        real("ar_p01"),
        real("agl"),
        real("err_mean"),
        real("err_max"),
        whole("/flipped"),
    )
}
