//! Our distances against libigl's, from Python, in an environment of our own under the target folder.

use crate::process::output;
use crate::python::environment;
use crate::root;
use anyhow::{Context, Result};
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A result with the report that we gave of it.
pub(super) struct Pair {
    pub(super) name: String,
    pub(super) input: PathBuf,
    pub(super) output: PathBuf,
    pub(super) report: Value,
}

/// Exact versions, so that the oracle does not change under us.
const PACKAGES: [&str; 2] = ["numpy==2.4.6", "libigl==2.6.3"];

/// How far two measurements by different random points may differ, as a share. Measured on the fixtures: means by 1 %, root mean
/// squares by 2 %, 7 % where few samples fall on the one bad place (brick_small); the greatest, where it is the tip of a spike between vertices, by 31 %.
const NOISE: [(&str, f64); 3] = [("err_mean", 0.03), ("err_rms", 0.10), ("err_max", 0.50)];
/// A mean of random samples may also be off by so many of its standard errors: where a few places are far off and all others near, that is more.
const STANDARD_ERRORS: f64 = 4.0;
/// Samples of libigl's mean, as in oracle.py.
const SAMPLES: f64 = 100_000.0;
/// Below this share of the diagonal differences are rounding.
const ROUNDING: f64 = 1e-9;

/// Every figure on which we and libigl don't agree. Without Python it says so and finds nothing.
pub(super) fn check(pairs: &[Pair], target: &Path) -> Result<Vec<String>> {
    let python = match environment(&target.join("oracle"), &PACKAGES) {
        Ok(python) => python,
        Err(e) => {
            println!("\n*** THE ORACLE WAS NOT RUN: our distances are not checked against libigl ({e:#})\n");
            return Ok(Vec::new());
        }
    };
    let jobs: Vec<Value> = pairs.iter().map(|p| json!({ "name": p.name, "input": p.input, "output": p.output })).collect();
    let list = target.join("oracle/jobs.json");
    fs::write(&list, serde_json::to_string(&jobs)?)?;
    let text = output(Command::new(python).arg(root().join("xtask/oracle.py")).arg(&list)).context("the oracle failed")?;
    let answers: Value = serde_json::from_str(&text).context("the oracle's answer is not JSON")?;
    let problems: Vec<String> = pairs.iter().flat_map(|pair| disagreements(pair, &answers[&pair.name])).collect();
    println!("oracle: libigl measured {} results, {} figures disagree", pairs.len(), problems.len());
    Ok(problems)
}

fn disagreements(pair: &Pair, answer: &Value) -> Vec<String> {
    let mut problems = Vec::new();
    for (name, share) in NOISE {
        let [Some(ours), Some(theirs)] = [&pair.report[name], &answer[name]].map(Value::as_f64) else {
            problems.push(format!("{}: {name} was not measured by both", pair.name));
            continue;
        };
        let of_few_samples = match (name, pair.report["err_rms"].as_f64()) {
            ("err_mean", Some(rms)) => STANDARD_ERRORS * rms / SAMPLES.sqrt(),
            _ => 0.0,
        };
        if (ours - theirs).abs() > of_few_samples.max(share * ours.max(theirs)) + ROUNDING {
            problems.push(format!("{}: {name} is {ours:.4e} by us, {theirs:.4e} by libigl", pair.name));
        }
    }
    problems
}
