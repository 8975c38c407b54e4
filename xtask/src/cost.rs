//! What a program takes: processor time and memory.
//!
//! The system tells both of all ended children together. So each program is started by a small process of its own, this one
//! again as `xtask cost`, which waits for it and writes a note.

use crate::process::{Ended, within};
use anyhow::{Context, Result};
use serde::{Deserialize, Serialize};
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

#[derive(clap::Args)]
pub(crate) struct Args {
    /// Where the note goes
    note: PathBuf,
    /// Processor seconds after which the program is stopped
    limit: u64,
    /// The program and its arguments
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, required = true)]
    command: Vec<OsString>,
}

/// What a run took.
#[derive(Serialize, Deserialize, Clone, Copy, Debug)]
pub(crate) struct Cost {
    /// Of all threads, in the program and in the system for it.
    pub(crate) processor_seconds: f64,
    /// By the clock.
    pub(crate) seconds: f64,
    /// Greatest memory that was in use at a time.
    pub(crate) megabytes: f64,
}

#[derive(Serialize, Deserialize)]
struct Note {
    cost: Cost,
    /// `None`: ended by a signal.
    code: Option<i32>,
}

/// The process in the middle: starts the program, waits, writes the note.
pub(crate) fn run(args: &Args) -> Result<()> {
    system::limit_processor_seconds(args.limit)?;
    let start = Instant::now();
    let status = Command::new(&args.command[0]).args(&args.command[1..]).status();
    let status = status.with_context(|| format!("cannot start {}", args.command[0].display()))?;
    let seconds = start.elapsed().as_secs_f64();
    let (processor_seconds, megabytes) = system::of_children()?;
    let note = Note { cost: Cost { processor_seconds, seconds, megabytes }, code: status.code() };
    fs::write(&args.note, serde_json::to_string(&note)?).with_context(|| format!("cannot write {}", args.note.display()))
}

/// Runs a program to its end or to the limit of processor seconds. Its output goes through files in `folder`. The exit code is
/// `None` when it was stopped at the limit or by another signal.
pub(crate) fn measured(limit: u64, program: &Path, args: &[OsString], folder: &Path) -> Result<(Ended, Cost)> {
    let note = folder.join("cost.json");
    let mut command = Command::new(this_program()?);
    command.arg("cost").arg(&note).arg(limit.to_string()).arg(program).args(args);
    let ended = within(Duration::MAX, &mut command, folder)?;
    if ended.code != Some(0) {
        anyhow::bail!("{} was not measured: {}", program.display(), ended.last_error);
    }
    let text = fs::read_to_string(&note).with_context(|| format!("cannot read {}", note.display()))?;
    let Note { cost, code } = serde_json::from_str(&text)?;
    Ok((Ended { code, ..ended }, cost))
}

/// Linux finds it even after it was built anew, which may happen while a bench runs for an hour.
fn this_program() -> Result<PathBuf> {
    let running = Path::new("/proc/self/exe");
    Ok(if running.exists() { running.to_owned() } else { std::env::current_exe()? })
}

#[cfg(unix)]
mod system {
    //! Asks a Unix system.

    use anyhow::Result;
    use nix::sys::resource::{Resource, UsageWho, getrusage, setrlimit};
    use nix::sys::time::TimeValLike as _;

    /// For this process and those that it starts, each by itself.
    pub(super) fn limit_processor_seconds(limit: u64) -> Result<()> {
        Ok(setrlimit(Resource::RLIMIT_CPU, limit, limit)?)
    }

    /// Processor seconds and megabytes of the children that have ended.
    pub(super) fn of_children() -> Result<(f64, f64)> {
        let usage = getrusage(UsageWho::RUSAGE_CHILDREN)?;
        let microseconds = (usage.user_time() + usage.system_time()).num_microseconds();
        // Kilobytes, but for macOS, which counts bytes.
        let unit = if cfg!(target_os = "macos") { 1.0 } else { 1024.0 };
        Ok((microseconds as f64 * 1e-6, usage.max_rss() as f64 * unit * 1e-6))
    }
}

#[cfg(not(unix))]
mod system {
    //! No way is known here.

    use anyhow::{Result, bail};

    pub(super) fn limit_processor_seconds(_: u64) -> Result<()> {
        bail!("processor time is measured on Unix only")
    }

    pub(super) fn of_children() -> Result<(f64, f64)> {
        bail!("processor time is measured on Unix only")
    }
}
