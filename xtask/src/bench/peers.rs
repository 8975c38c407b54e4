//! Other people's remeshers on the same inputs, to the same number of triangles.

use super::program::{Job, Program, Run, quality, ratio, seconds};
use crate::cost::{Cost, measured};
use crate::markdown::{error, table};
use crate::process::target_directory;
use crate::python::environment;
use crate::root;
use anyhow::Result;
use serde_json::Value;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

/// Exact versions: the rows are theirs.
const PACKAGES: [&str; 6] =
    ["numpy==2.4.6", "trimesh==5.2.0", "pymeshlab==2025.7.post1", "gpytoolbox==0.3.8", "pyvista==0.49.1", "pyacvd==0.4.0"];

/// Names in the script, and what they are.
const TOOLS: [(&str, &str); 3] =
    [("isotropic", "pymeshlab, isotropic"), ("botsch", "gpytoolbox, remesh_botsch"), ("acvd", "pyacvd")];

const COLUMNS: [&str; 9] =
    ["model", "by", "triangles", "AR mean", "error mean", "processor s", "MB", "time to ours", "error to ours"];

/// The environment with the peers, or why there is none.
pub(super) fn python() -> Result<PathBuf> {
    environment(&target_directory()?.join("peers"), &PACKAGES)
}

/// A table with our row and one of each peer for every run with a result.
pub(super) fn table_of(python: &Path, program: &Program, runs: &[(Job, Run)]) -> Result<String> {
    let mut rows = Vec::new();
    for (job, run) in runs {
        let Run::Done { report, cost, .. } = run else { continue };
        rows.push(ours(job, report, *cost));
        for (tool, what) in TOOLS {
            let row = peer(python, program, tool, job, report, *cost)?;
            let row = row.unwrap_or_else(|| vec!["-".to_owned(); COLUMNS.len() - 2]);
            println!("{} by {what}: {}", job.name, row.join("  "));
            rows.push([vec![job.name.clone(), what.to_owned()], row].concat());
        }
    }
    Ok(table(&COLUMNS, &rows))
}

fn ours(job: &Job, report: &Value, cost: Cost) -> Vec<String> {
    let figures = figures(report, cost.processor_seconds, cost.megabytes);
    [vec![job.name.clone(), "semireg".to_owned()], figures, vec!["1".to_owned(), "1".to_owned()]].concat()
}

/// Triangles, AR mean, mean error, processor seconds and megabytes.
fn figures(report: &Value, processor_seconds: f64, megabytes: f64) -> Vec<String> {
    let real = |key: &str, text: fn(f64) -> String| report[key].as_f64().map_or("-".to_owned(), text);
    vec![
        real("faces", |n| n.to_string()),
        real("ar_mean", quality),
        real("err_mean", error),
        seconds(processor_seconds),
        format!("{megabytes:.0}"),
    ]
}

/// The cells of a peer; `None` when it fails or takes longer than it may.
fn peer(python: &Path, program: &Program, tool: &str, job: &Job, ours: &Value, cost: Cost) -> Result<Option<Vec<String>>> {
    let output = program.folder.join(format!("{}_{tool}.ply", job.name));
    if output.exists() {
        fs::remove_file(&output)?;
    }
    let script = root().join("xtask/peers.py");
    let mut args: Vec<OsString> = vec!["-W".into(), "ignore".into(), script.into(), tool.into(), job.input.clone().into()];
    args.extend([ours["vertices"].to_string(), ours["faces"].to_string()].map(OsString::from));
    args.push(output.clone().into());
    let (ended, all) = measured(program.limit, python, &args, &program.folder)?;
    let last = ended.stdout.lines().last().unwrap_or_default();
    let answer: Value = serde_json::from_str(last).unwrap_or_default();
    let (Some(0), Some(time)) = (ended.code, answer["processor_seconds"].as_f64()) else {
        println!("{tool}: {}", ended.last_error);
        return Ok(None);
    };
    let Ok(theirs) = program.ask("compare", &[&job.input, &output]) else { return Ok(None) };
    let errors = [&theirs, ours].map(|report| report["err_mean"].as_f64().unwrap_or(0.0));
    let ratios = [ratio(time, cost.processor_seconds), ratio(errors[0], errors[1])];
    Ok(Some([figures(&theirs, time, all.megabytes), ratios.to_vec()].concat()))
}
