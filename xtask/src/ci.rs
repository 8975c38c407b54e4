//! Everything that must be green before a change lands.

use crate::process::{cargo, must};
use anyhow::{Context, Result};
use std::time::Instant;

/// Runs all checks, the quick ones first, and stops at the first that fails.
pub(crate) fn run() -> Result<()> {
    let lints = ["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"];
    step("format", || must(&mut cargo(&["fmt", "--all", "--check"])))?;
    step("tidy", crate::tidy::run)?;
    step("lints", || must(&mut cargo(&lints)))?;
    step("docs", || must(cargo(&["doc", "--workspace", "--no-deps"]).env("RUSTDOCFLAGS", "-D warnings")))?;
    step("tests", || must(&mut cargo(&["test", "--workspace"])))?;
    step("fixtures", || must(&mut cargo(&["run", "-p", "fixtures", "--bin", "make-fixtures", "--", "--check"])))?;
    step("regress", || crate::regress::run(&crate::regress::Args::default()))
}

fn step(name: &'static str, check: impl FnOnce() -> Result<()>) -> Result<()> {
    println!("== {name}");
    let start = Instant::now();
    check().with_context(|| format!("{name} failed"))?;
    println!("== {name}: green in {:.0} s", start.elapsed().as_secs_f64());
    Ok(())
}
