//! The tables of `docs/sizes.md`: what was asked for, and what the result has.

use crate::markdown::{put, reason, table};
use crate::remesher::{LIMIT, Outcome, Remesher, Request, program};
use crate::root;
use anyhow::{Result, bail};
use serde_json::Value;
use std::path::{Path, PathBuf};

#[derive(clap::Args)]
pub(crate) struct Args {
    /// Meshes to run instead of the fixtures; the tables are printed then instead of written
    files: Vec<PathBuf>,
    /// Run this program instead of building it
    #[arg(long, value_name = "FILE")]
    binary: Option<PathBuf>,
}

/// Smooth and with creases, closed and open, coarse and dense.
const FIXTURES: [&str; 8] =
    ["blob.obj", "blind_holes.obj", "cylinder.ply", "flange.obj", "moebius.obj", "organic.obj", "part_fine.obj", "scan.obj"];

/// What is asked for, and the columns of its table beside base vertices, levels and tries.
const ASKED: [(&str, &[&str], &str); 4] = [
    ("vertices", &["2000", "20000"], "/vertices"),
    ("triangles", &["3000", "30000"], "/faces"),
    ("edge-length", &["0.02", "0.008"], "/mean_edge"),
    ("max-error", &["4e-3", "1e-3"], "/err_max"),
];

/// Runs every mesh with every size, and writes what came of it. Fails where a result has not what is promised, after writing.
pub(crate) fn run(args: &Args) -> Result<()> {
    let remesher = Remesher::of(&program(args.binary.as_deref())?, "sizes", LIMIT)?;
    let fixtures = || FIXTURES.iter().map(|name| root().join("fixtures/data").join(name)).collect();
    let files: Vec<PathBuf> = if args.files.is_empty() { fixtures() } else { args.files.clone() };
    let mut broken = Vec::new();
    let mut text = String::new();
    for (option, amounts, pointer) in ASKED {
        let mut rows = Vec::new();
        for file in &files {
            for amount in amounts {
                let row = row(&remesher, file, option, amount, pointer)?;
                println!("--{option} {}", row.cells.join("  "));
                broken.extend(row.fault.map(|fault| format!("{} --{option} {amount}: {fault}", file.display())));
                rows.push(row.cells);
            }
        }
        let columns = ["mesh", "asked", "has", "off", "base", "levels", "triangles", "tries", "seconds"];
        text += &format!("## `--{option}`\n\n{}\n", table(&columns, &rows));
    }
    if args.files.is_empty() {
        put(&root().join("docs/sizes.md"), &text)?;
    } else {
        println!("\n{text}");
    }
    if broken.is_empty() { Ok(()) } else { bail!("not as promised: {}", broken.join("; ")) }
}

/// A row, and what is wrong with it.
struct Row {
    cells: Vec<String>,
    fault: Option<String>,
}

fn row(remesher: &Remesher, file: &Path, option: &str, amount: &str, pointer: &str) -> Result<Row> {
    let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let share: f64 = amount.parse()?;
    // Lengths are told here as shares of the diagonal, as meshes have all sizes.
    let unit = if option == "edge-length" { diagonal(remesher, file)? } else { 1.0 };
    let options = [format!("--{option}={}", share * unit)];
    let options: Vec<&str> = options.iter().map(String::as_str).collect();
    let outcome = remesher.sized(&Request { options: &options, ..Request::of(file) })?;
    let Outcome::Remeshed { report, seconds, .. } = &outcome else {
        let why = match outcome {
            Outcome::Refused { reason: message, .. } => reason(&message, &[file]),
            _ => "stopped or failed".to_owned(),
        };
        return Ok(Row { cells: vec![name, amount.to_owned(), why.clone()], fault: Some(why) });
    };
    let number = |pointer: &str| number(report, pointer);
    let count = |pointer: &str| report.pointer(pointer).and_then(Value::as_array).map_or(0, Vec::len);
    let has = number(pointer);
    let off = has / share - 1.0;
    let is_kept = match option {
        "max-error" => off <= 0.0,
        "edge-length" => off.abs() <= 0.05,
        _ => off.abs() <= 0.03,
    };
    let shown = match option {
        "vertices" | "triangles" => format!("{has}"),
        "edge-length" => format!("{has:.4}"),
        _ => format!("{has:.2e}"),
    };
    let cells = [
        name,
        amount.to_owned(),
        shown,
        format!("{:+.1} %", 100.0 * off),
        number("/base_vertices/made").to_string(),
        count("/levels").saturating_sub(1).to_string(),
        number("/faces").to_string(),
        count("/sizes").to_string(),
        format!("{seconds:.1}"),
    ];
    Ok(Row { cells: cells.to_vec(), fault: (!is_kept).then(|| format!("it has {has}")) })
}

/// The diagonal of a mesh's box, as every report has it.
fn diagonal(remesher: &Remesher, file: &Path) -> Result<f64> {
    match remesher.sized(&Request { options: &["--vertices=200"], ..Request::of(file) })? {
        Outcome::Remeshed { report, .. } => Ok(number(&report, "/diagonal")),
        _ => bail!("{} cannot be remeshed", file.display()),
    }
}

fn number(report: &Value, pointer: &str) -> f64 {
    report.pointer(pointer).and_then(Value::as_f64).unwrap_or(f64::NAN)
}
