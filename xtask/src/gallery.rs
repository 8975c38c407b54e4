//! The pictures of `docs/gallery.md`: fixtures beside their results at the program's defaults.

use crate::markdown::{error, put, reason, table};
use crate::models::{LEVELS, files};
use crate::process::{cargo, must, target_directory};
use crate::remesher::{Outcome, Remesher, Request};
use crate::root;
use crate::workers::on_all_processors;
use anyhow::Result;
use std::fs;
use std::path::PathBuf;
use std::time::Duration;

#[derive(clap::Args)]
pub(crate) struct Args {
    /// Run this program instead of building it
    #[arg(long, value_name = "FILE")]
    binary: Option<PathBuf>,
}

/// Time after which a run is given up: long, for pictures are to be had on a busy machine, too.
const PATIENCE: Duration = Duration::from_secs(3600);

/// Not drawn: the same shape as another one in other triangles.
const LIKE_OTHERS: &[&str] =
    &["part_fine.obj", "scan_small.obj", "blob_small.obj", "tap_small.obj", "brick_small.obj", "cad.stl", "shell_small.obj"];
/// Where the pictures are, from the workspace's folder.
const PICTURES: &str = "docs/images/gallery";

/// Remeshes the fixtures, draws them, and writes the table.
pub(crate) fn run(args: &Args) -> Result<()> {
    let remesher = match &args.binary {
        Some(binary) => Remesher::of(binary, "gallery", PATIENCE)?,
        None => Remesher::build("gallery", PATIENCE)?,
    };
    let mut names = files(&root().join("fixtures/data"))?;
    names.retain(|name| !LIKE_OTHERS.contains(&name.as_str()));
    let outcomes = remeshed(&remesher, &names)?;
    let pictures = root().join(PICTURES);
    if pictures.exists() {
        fs::remove_dir_all(&pictures)?;
    }
    let results = target_directory()?.join("gallery");
    let mut draw = cargo(&["run", "--quiet", "--release", "-p", "fixtures", "--example", "gallery", "--"]);
    must(draw.arg(results).arg(LEVELS.to_string()).arg(&pictures))?;
    let rows: Vec<Vec<String>> = names.iter().zip(&outcomes).map(|(name, outcome)| row(name, outcome)).collect();
    put(&root().join("docs/gallery.md"), &table(&["fixture", "input", "result", "what came out"], &rows))
}

/// What came of each, as many at a time as there are processors.
fn remeshed(remesher: &Remesher, names: &[String]) -> Result<Vec<Outcome>> {
    on_all_processors(names, |name| {
        let input = root().join("fixtures/data").join(name);
        let outcome = remesher.run(&Request { threads: Some(1), ..Request::of(&input) })?;
        println!("{}", outcome.row(name));
        Ok(outcome)
    })
}

fn row(name: &str, outcome: &Outcome) -> Vec<String> {
    let picture = |of: &str| format!("![{name}, {of}](images/gallery/{name}.{of}.png)");
    let without = |why: String| vec![name.to_owned(), "-".to_owned(), "-".to_owned(), why];
    match outcome {
        Outcome::Remeshed { report, .. } => {
            let real = |key: &str| report[key].as_f64().unwrap_or(f64::NAN);
            let verdict = report["verdict"].as_str().unwrap_or("-");
            let base = &report["base_vertices"]["made"];
            let mean = error(real("err_mean"));
            vec![
                name.to_owned(),
                picture("in"),
                picture("out"),
                format!("{base} base vertices, quality {:.3}, mean error {mean}; {verdict}", real("ar_mean")),
            ]
        }
        Outcome::Refused { reason: why, .. } => without(format!("refused: {}", reason(why, &[]))),
        Outcome::Stopped { seconds } => without(format!("stopped after {seconds:.0} s")),
        Outcome::Failed { fault } => without(format!("FAILED: {fault}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_result_has_two_pictures_and_a_refusal_none() {
        let report = json!({ "verdict": "certified", "base_vertices": { "made": 12 }, "ar_mean": 0.9, "err_mean": 1e-5 });
        let done = row("a.obj", &Outcome::Remeshed { output: PathBuf::new(), report, seconds: 1.0 });
        assert_eq!(done[1], "![a.obj, in](images/gallery/a.obj.in.png)");
        assert_eq!(done[3], "12 base vertices, quality 0.900, mean error 1.00e-5; certified");
        let refused = row("a.obj", &Outcome::Refused { reason: "error: folded".to_owned(), seconds: 1.0 });
        assert_eq!(refused[1..], ["-", "-", "refused: folded"]);
    }
}
