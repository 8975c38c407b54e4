//! The tables of `docs/performance.md`: processor time, peak memory, and how both grow.
//!
//! Every run is a process of the release binary on one thread, one at a time. Processor time is compared, as the clock also
//! counts what other programs on the machine do. Nothing here fails for being slow: figures are for people to judge.

mod growth;
mod inputs;
mod peers;
mod program;
mod stages;

use crate::cost::Cost;
use crate::markdown::{put, table};
use crate::process::{cargo, must, output, target_directory};
use crate::root;
use anyhow::Result;
use clap::ValueEnum;
use growth::{by_input, by_level, told};
use inputs::{Found, Generator};
use program::{Job, Program, Run, ratio};
use std::fs;
use std::path::PathBuf;
use std::process::Command;

#[derive(clap::Args)]
pub(crate) struct Args {
    /// The folder with fandisk, kitten, chinese_lion and igea [default: that in the environment's SEMIREG_MODELS]
    #[arg(long)]
    models: Option<PathBuf>,
    /// A folder with the parts flange_002_coarse.stl and housing_006_normal.stl
    #[arg(long)]
    cases: Option<PathBuf>,
    /// The file of the Stanford dragon
    #[arg(long, value_name = "FILE")]
    dragon: Option<PathBuf>,
    /// Run this program instead of building it
    #[arg(long, value_name = "FILE")]
    binary: Option<PathBuf>,
    /// An older program: the models are remeshed by it too, and the table has both
    #[arg(long, value_name = "FILE")]
    against: Option<PathBuf>,
    /// Remesh the models by pymeshlab, gpytoolbox and pyacvd too, which are fetched from PyPI
    #[arg(long)]
    peers: bool,
    /// Processor seconds after which a run is stopped
    #[arg(long, value_name = "SECONDS", default_value_t = 400, value_parser = clap::value_parser!(u64).range(2..))]
    cpu_limit: u64,
    /// A few minutes instead of an hour: fandisk and small inputs alone
    #[arg(long)]
    quick: bool,
    /// Only these parts; may be repeated [default: all]
    #[arg(long = "part", value_enum, value_name = "PART")]
    parts: Vec<Part>,
    /// Write the tables to docs/performance.md; without this they are printed
    #[arg(long)]
    write: bool,
}

#[derive(ValueEnum, Clone, Copy, PartialEq)]
enum Part {
    /// Models and a large scan
    Models,
    /// From 10,000 to a million triangles in
    Input,
    /// From level 3 to level 7 out
    Levels,
    /// Two threads and one
    Threads,
}

/// Triangles of generated inputs.
const INPUTS: [usize; 3] = [10_000, 100_000, 1_000_000];
/// Base vertices and levels for them: what the program takes by itself for a part without much detail.
const INPUT_SIZE: (usize, u32) = (1000, 2);
/// Those of the scan among the models.
const SCAN_SIZE: (usize, u32) = (1500, 3);
const QUICK_SIZE: (usize, u32) = (500, 2);
/// Levels of growing output, and base vertices for them: few, as level 7 has 16,384 times the base triangles.
const LEVELS: std::ops::RangeInclusive<u32> = 3..=7;
const LEVELS_BASE: usize = 30;

/// What all parts need.
struct Bench<'a> {
    args: &'a Args,
    models: Option<PathBuf>,
    now: Program,
    before: Option<Program>,
    generator: Generator,
}

/// Measures all parts, and prints or writes the tables.
pub(crate) fn run(args: &Args) -> Result<()> {
    let target = target_directory()?;
    let program = |binary: PathBuf, folder: &str| Program { binary, folder: target.join(folder), limit: args.cpu_limit };
    let now = match &args.binary {
        Some(binary) => binary.clone(),
        None => {
            must(&mut cargo(&["build", "--release", "-p", "cli"]))?;
            target.join("release/semireg")
        }
    };
    let before = args.against.clone().map(|binary| program(binary, "bench/before"));
    let models = args.models.clone().or_else(|| std::env::var_os("SEMIREG_MODELS").map(PathBuf::from));
    let bench = Bench { args, models, now: program(now, "bench/now"), before, generator: Generator::build()? };
    let text = bench.text()?;
    println!("\n{text}");
    if args.write {
        put(&root().join("docs/performance.md"), &text)?;
    }
    Ok(())
}

impl Bench<'_> {
    fn text(&self) -> Result<String> {
        let mut text = self.preamble()?;
        let wanted = |part| self.args.parts.is_empty() || self.args.parts.contains(&part);
        if wanted(Part::Models) {
            text += &self.models()?;
        }
        if wanted(Part::Input) {
            text += &self.growing_input()?;
        }
        if wanted(Part::Levels) {
            text += &self.growing_output()?;
        }
        if wanted(Part::Threads) {
            text += &self.threads()?;
        }
        Ok(text)
    }

    /// What was measured, and where.
    fn preamble(&self) -> Result<String> {
        let commit = output(Command::new("git").args(["rev-parse", "--short", "HEAD"]).current_dir(root()))?;
        let processors = std::thread::available_parallelism().map_or(1, |n| n.get());
        let program = match &self.args.binary {
            Some(_) => "a program that was given (`--binary`), measured by the chore",
            None => "the program",
        };
        let quick = if self.args.quick { "A QUICK RUN (`--quick`): fandisk and small inputs alone.\n\n" } else { "" };
        Ok(format!(
            "{quick}By `cargo xtask bench`: {program} at commit {}, on a machine with {processors} processors ({}).\nSeconds are \
             processor seconds of a whole run on one thread, with reading, certificate and writing; MB is the peak memory. A run is \
             stopped at {} s.\n",
            commit.trim(),
            std::env::consts::ARCH,
            self.args.cpu_limit
        ))
    }

    /// The table of models, and that of peers.
    fn models(&self) -> Result<String> {
        let Args { cases, dragon, quick, .. } = self.args;
        let mut jobs = Found { models: self.models.as_deref(), cases: cases.as_deref(), dragon: dragon.as_deref() }.jobs();
        if *quick {
            jobs.retain(|job| job.name.starts_with("fandisk"));
        }
        let (scan, (base_vertices, levels)) = if *quick { (INPUTS[0], QUICK_SIZE) } else { (INPUTS[2], SCAN_SIZE) };
        jobs.push(self.generator.make("scan", scan, base_vertices, levels)?.0);
        let (mut rows, mut runs, mut older) = (Vec::new(), Vec::new(), Vec::new());
        for job in jobs {
            let now = told(&job.name, self.now.remesh(&job, 1)?);
            let triangles = self.now.triangles(&job.input)?;
            let size = format!("{} / {}", job.base_vertices, job.levels);
            let mut row = [vec![job.name.clone(), size, triangles.to_string()], now.cells()].concat();
            if let Some(before) = &self.before {
                let before = told(&format!("{}, before", job.name), before.remesh(&job, 1)?);
                row.extend(against(&now, &before));
                older.push((format!("{}, before", job.name), before));
            }
            rows.push(row);
            runs.push((job, now));
        }
        let mut columns =
            vec!["model", "base / levels", "triangles in", "vertices out", "AR mean", "error mean", "processor s", "MB"];
        if self.before.is_some() {
            columns.extend(["before: out", "AR mean", "error mean", "processor s", "MB", "times less"]);
        }
        let all = older.iter().map(|(name, run)| (name.clone(), run));
        let all: Vec<_> = all.chain(runs.iter().map(|(job, run): &(Job, Run)| (job.name.clone(), run))).collect();
        let profile = stages::profile(&all);
        let mut text = format!("\n## Models\n\n{}\n## Where the time goes\n\n{profile}", table(&columns, &rows));
        if self.args.peers {
            text += &format!("\n## Others on the same models\n\n{}", self.peers(&runs)?);
        }
        Ok(text)
    }

    fn peers(&self, runs: &[(Job, Run)]) -> Result<String> {
        match peers::python() {
            Ok(python) => peers::table_of(&python, &self.now, runs),
            Err(e) => {
                println!("\n*** THE PEERS WERE NOT RUN: there is no Python environment ({e:#})\n");
                Ok("They were not run: there was no Python environment.\n".to_owned())
            }
        }
    }

    fn growing_input(&self) -> Result<String> {
        let (base_vertices, levels) = INPUT_SIZE;
        let mut text = format!("\n## Growing input, {base_vertices} base vertices, level {levels}\n");
        for (shape, title) in [("scan", "A noisy scan of a part with creases"), ("blob", "A smooth shape with limbs")] {
            let sizes = &INPUTS[..if self.args.quick { 2 } else { 3 }];
            let made: Result<Vec<_>> = sizes.iter().map(|&n| self.generator.make(shape, n, base_vertices, levels)).collect();
            text += &format!("\n### {title}\n\n{}", by_input(&self.now, &made?)?);
        }
        Ok(text)
    }

    fn growing_output(&self) -> Result<String> {
        let (job, triangles) = self.generator.make("blob", INPUTS[0], LEVELS_BASE, *LEVELS.start())?;
        let end = if self.args.quick { 5 } else { *LEVELS.end() };
        let jobs: Vec<Job> = (*LEVELS.start()..=end).map(|levels| Job { levels, ..job.clone() }).collect();
        let title = format!("Growing output, the smooth shape of {triangles} triangles, {LEVELS_BASE} base vertices");
        Ok(format!("\n## {title}\n\n{}", by_level(&self.now, &jobs)?))
    }

    /// igea where it is there, else a scan.
    fn threads(&self) -> Result<String> {
        let found = Found { models: self.models.as_deref(), cases: None, dragon: None };
        let igea = if self.args.quick { None } else { found.jobs().into_iter().find(|job| job.name.starts_with("igea")) };
        let job = match igea {
            Some(job) => job,
            None => self.generator.make("scan", INPUTS[0], INPUT_SIZE.0, INPUT_SIZE.1)?.0,
        };
        let mut rows = Vec::new();
        let mut outputs = Vec::new();
        for threads in [1, 2] {
            let run = told(&format!("{} on {threads} threads", job.name), self.now.remesh(&job, threads)?);
            let Cost { processor_seconds, seconds, megabytes } = run.cost();
            let by_clock = program::seconds(seconds);
            rows.push(vec![threads.to_string(), by_clock, program::seconds(processor_seconds), format!("{megabytes:.0}")]);
            if let Run::Done { output, .. } = run {
                outputs.push(fs::read(output)?);
            }
        }
        let same = match outputs.as_slice() {
            [one, two] if one == two => "The results are the same to the byte.",
            [_, _] => "THE RESULTS DIFFER, which is a bug.",
            _ => "A run gave no result.",
        };
        let table = table(&["threads", "s by the clock", "processor s", "MB"], &rows);
        Ok(format!("\n## One thread and two: {}\n\n{table}\n{same}\n", job.name))
    }
}

/// The cells of the older program, and how many times less time it takes now.
fn against(now: &Run, before: &Run) -> Vec<String> {
    let [new, old] = [now, before].map(|run| run.cost().processor_seconds);
    let times = match (now, before) {
        (Run::Done { .. }, Run::Done { .. }) => ratio(old, new),
        // Stopped: it would have taken longer.
        (Run::Done { .. }, Run::Without { reason, .. }) if reason.starts_with("stopped") && new < old => {
            format!("> {}", ratio(old, new))
        }
        _ => "-".to_owned(),
    };
    [before.cells(), vec![times]].concat()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn run(seconds: f64, done: bool) -> Run {
        let cost = Cost { processor_seconds: seconds, seconds, megabytes: 50.0 };
        match done {
            true => Run::Done { report: json!({ "vertices": 10, "ar_mean": 0.9 }), cost, output: PathBuf::new() },
            false => Run::Without { reason: "stopped at 400 s".into(), cost },
        }
    }

    #[test]
    fn a_stopped_run_bounds_the_ratio() {
        let last = |now: &Run, before: &Run| against(now, before).pop().unwrap();
        assert_eq!(last(&run(10.0, true), &run(25.0, true)), "2.50");
        assert_eq!(last(&run(10.0, true), &run(400.0, false)), "> 40.00");
        assert_eq!(last(&run(400.0, false), &run(10.0, true)), "-");
        assert_eq!(against(&run(1.0, true), &run(400.0, false)).len(), 6);
        assert_eq!(run(400.0, false).cells()[0], "stopped at 400 s");
    }
}
