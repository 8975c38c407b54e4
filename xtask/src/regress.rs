//! Remeshes the fixtures, and a folder of models when there is one, with the release binary.
//!
//! Every fixture's figures are compared with those in `fixtures/expected.json`, and our distances with libigl's. Models have no
//! stored figures: there a refusal is fine, while a panic, a hang or a result that does not check is not. The base mesh of every
//! input is made once more by itself, for its map to be checked.

mod expected;
mod oracle;

use crate::models::files;
use crate::process::target_directory;
use crate::remesher::{HEADER, LIMIT, Outcome, Remesher, Request};
use crate::root;
use anyhow::{Result, anyhow, bail};
use expected::Expected;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

#[derive(clap::Args, Default)]
pub(crate) struct Args {
    /// A folder of models to run too, with the table of their figures [default: the environment's SEMIREG_MODELS]
    #[arg(long)]
    models: Option<PathBuf>,
    /// Take today's figures of the fixtures as the expected ones
    #[arg(long)]
    update: bool,
}

/// How far a point of a fixture may be off after a way through the base map and back, as a share of the diagonal. Models have no such
/// limit yet: where parts are thinner than a base edge the map squeezes them (docs/method.md, known limits).
const MAX_ROUND_TRIP: f64 = 1e-9;

/// Time that a model of the environment's folder gets, so that a check of a change stays quick: what takes longer is listed as
/// stopped, and `--models` runs it to its end.
const QUICK_LIMIT: Duration = Duration::from_secs(60);

/// Runs fixtures and models; fails when anything is worse than it should be.
pub(crate) fn run(args: &Args) -> Result<()> {
    let within = |limit| Remesher::build("regress", limit);
    let mut problems = fixtures(&within(LIMIT)?, &target_directory()?, args.update)?;
    match (&args.models, std::env::var_os("SEMIREG_MODELS").map(PathBuf::from)) {
        (Some(folder), _) => problems.extend(models(&within(LIMIT)?, folder, Outcome::fault)?),
        (None, Some(folder)) => problems.extend(models(&within(QUICK_LIMIT)?, &folder, Outcome::fault_but_time)?),
        (None, None) => println!("no folder of models: give --models DIR or set SEMIREG_MODELS to run one"),
    }
    for problem in &problems {
        eprintln!("worse: {problem}");
    }
    match problems.len() {
        0 => Ok(()),
        n => bail!("{n} figures are worse than they should be; where that is meant, run with --update"),
    }
}

fn fixtures(remesher: &Remesher, target: &Path, update: bool) -> Result<Vec<String>> {
    let data = root().join("fixtures/data");
    let mut expected = Expected::load(&root().join("fixtures/expected.json"), &files(&data)?)?;
    let mut problems = Vec::new();
    let mut pairs = Vec::new();
    println!("{}", HEADER);
    for (file, entry) in &mut expected.fixtures {
        let input = data.join(file);
        let request = Request { base_vertices: Some(entry.base_vertices), levels: entry.levels, ..Request::of(&input) };
        let outcome = remesher.run(&request)?;
        println!("{}", outcome.row(file));
        let faults = [outcome.fault(), remesher.base(&request, MAX_ROUND_TRIP)?.fault()];
        problems.extend(faults.into_iter().flatten().map(|fault| format!("{file}: {fault}")));
        match update {
            true => entry.take(&outcome),
            false => problems.extend(entry.compare(&outcome).into_iter().map(|p| format!("{file}: {p}"))),
        }
        if let Outcome::Remeshed { output, report, .. } = outcome {
            pairs.push(oracle::Pair { name: file.clone(), input, output, report });
        }
    }
    if update {
        expected.save()?;
    } else {
        problems.extend(expected.new.iter().map(|file| format!("{file} is not in expected.json: run with --update")));
    }
    problems.extend(oracle::check(&pairs, target)?);
    Ok(problems)
}

/// As many models at a time as there are processors, each on one thread; rows are printed as they come.
fn models(remesher: &Remesher, folder: &Path, fault: fn(&Outcome) -> Option<String>) -> Result<Vec<String>> {
    println!("\n{}", HEADER);
    let files = files(folder)?;
    let next = AtomicUsize::new(0);
    let work = || -> Result<Vec<String>> {
        let mut problems = Vec::new();
        while let Some(file) = files.get(next.fetch_add(1, Ordering::Relaxed)) {
            let input = folder.join(file);
            let request = Request { threads: Some(1), ..Request::of(&input) };
            let outcome = remesher.run(&request)?;
            println!("{}", outcome.row(file));
            let faults = [fault(&outcome), fault(&remesher.base(&request, f64::INFINITY)?)];
            problems.extend(faults.into_iter().flatten().map(|fault| format!("{file}: {fault}")));
        }
        Ok(problems)
    };
    let processors = thread::available_parallelism().map_or(1, |n| n.get());
    thread::scope(|scope| {
        let workers: Vec<_> = (0..processors).map(|_| scope.spawn(work)).collect();
        let mut problems = Vec::new();
        for worker in workers {
            problems.extend(worker.join().map_err(|_| anyhow!("a worker of regress panicked"))??);
        }
        Ok(problems)
    })
}
