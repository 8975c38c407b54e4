//! The tables of `docs/results.md`: a folder of models, with and without the fit.
//!
//! All figures are the program's own, from `--json` (crate `certify`); regress compares that crate's distances with libigl's.

use crate::markdown::{FIGURES, figures, put, reason, table};
use crate::models::{Spec, files};
use crate::remesher::{LIMIT, Outcome, Remesher, Request};
use crate::root;
use anyhow::{Result, bail};
use serde_json::Value;
use std::path::{Path, PathBuf};

#[derive(clap::Args)]
pub(crate) struct Args {
    /// The folder of models
    #[arg(long)]
    models: PathBuf,
    /// Base vertices and levels by file name, {"NAME": {"base": N, "level": L}}; models not in it get the defaults
    /// [default: xtask/spec.json, the paper's base sizes]
    #[arg(long)]
    spec: Option<PathBuf>,
    /// Run only the models whose file name contains this, and print the tables instead of writing them
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
}

/// Rows of the tables.
#[derive(Default)]
struct Tables {
    fitted: Vec<Vec<String>>,
    unfitted: Vec<Vec<String>>,
    refused: Vec<Vec<String>>,
    faults: Vec<String>,
}

/// Runs the models one after the other, each on all processors, and writes their figures. Fails on a panic, a hang or a result that
/// does not check, after writing.
pub(crate) fn run(args: &Args) -> Result<()> {
    let spec = Spec::load(args.spec.as_deref())?;
    let mut names = files(&args.models)?;
    names.retain(|name| args.only.as_ref().is_none_or(|part| name.contains(part.as_str())));
    if names.is_empty() {
        bail!("{} holds no such model", args.models.display());
    }
    let remesher = Remesher::build("results", LIMIT)?;
    let mut tables = Tables::default();
    for name in &names {
        tables.add(&remesher, &args.models.join(name), name, &spec)?;
    }
    match args.only {
        Some(_) => println!("\n{}", tables.text()),
        None => put(&root().join("docs/results.md"), &tables.text())?,
    }
    match tables.faults.len() {
        0 => Ok(()),
        n => bail!("{n} runs ended as none should: {}", tables.faults.join("; ")),
    }
}

impl Tables {
    /// Runs a model. Without the fit only where it passes with it: a fit that spoils the result is left out by the program itself.
    fn add(&mut self, remesher: &Remesher, input: &Path, name: &str, spec: &Spec) -> Result<()> {
        let (base_vertices, levels) = spec.of(name);
        let request = Request { base_vertices, levels, ..Request::of(input) };
        let with = remesher.run(&request)?;
        println!("{}", with.row(name));
        self.faults.extend(with.fault().map(|fault| format!("{name}: {fault}")));
        let passed = matches!(with, Outcome::Remeshed { .. });
        match row(input, name, levels, &with) {
            Ok(row) => self.fitted.push(row),
            Err(row) => self.refused.push(row),
        }
        if passed {
            let without = remesher.run(&Request { fit: false, ..request })?;
            self.faults.extend(without.fault().map(|fault| format!("{name} without fit: {fault}")));
            match row(input, name, levels, &without) {
                Ok(row) => self.unfitted.push(row),
                Err(row) => self.refused.push([vec![format!("{name}, without fit")], row[1..].to_vec()].concat()),
            }
        }
        Ok(())
    }

    fn text(&self) -> String {
        let columns = [&["model", "base asked", "made", "levels", "vertices"], &FIGURES[..], &["seconds"]].concat();
        let sections = [
            ("## With the fit, the default", table(&columns, &self.fitted)),
            ("## Without it (`--no-fit`)", table(&columns, &self.unfitted)),
            ("## Refused", table(&["model", "reason", "seconds"], &self.refused)),
        ];
        let mut text = format!("{PREAMBLE}\n");
        for (title, table) in sections.iter().filter(|(_, table)| !table.is_empty()) {
            text += &format!("\n{title}\n\n{table}");
        }
        text
    }
}

/// Above the tables.
const PREAMBLE: &str = "All figures are the program's own (`semireg remesh --json`, crate `certify`); `cargo xtask regress` checks its \
distances against libigl's.\nErrors are shares of the diagonal of the input; seconds are of the whole process, one model at a time.";

/// The row of a result, or that of a model without one.
fn row(input: &Path, name: &str, levels: u32, outcome: &Outcome) -> Result<Vec<String>, Vec<String>> {
    let without = |reason: String, seconds: &str| Err(vec![name.to_owned(), reason, seconds.to_owned()]);
    match outcome {
        Outcome::Remeshed { report, seconds, .. } => {
            let whole = |pointer: &str| report.pointer(pointer).and_then(Value::as_u64).map_or("-".to_owned(), |n| n.to_string());
            let counts = [name.to_owned(), whole("/base_vertices/asked"), whole("/base_vertices/made"), levels.to_string()];
            Ok([&counts[..], &[whole("/vertices")], &figures(report), &[format!("{seconds:.1}")]].concat())
        }
        Outcome::Refused { reason: message, seconds } => without(reason(message, &[input]), &format!("{seconds:.1}")),
        Outcome::Stopped { seconds } => without("STOPPED: it took too long".to_owned(), &format!("{seconds:.0}")),
        Outcome::Failed { fault } => without(format!("FAILED: {}", reason(fault, &[input])), "-"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_result_has_a_cell_for_each_column() {
        let report = json!({ "base_vertices": { "asked": 208, "made": 210 }, "vertices": 13186, "ar_mean": 0.902 });
        let outcome = Outcome::Remeshed { output: PathBuf::new(), report, seconds: 1.23 };
        let tables = Tables { fitted: vec![row(Path::new("models/a.obj"), "a.obj", 3, &outcome).unwrap()], ..Tables::default() };
        assert!(tables.text().contains("\n| a.obj | 208 | 210 | 3 | 13186 | 0.902 | - |"), "{}", tables.text());
        let lines: Vec<usize> = tables.text().lines().filter(|l| l.starts_with("| ")).map(|l| l.matches('|').count()).collect();
        assert_eq!(lines, [15, 15]);
        assert!(!tables.text().contains("Refused"));
    }

    #[test]
    fn a_refusal_is_told_without_the_path() {
        for (message, told) in [
            ("error: models/a.obj: 3 | 4 triangles are folded", "3 | 4 triangles are folded"),
            ("error: models/a.obj:6: \"x\" is not a number", "a.obj:6: \"x\" is not a number"),
        ] {
            let outcome = Outcome::Refused { reason: message.to_owned(), seconds: 2.0 };
            assert_eq!(row(Path::new("models/a.obj"), "a.obj", 3, &outcome).unwrap_err(), ["a.obj", told, "2.0"]);
        }
    }
}
