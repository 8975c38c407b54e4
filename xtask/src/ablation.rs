//! The paper's own arguments as numbers, in `docs/ablation.md`: what each part of the method adds, and whose base mesh is best.
//!
//! The parts are measured by an example of the facade, as no crate of ours is seen from here; the bases by the program and by Python.

use crate::markdown::{FIGURES, figures, put, reason, table};
use crate::models::Spec;
use crate::process::{cargo, must, output, target_directory};
use crate::python::environment;
use crate::remesher::{LIMIT, Outcome, Remesher, Request};
use crate::root;
use anyhow::{Context, Result, bail};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

#[derive(clap::Args)]
pub(crate) struct Args {
    /// A folder of models: fandisk, kitten, rabbit and rocker-arm are taken from it too, where they are there
    #[arg(long)]
    models: Option<PathBuf>,
    /// Run only the models whose file name contains this, and print the tables without writing them
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
}

/// Fixtures, with base vertices and levels: a sharp part, components through each other, smooth bodies without and with handles.
const FIXTURES: [(&str, usize, u32); 4] =
    [("part.obj", 300, 3), ("tap.obj", 400, 2), ("blob_small.obj", 250, 3), ("organic.obj", 300, 3)];
/// Models of the paper and the likes, remeshed by the spec.
const MODELS: [&str; 4] = ["fandisk.obj", "kitten.obj", "rabbit.obj", "rocker-arm.off"];

/// Exact versions: the rows are theirs.
const PACKAGES: [&str; 5] = ["numpy==2.4.6", "trimesh==5.2.0", "pyvista==0.49.1", "fast-simplification==0.2.0", "pyacvd==0.4.0"];

/// What is remeshed.
struct Case {
    input: PathBuf,
    name: String,
    base_vertices: usize,
    levels: u32,
}

/// A row of a table.
struct Row {
    group: String,
    model: String,
    what: String,
    cells: Vec<String>,
}

/// Tables in their order: what they show and where the paper argues it.
const GROUPS: [(&str, &str); 5] = [
    ("placement", "Placement (section 4.2, Fig. 5), before any relaxation"),
    ("quadric relaxation", "The paper's relaxation by itself (section 4.3, Figs. 7 and 8), 40 iterations"),
    ("relaxation", "Parts of our relaxation, before snapping and fit"),
    ("fit", "The fit"),
    ("base", "Base meshes (Fig. 10, Table 3), remeshed without fit"),
];

/// Measures all cases and writes the tables.
pub(crate) fn run(args: &Args) -> Result<()> {
    let mut cases = cases(args.models.as_deref())?;
    cases.retain(|case| args.only.as_ref().is_none_or(|part| case.name.contains(part.as_str())));
    if cases.is_empty() {
        bail!("there is no such model");
    }
    let remesher = Remesher::build("ablation", LIMIT)?;
    must(&mut cargo(&["build", "--release", "-p", "semireg", "--example", "ablation"]))?;
    let target = target_directory()?;
    let python = environment(&target.join("bases"), &PACKAGES);
    if let Err(e) = &python {
        println!("\n*** NO BASES BY OTHERS ARE MADE: there is no Python environment ({e:#})\n");
    }
    let mut rows = Vec::new();
    for case in &cases {
        println!("{}", case.name);
        rows.extend(parts(&target.join("release/examples/ablation"), case)?);
        rows.extend(bases(&remesher, python.as_deref().ok(), &target.join("ablation").join(&case.name), case)?);
    }
    let text = text(&rows);
    println!("\n{text}");
    if args.only.is_none() {
        put(&root().join("docs/ablation.md"), &text)?;
    }
    Ok(())
}

fn cases(models: Option<&Path>) -> Result<Vec<Case>> {
    let data = root().join("fixtures/data");
    let case = |folder: &Path, name: &str, base_vertices, levels| Case {
        input: folder.join(name),
        name: name.to_owned(),
        base_vertices,
        levels,
    };
    let mut cases: Vec<Case> = FIXTURES.iter().map(|&(name, n, levels)| case(&data, name, n, levels)).collect();
    if let Some(folder) = models {
        let spec = Spec::load(None)?;
        for name in MODELS.into_iter().filter(|name| folder.join(name).is_file()) {
            let (base_vertices, levels) = spec.of(name);
            cases.push(case(folder, name, base_vertices.with_context(|| format!("{name} is not in xtask/spec.json"))?, levels));
        }
    }
    Ok(cases)
}

/// The rows that the example measures.
fn parts(example: &Path, case: &Case) -> Result<Vec<Row>> {
    let [n, levels] = [case.base_vertices.to_string(), case.levels.to_string()];
    let lines = output(Command::new(example).arg(&case.input).args([n, levels]))?;
    lines.lines().map(|line| part(line, &case.name)).collect()
}

fn part(line: &str, model: &str) -> Result<Row> {
    let value: Value = serde_json::from_str(line).with_context(|| format!("the example printed {line}"))?;
    let text = |key: &str| value[key].as_str().map(str::to_owned).with_context(|| format!("no {key} in {line}"));
    Ok(Row { group: text("group")?, model: model.to_owned(), what: text("row")?, cells: figures(&value) })
}

/// Our own base mesh, that given back to `--base`, and those of others of the same size.
fn bases(remesher: &Remesher, python: Option<&Path>, folder: &Path, case: &Case) -> Result<Vec<Row>> {
    let row = |what: &str, cells| Row { group: "base".to_owned(), model: case.name.clone(), what: what.to_owned(), cells };
    let request =
        Request { base_vertices: Some(case.base_vertices), levels: case.levels, fit: false, ..Request::of(&case.input) };
    let ours = remesher.run(&request)?;
    let mut rows = vec![row("ours", cells(&ours, &[&case.input]))];
    let Outcome::Remeshed { report, .. } = &ours else { return Ok(rows) };
    let sizes = [&report["levels"][0][0], &report["levels"][0][1]].map(Value::to_string);
    let by_base = |path: &Path| -> Result<Vec<String>> {
        let outcome = remesher.run(&Request { base: Some(path), base_vertices: None, ..request })?;
        Ok(cells(&outcome, &[&case.input, path]))
    };
    let given_back = match remesher.base(&request, f64::INFINITY)? {
        Outcome::Remeshed { output, .. } => by_base(&output)?,
        none => cells(&none, &[&case.input]),
    };
    rows.push(row("ours by `--base`", given_back));
    if let Some(python) = python {
        must(
            Command::new(python)
                .args(["-W", "ignore"])
                .arg(root().join("xtask/bases.py"))
                .arg(&case.input)
                .args(sizes)
                .arg(folder),
        )?;
    }
    for (what, file) in [("QEM (fast-simplification)", "qem.ply"), ("ACVD (pyacvd)", "acvd.ply")] {
        let path = folder.join(file);
        rows.push(match python {
            None => row(what, without_figures("not run: no Python environment")),
            Some(_) if !path.is_file() => row(what, without_figures("it made no mesh")),
            Some(_) => row(what, by_base(&path)?),
        });
        // Not taken for that of the next run.
        fs::remove_file(path).or_else(|e| if e.kind() == std::io::ErrorKind::NotFound { Ok(()) } else { Err(e) })?;
    }
    Ok(rows)
}

fn cells(outcome: &Outcome, files: &[&Path]) -> Vec<String> {
    match outcome {
        Outcome::Remeshed { report, .. } => figures(report),
        Outcome::Refused { reason: message, .. } => without_figures(&format!("refused: {}", reason(message, files))),
        Outcome::Stopped { seconds } => without_figures(&format!("stopped after {seconds:.0} s")),
        Outcome::Failed { fault } => without_figures(&format!("FAILED: {}", reason(fault, files))),
    }
}

/// The reason in the first cell, the others empty.
fn without_figures(reason: &str) -> Vec<String> {
    let mut cells = vec![String::new(); FIGURES.len()];
    cells[0] = reason.to_owned();
    cells
}

fn text(rows: &[Row]) -> String {
    let columns = [&["model", ""], &FIGURES[..]].concat();
    let section = |&(group, title): &(&str, &str)| {
        let of_group = rows.iter().filter(|row| row.group == group);
        let cells: Vec<_> = of_group.map(|row| [&[row.model.clone(), row.what.clone()], &row.cells[..]].concat()).collect();
        format!("## {title}\n\n{}", table(&columns, &cells))
    };
    GROUPS.iter().map(section).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_go_to_their_table() {
        let line = r#"{"group":"relaxation","row":"none","ar_mean":0.75,"flipped":null}"#;
        let rows = [
            part(line, "a.obj").unwrap(),
            Row { group: "base".into(), model: "b.obj".into(), what: "ours".into(), cells: without_figures("refused") },
        ];
        let text = text(&rows);
        let [relaxation, base] = ["## Parts of our", "## Base meshes"].map(|title| text.find(title).unwrap());
        let [a, b] = ["| a.obj | none | 0.750 | - |", "| b.obj | ours | refused |  |"].map(|row| text.find(row).unwrap());
        assert!(relaxation < a && a < base && base < b);
        assert!(part("not JSON", "a.obj").is_err());
    }
}
