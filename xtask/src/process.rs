//! Starting other programs.

use anyhow::{Context, Result, bail};
use serde_json::Value;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// `cargo` in the folder of the workspace.
pub(crate) fn cargo(args: &[&str]) -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.args(args).current_dir(crate::root());
    command
}

/// Runs a program to its end, its output shown as it comes.
pub(crate) fn must(command: &mut Command) -> Result<()> {
    let status = command.status().with_context(|| format!("cannot start {command:?}"))?;
    if !status.success() {
        bail!("{command:?} ended with {status}");
    }
    Ok(())
}

/// What a program prints on standard output.
pub(crate) fn output(command: &mut Command) -> Result<String> {
    let output = command.stderr(Stdio::inherit()).output().with_context(|| format!("cannot start {command:?}"))?;
    if !output.status.success() {
        bail!("{command:?} ended with {}", output.status);
    }
    Ok(String::from_utf8(output.stdout)?)
}

/// The folder that cargo builds into.
pub(crate) fn target_directory() -> Result<PathBuf> {
    let text = output(&mut cargo(&["metadata", "--format-version", "1", "--locked", "--no-deps"]))?;
    let metadata: Value = serde_json::from_str(&text)?;
    metadata["target_directory"].as_str().map(PathBuf::from).context("cargo metadata names no target directory")
}

/// How a program ended that was given limited time.
pub(crate) struct Ended {
    /// Its exit code; `None` when it was stopped at the limit or by a signal.
    pub(crate) code: Option<i32>,
    /// Its standard output.
    pub(crate) stdout: String,
    /// The last line of its standard error.
    pub(crate) last_error: String,
    /// Wall time.
    pub(crate) seconds: f64,
}

/// Runs a program and stops it after `limit`. Its output goes through files in `folder`, so that it can't block on a full pipe.
pub(crate) fn within(limit: Duration, command: &mut Command, folder: &Path) -> Result<Ended> {
    let paths = ["stdout", "stderr"].map(|name| folder.join(name));
    let [out, err] = [File::create(&paths[0])?, File::create(&paths[1])?];
    let start = Instant::now();
    let mut child = command.stdout(out).stderr(err).spawn().with_context(|| format!("cannot start {command:?}"))?;
    let status = loop {
        if let Some(status) = child.try_wait()? {
            break Some(status);
        }
        if start.elapsed() > limit {
            child.kill()?;
            child.wait()?;
            break None;
        }
        std::thread::sleep(Duration::from_millis(10));
    };
    let seconds = start.elapsed().as_secs_f64();
    let [stdout, stderr] = paths.map(|p| fs::read(p).map(|b| String::from_utf8_lossy(&b).into_owned()).unwrap_or_default());
    let last_error = stderr.trim_end().lines().last().unwrap_or("no message").to_owned();
    Ok(Ended { code: status.and_then(|s| s.code()), stdout, last_error, seconds })
}
