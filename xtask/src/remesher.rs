//! One run of the binary, and what came of it.

use crate::models::LEVELS;
use crate::process::{cargo, must, target_directory, within};
use anyhow::{Context, Result};
use serde_json::Value;
use std::ffi::{OsStr, OsString};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

/// The binary, a folder for its results, and the time it may take.
pub(crate) struct Remesher {
    binary: PathBuf,
    folder: PathBuf,
    limit: Duration,
}

/// What to remesh, and how.
pub(crate) struct Request<'a> {
    pub(crate) input: &'a Path,
    pub(crate) base_vertices: Option<usize>,
    pub(crate) levels: u32,
    /// `None`: one for each processor.
    pub(crate) threads: Option<usize>,
    /// A base mesh from elsewhere, instead of a number of base vertices.
    pub(crate) base: Option<&'a Path>,
    pub(crate) fit: bool,
    /// More options of the program.
    pub(crate) options: &'a [&'a str],
}

impl<'a> Request<'a> {
    /// With the program's defaults.
    pub(crate) fn of(input: &'a Path) -> Self {
        Self { input, base_vertices: None, levels: LEVELS, threads: None, base: None, fit: true, options: &[] }
    }
}

/// What came of a run.
pub(crate) enum Outcome {
    /// Exit 0, and `semireg check` passes the file (of a remeshing or of a base mesh).
    Remeshed { output: PathBuf, report: Value, seconds: f64 },
    /// Exit 1 with its reason.
    Refused { reason: String, seconds: f64 },
    /// Stopped at the limit.
    Stopped { seconds: f64 },
    /// Anything else: a panic, a result that does not check.
    Failed { fault: String },
}

/// Time after which a run counts as a hang.
pub(crate) const LIMIT: Duration = Duration::from_secs(300);

/// Column names of [`Outcome::row`].
pub(crate) const HEADER: &str =
    "model                     status    asked   made       v     ar    p01   agl  err mean   err max  cover  flip  seconds";

/// The program that is there, or the release binary, built first.
pub(crate) fn program(given: Option<&Path>) -> Result<PathBuf> {
    if let Some(binary) = given {
        return binary.canonicalize().with_context(|| format!("there is no program {}", binary.display()));
    }
    must(&mut cargo(&["build", "--release", "-p", "cli"]))?;
    Ok(target_directory()?.join("release/semireg"))
}

impl Remesher {
    /// The release binary, built first; its results go into a folder of this name under the target folder.
    pub(crate) fn build(folder: &str, limit: Duration) -> Result<Self> {
        Self::of(&program(None)?, folder, limit)
    }

    /// A binary that is there; its results go into a folder of this name under the target folder.
    pub(crate) fn of(binary: &Path, folder: &str, limit: Duration) -> Result<Self> {
        let folder = target_directory()?.join(folder);
        fs::create_dir_all(&folder).with_context(|| format!("cannot make {}", folder.display()))?;
        Ok(Self { binary: binary.to_owned(), folder, limit })
    }

    /// Remeshes and checks the result.
    pub(crate) fn run(&self, request: &Request) -> Result<Outcome> {
        let levels = request.levels.to_string();
        let mut options = vec!["--levels", levels.as_str()];
        options.extend((!request.fit).then_some("--no-fit"));
        self.call("remesh", request, &options, &["--levels", &levels], |report| {
            let clean = report["flipped"] == 0 && report["degenerate"] == 0;
            (!clean).then(|| "the report has flipped or degenerate triangles".to_owned())
        })
    }

    /// Remeshes to a size that the options of the request ask for, whatever levels that takes, and checks that the result is a sound mesh.
    pub(crate) fn sized(&self, request: &Request) -> Result<Outcome> {
        self.call("remesh", request, &[], &["--levels=0"], |_| None)
    }

    /// Makes the base mesh alone and checks it and its map to the input: after a way there and back points may be off by
    /// `max_round_trip`, a share of the diagonal.
    pub(crate) fn base(&self, request: &Request, max_round_trip: f64) -> Result<Outcome> {
        self.call("base", request, &[], &["--levels=0", "--connectivity"], |report| match report["round_trip"].as_f64() {
            Some(error) if error <= max_round_trip => None,
            error => Some(format!("the base map brings points back {:.1e} of the diagonal off", error.unwrap_or(f64::NAN))),
        })
    }

    /// Runs `verb`, then `check` on the result, and looks whether anything is wrong with the report.
    fn call(
        &self,
        verb: &str,
        request: &Request,
        options: &[&str],
        check: &[&str],
        fault: impl FnOnce(&Value) -> Option<String>,
    ) -> Result<Outcome> {
        let name = request.input.file_name().unwrap_or_default().to_string_lossy();
        let folder = self.folder.join(&*name);
        fs::create_dir_all(&folder).with_context(|| format!("cannot make {}", folder.display()))?;
        let output = folder.join(format!("{verb}.obj"));
        let mut command = Command::new(&self.binary);
        command.arg(verb).arg(request.input).arg("-o").arg(&output).arg("--json").args(options).args(request.options);
        command.args(request.base_vertices.map(|n| format!("--base-vertices={n}")));
        command.args(request.base.map(|path| OsString::from_iter([OsStr::new("--base="), path.as_os_str()])));
        command.args(request.threads.map(|n| format!("--threads={n}")));
        let ended = within(self.limit, &mut command, &folder)?;
        let seconds = ended.seconds;
        Ok(match ended.code {
            Some(0) => match self.fault_of(&output, &ended.stdout, check, fault)? {
                Ok(report) => Outcome::Remeshed { output, report, seconds },
                Err(fault) => Outcome::Failed { fault },
            },
            Some(1) if ended.last_error.starts_with("error: ") && !ended.last_error.contains("internal error") => {
                Outcome::Refused { reason: ended.last_error, seconds }
            }
            Some(code) => Outcome::Failed { fault: format!("exit {code}: {}", ended.last_error) },
            None => Outcome::Stopped { seconds },
        })
    }

    /// The report, or what is wrong with it or with the file, which must say by itself that it is what the report promises.
    fn fault_of(
        &self,
        output: &Path,
        report: &str,
        check: &[&str],
        fault: impl FnOnce(&Value) -> Option<String>,
    ) -> Result<Result<Value, String>> {
        let Ok(report) = serde_json::from_str::<Value>(report) else {
            return Ok(Err("the report is not JSON".to_owned()));
        };
        let check = within(self.limit, Command::new(&self.binary).arg("check").arg(output).args(check), &self.folder)?;
        Ok(match (check.code, fault(&report)) {
            (Some(0), None) => Ok(report),
            (Some(0), Some(fault)) => Err(fault),
            _ => Err(format!("the result does not check: {}", check.last_error)),
        })
    }
}

impl Outcome {
    /// What must not happen on any input.
    pub(crate) fn fault(&self) -> Option<String> {
        match self {
            Self::Failed { fault } => Some(fault.clone()),
            Self::Stopped { seconds } => Some(format!("stopped after {seconds:.0} s")),
            _ => None,
        }
    }

    /// The same, where the time that a run takes does not count.
    pub(crate) fn fault_but_time(&self) -> Option<String> {
        self.fault().filter(|_| !matches!(self, Self::Stopped { .. }))
    }

    /// A row of the table.
    pub(crate) fn row(&self, name: &str) -> String {
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
