//! What the compiler does not check.

mod dependencies;
mod licences;
mod sources;

use crate::process::{cargo, output};
use anyhow::{Context, Result, bail};
use serde_json::Value;

/// Prints everything that is untidy; fails when there is anything.
pub(crate) fn run() -> Result<()> {
    let text = output(&mut cargo(&["metadata", "--format-version", "1", "--locked"]))?;
    let metadata: Value = serde_json::from_str(&text).context("cargo metadata")?;
    let mut problems = dependencies::check(&metadata);
    problems.extend(licences::check(&metadata));
    problems.extend(sources::check()?);
    for problem in &problems {
        eprintln!("untidy: {problem}");
    }
    match problems.len() {
        0 => Ok(()),
        n => bail!("{n} things are untidy"),
    }
}

/// The packages of `cargo metadata`: those of the workspace only, or all.
fn packages(metadata: &Value, workspace_only: bool) -> impl Iterator<Item = &Value> {
    let members: Vec<&Value> = metadata["workspace_members"].as_array().into_iter().flatten().collect();
    let all = metadata["packages"].as_array().into_iter().flatten();
    all.filter(move |p| !workspace_only || members.contains(&&p["id"]))
}

/// A text field of a package.
fn text<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap_or_default()
}
