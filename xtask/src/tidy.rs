//! What the compiler does not check.

mod circles;
mod dependencies;
mod licences;
mod metadata;
mod modules;
mod names;
mod sources;

use crate::root;
use anyhow::{Result, bail};
use modules::Crate;

/// Prints everything that is untidy; fails when there is anything.
pub(crate) fn run() -> Result<()> {
    let metadata = metadata::metadata()?;
    let mut problems = dependencies::check(&metadata);
    problems.extend(licences::check(&metadata));
    problems.extend(sources::check()?);
    for folder in metadata::folders(&metadata) {
        match Crate::read(&root(), &folder) {
            Ok(krate) => problems.extend(circles::check(&krate)),
            Err(e) => problems.push(format!("{folder}: {e:#}")),
        }
    }
    for problem in &problems {
        eprintln!("untidy: {problem}");
    }
    match problems.len() {
        0 => Ok(()),
        n => bail!("{n} things are untidy"),
    }
}
