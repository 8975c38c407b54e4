//! Random solids of our own making, each remeshed at the program's defaults and judged by what the program says of its result.
//!
//! The fixtures are known; these are not. The share that is right is the figure that counts, and each of the others has a seed, by
//! which it is made again.

mod judgement;
mod run;
mod solid;
mod summary;

use crate::process::{cargo, must, output, target_directory};
use crate::remesher::program;
use crate::workers::on_all_processors;
use anyhow::{Context, Result, bail};
use judgement::End;
use run::Runner;
use solid::{Judged, Solid};
use std::path::{Path, PathBuf};
use std::process::Command;
use summary::summary;

#[derive(clap::Args)]
pub(crate) struct Args {
    /// How many solids, one for each seed from --seed on
    #[arg(long, default_value_t = 100)]
    count: u64,
    /// The seed of the first solid
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Leave out so many of them at the beginning: to go on with a run that was broken off
    #[arg(long, value_name = "K", default_value_t = 0)]
    from: u64,
    /// The solid of this seed alone; its files are kept
    #[arg(long, value_name = "SEED", conflicts_with_all = ["count", "seed", "from"])]
    only: Option<u64>,
    /// Run this program instead of building it
    #[arg(long, value_name = "FILE")]
    binary: Option<PathBuf>,
    /// Processor seconds after which a run is stopped
    #[arg(long, value_name = "SECONDS", default_value_t = 60)]
    cpu_limit: u64,
    /// Keep the files of all solids in this folder [default: of those that are not right, in the folder torture under the target
    /// folder]
    #[arg(long, value_name = "DIR")]
    keep: Option<PathBuf>,
}

/// Remeshes the solids, as many at a time as there are processors. Fails where a run panics or a result does not check.
pub(crate) fn run(args: &Args) -> Result<()> {
    let folder = match &args.keep {
        Some(folder) => std::path::absolute(folder)?,
        None => target_directory()?.join("torture"),
    };
    let [first, count] = match args.only {
        Some(seed) => [seed, 1],
        None => [args.seed.saturating_add(args.from), args.count.saturating_sub(args.from)],
    };
    let keep_all = args.keep.is_some() || args.only.is_some();
    let runner = Runner { binary: program(args.binary.as_deref())?, folder: folder.clone(), limit: args.cpu_limit, keep_all };
    let solids = solids(first, count, &folder)?;
    let judged = all(&runner, &solids)?;
    println!("\n{}", summary(&judged));
    println!("\nfiles are in {}", folder.display());
    match judged.iter().filter(|j| j.end.is_fault()).count() {
        0 => Ok(()),
        n => bail!("{n} of {} runs ended as none should", judged.len()),
    }
}

/// Makes the solids of seeds one after the other.
fn solids(first: u64, count: u64, folder: &Path) -> Result<Vec<Solid>> {
    must(&mut cargo(&["build", "--quiet", "--release", "-p", "fixtures", "--bin", "make-solids"]))?;
    let generator = target_directory()?.join("release/make-solids");
    let list = output(Command::new(generator).arg(first.to_string()).arg(count.to_string()).arg(folder))?;
    let solid = |line: &str| {
        let [seed, kind, triangles, disturbed] = line.split('\t').collect::<Vec<_>>().try_into().ok()?;
        let input = folder.join(format!("{seed}_{kind}.obj"));
        let [kind, triangles, disturbed] = [kind, triangles, disturbed].map(str::to_owned);
        Some(Solid { seed: seed.parse().ok()?, kind, triangles, disturbed, input })
    };
    list.lines().map(|line| solid(line).with_context(|| format!("make-solids printed {line:?}"))).collect()
}

/// Runs all, and prints a line for each that is not right as it ends.
fn all(runner: &Runner, solids: &[Solid]) -> Result<Vec<Judged>> {
    on_all_processors(solids, |solid| {
        let (end, seconds) = runner.run(solid)?;
        let Solid { seed, kind, triangles, disturbed, .. } = solid;
        if !matches!(end, End::Right) || solids.len() == 1 {
            println!("seed {seed:5} {kind:10} {triangles:>6} triangles {seconds:6.1} s  {end}  {disturbed}");
        }
        Ok(Judged { seed: *seed, kind: kind.clone(), end, seconds })
    })
}
