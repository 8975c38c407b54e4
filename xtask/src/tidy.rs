//! What the compiler does not check.

mod circles;
mod constants;
mod dependencies;
mod licences;
mod metadata;
mod modules;
mod names;
mod sources;

use crate::markdown::{holds, put};
use crate::root;
use anyhow::{Result, bail};
use modules::Crate;
use serde_json::Value;

/// The page of constants, from the workspace's folder.
const CONSTANTS: &str = "docs/constants.md";

/// Prints everything that is untidy; fails when there is anything.
pub(crate) fn run() -> Result<()> {
    let metadata = metadata::metadata()?;
    let (crates, mut problems) = crates(&metadata);
    problems.extend(dependencies::check(&metadata));
    problems.extend(licences::check(&metadata));
    problems.extend(sources::check()?);
    problems.extend(crates.iter().flat_map(circles::check));
    let (page, undocumented) = constants::page(&crates);
    problems.extend(undocumented);
    if !holds(&root().join(CONSTANTS), &page)? {
        problems.push(format!("{CONSTANTS} is not what the sources say: run `cargo xtask constants`"));
    }
    for problem in &problems {
        eprintln!("untidy: {problem}");
    }
    match problems.len() {
        0 => Ok(()),
        n => bail!("{n} things are untidy"),
    }
}

/// Writes the page of constants.
pub(crate) fn write_constants() -> Result<()> {
    let (crates, problems) = crates(&metadata::metadata()?);
    if let Some(problem) = problems.first() {
        bail!("the page would lack a crate: {problem}");
    }
    put(&root().join(CONSTANTS), &constants::page(&crates).0)
}

/// The crates of the workspace, and what is wrong with those that cannot be read.
fn crates(metadata: &Value) -> (Vec<Crate>, Vec<String>) {
    let mut crates = Vec::new();
    let mut problems = Vec::new();
    for folder in metadata::folders(metadata) {
        match Crate::read(&root(), &folder) {
            Ok(krate) => crates.push(krate),
            Err(e) => problems.push(format!("{folder}: {e:#}")),
        }
    }
    (crates, problems)
}
