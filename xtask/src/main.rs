//! Chores of the workspace, run as `cargo xtask <chore>`.

mod ablation;
mod bench;
mod ci;
mod cost;
mod gallery;
mod markdown;
mod models;
mod paper;
mod process;
mod python;
mod regress;
mod remesher;
mod results;
mod sizes;
mod tidy;
mod torture;
mod workers;

use clap::{Parser, Subcommand};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

#[derive(Parser)]
#[command(name = "cargo xtask", about = "Chores of the workspace")]
struct Args {
    #[command(subcommand)]
    chore: Chore,
}

#[derive(Subcommand)]
enum Chore {
    /// Everything that must be green: format, lints, tests, docs, tidy, regress
    Ci,
    /// Check what the compiler cannot: who depends on whom, circles of files, licences, docs, file sizes, paths, docs/constants.md
    Tidy,
    /// Write docs/constants.md, the page of all numbers that decide a result, from the sources
    Constants,
    /// Remesh the fixtures and compare with the stored figures and with libigl
    Regress(regress::Args),
    /// Remesh a folder of models, with and without the fit, and write the tables of docs/results.md
    Results(results::Args),
    /// Measure what each part of the method adds, and write the tables of docs/ablation.md
    Ablation(ablation::Args),
    /// Measure processor time and memory by size and by stage, and write the tables of docs/performance.md
    Bench(bench::Args),
    /// Run a program and note what it took: how `bench` starts others
    #[command(hide = true)]
    Cost(cost::Args),
    /// Remesh the paper's models by its pipeline as it is printed and by our default, and write the tables of docs/paper.md
    Paper(paper::Args),
    /// Remesh fixtures to sizes and errors that are asked for, and write the tables of docs/sizes.md
    Sizes(sizes::Args),
    /// Remesh the fixtures at the defaults, and write the pictures and the table of docs/gallery.md
    Gallery(gallery::Args),
    /// Remesh random solids at the defaults, and tell the share that is right and the causes of the others, with their seeds
    Torture(torture::Args),
}

fn main() -> ExitCode {
    let done = match Args::parse().chore {
        Chore::Ci => ci::run(),
        Chore::Tidy => tidy::run(),
        Chore::Constants => tidy::write_constants(),
        Chore::Regress(args) => regress::run(&args),
        Chore::Results(args) => results::run(&args),
        Chore::Ablation(args) => ablation::run(&args),
        Chore::Bench(args) => bench::run(&args),
        Chore::Cost(args) => cost::run(&args),
        Chore::Paper(args) => paper::run(&args),
        Chore::Sizes(args) => sizes::run(&args),
        Chore::Gallery(args) => gallery::run(&args),
        Chore::Torture(args) => torture::run(&args),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(e) => {
            eprintln!("error: {e:#}");
            ExitCode::FAILURE
        }
    }
}

/// The folder of the workspace.
fn root() -> PathBuf {
    let xtask = Path::new(env!("CARGO_MANIFEST_DIR"));
    xtask.parent().unwrap_or(xtask).to_owned()
}
