//! Remeshes the fixtures, and models when there are some, with the release binary.
//!
//! Every fixture's figures are compared with those in `fixtures/expected.json`, and our distances with libigl's. Models have no
//! stored figures: there a refusal is fine, while a panic, a hang or a result that does not check is not. The base mesh of every
//! input is made once more by itself, for its map to be checked.

mod expected;
mod oracle;

use crate::models::{files, split_named};
use crate::process::target_directory;
use crate::remesher::{HEADER, LIMIT, Outcome, Remesher, Request};
use crate::root;
use crate::workers::on_all_processors;
use anyhow::{Result, bail};
use expected::Expected;
use std::path::{Path, PathBuf};
use std::time::Duration;

#[derive(clap::Args, Default)]
pub(crate) struct Args {
    /// A folder of models to run too, all of them [default: a dozen named ones of the folder in the environment's SEMIREG_MODELS]
    #[arg(long)]
    models: Option<PathBuf>,
    /// Take over the counts of the fixtures, and every figure that is better than the best so far; what is worse is still told
    #[arg(long)]
    update: bool,
    /// Run only this fixture, and no models. May be repeated
    #[arg(long, value_name = "FIXTURE")]
    only: Vec<String>,
    /// With --update: take over all figures of this fixture, worse ones too (or that it is refused). May be repeated
    #[arg(long, value_name = "FIXTURE", requires = "update")]
    accept_worse: Vec<String>,
    /// Run this program instead of building it: one of before a change, say
    #[arg(long, value_name = "FILE")]
    binary: Option<PathBuf>,
}

/// How far a point of a fixture may be off after a way through the base map and back, as a share of the diagonal. Models have no such
/// limit yet: where parts are thinner than a base edge the map squeezes them (docs/method.md, known limits).
const MAX_ROUND_TRIP: f64 = 1e-9;

/// Time that a model of the environment's folder gets, so that a check of a change stays quick: what takes longer is listed as
/// stopped, and `--models` runs it to its end.
const QUICK_LIMIT: Duration = Duration::from_secs(60);

/// Runs fixtures and models; fails when anything is worse than it should be.
pub(crate) fn run(args: &Args) -> Result<()> {
    let within = |limit| match &args.binary {
        Some(binary) => Remesher::of(binary, "regress", limit),
        None => Remesher::build("regress", limit),
    };
    let mut problems = fixtures(&within(LIMIT)?, &target_directory()?, args)?;
    let folders = (&args.models, std::env::var_os("SEMIREG_MODELS").map(PathBuf::from));
    match folders {
        _ if !args.only.is_empty() => {}
        (Some(folder), _) => problems.extend(models(&within(LIMIT)?, folder, files(folder)?, Outcome::fault)?),
        (None, Some(folder)) => {
            let (named, missing) = split_named(files(&folder)?);
            for name in missing {
                println!("skipped: {} has no {name}", folder.display());
            }
            println!("of this folder only named models are run: for the whole of it, cargo xtask regress --models DIR");
            problems.extend(models(&within(QUICK_LIMIT)?, &folder, named, Outcome::fault_but_time)?);
        }
        (None, None) => println!("no models were run: give a folder of them with --models DIR, or set SEMIREG_MODELS"),
    }
    for problem in &problems {
        eprintln!("worse: {problem}");
    }
    match problems.len() {
        0 => Ok(()),
        n => bail!(
            "{n} figures are worse than they should be; where that is meant, --update --accept-worse FIXTURE takes them over"
        ),
    }
}

fn fixtures(remesher: &Remesher, target: &Path, args: &Args) -> Result<Vec<String>> {
    let data = root().join("fixtures/data");
    let mut expected = Expected::load(&root().join("fixtures/expected.json"), &files(&data)?)?;
    expected.must_have(&args.accept_worse)?;
    let mut problems = Vec::new();
    let mut pairs = Vec::new();
    expected.must_have(&args.only)?;
    let is_meant = |file: &String| args.only.is_empty() || args.only.contains(file);
    let count = expected.fixtures.keys().filter(|file| is_meant(file)).count();
    println!("{count} fixtures, compared with fixtures/expected.json\n{HEADER}");
    for (file, entry) in expected.fixtures.iter_mut().filter(|(file, _)| is_meant(file)) {
        let input = data.join(file);
        let request = Request { base_vertices: Some(entry.base_vertices), levels: entry.levels, ..Request::of(&input) };
        let outcome = remesher.run(&request)?;
        println!("{}", outcome.row(file));
        let faults = [outcome.fault(), remesher.base(&request, MAX_ROUND_TRIP)?.fault()];
        problems.extend(faults.into_iter().flatten().map(|fault| format!("{file}: {fault}")));
        let worse = match args.update {
            true => entry.update(&outcome, args.accept_worse.contains(file)),
            false => entry.compare(&outcome),
        };
        problems.extend(worse.into_iter().map(|problem| format!("{file}: {problem}")));
        if let Outcome::Remeshed { output, report, .. } = outcome {
            pairs.push(oracle::Pair { name: file.clone(), input, output, report });
        }
    }
    if args.update {
        expected.save()?;
    } else {
        let new = expected.new.iter().filter(|file| is_meant(file));
        problems.extend(new.map(|file| format!("{file} is not in expected.json: run with --update")));
    }
    problems.extend(oracle::check(&pairs, target)?);
    Ok(problems)
}

/// As many models at a time as there are processors, each on one thread; rows are printed as they come.
fn models(remesher: &Remesher, folder: &Path, files: Vec<String>, fault: fn(&Outcome) -> Option<String>) -> Result<Vec<String>> {
    println!("\n{} models, each remeshed and checked\n{HEADER}", files.len());
    let problems = on_all_processors(&files, |file| {
        let input = folder.join(file);
        let request = Request { threads: Some(1), ..Request::of(&input) };
        let outcome = remesher.run(&request)?;
        println!("{}", outcome.row(file));
        let faults = [fault(&outcome), fault(&remesher.base(&request, f64::INFINITY)?)];
        Ok(faults.into_iter().flatten().map(|fault| format!("{file}: {fault}")).collect::<Vec<_>>())
    })?;
    Ok(problems.concat())
}
