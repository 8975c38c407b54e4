//! Python environments of our own, under the target folder.

use crate::process::must;
use anyhow::Result;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The Python of an environment with these packages (with exact versions), made when it is not there.
pub(crate) fn environment(folder: &Path, packages: &[&str]) -> Result<PathBuf> {
    let python = folder.join("bin/python");
    // Written last: an environment that was left half made is made again.
    let complete = folder.join("complete");
    if fs::read_to_string(&complete).unwrap_or_default() != packages.join(" ") {
        println!("making a Python environment with {}", packages.join(" "));
        must(Command::new("python3").args(["-m", "venv", "--clear"]).arg(folder))?;
        must(Command::new(&python).args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]).args(packages))?;
        fs::write(complete, packages.join(" "))?;
    }
    Ok(python)
}
