//! Everything that must be green before a change lands.

use crate::process::{cargo, must};
use crate::{regress, tidy};
use anyhow::{Context, Result};
use std::time::Instant;

/// A check, with what it looks at.
struct Step {
    name: &'static str,
    what: &'static str,
    work: Work,
}

/// How a check is made.
enum Work {
    /// By cargo with these arguments, and perhaps a variable of the environment.
    Cargo(&'static [&'static str], Option<(&'static str, &'static str)>),
    /// By a chore of this program, named as on its command line.
    Chore(&'static str, fn() -> Result<()>),
}

/// The quick ones first.
const STEPS: &[Step] = &[
    Step {
        name: "format",
        what: "every file is laid out as rustfmt would",
        work: Work::Cargo(&["fmt", "--all", "--check"], None),
    },
    Step {
        name: "tidy",
        what: "who depends on whom, no circle of files, licences, docs, file sizes, docs/constants.md",
        work: Work::Chore("tidy", tidy::run),
    },
    Step {
        name: "lints",
        what: "no warning by clippy, tests and benches included",
        work: Work::Cargo(&["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"], None),
    },
    Step {
        name: "docs",
        what: "every page can be made, no link leads nowhere",
        work: Work::Cargo(&["doc", "--workspace", "--no-deps"], Some(("RUSTDOCFLAGS", "-D warnings"))),
    },
    Step {
        name: "tests",
        what: "all tests of all crates, and the examples in the docs",
        work: Work::Cargo(&["test", "--workspace"], None),
    },
    Step {
        name: "fixtures",
        what: "the files in fixtures/data are those that their generators make",
        work: Work::Cargo(&["run", "-p", "fixtures", "--bin", "make-fixtures", "--", "--check"], None),
    },
    Step {
        name: "regress",
        what: "the release binary remeshes all fixtures, and named models of SEMIREG_MODELS, as well as before",
        work: Work::Chore("regress", || regress::run(&regress::Args::default())),
    },
];

/// Runs all checks and stops at the first that fails.
pub(crate) fn run() -> Result<()> {
    let mut green = Vec::new();
    for (i, step) in STEPS.iter().enumerate() {
        println!("\n== {} of {}, {}: {}\n   {}", i + 1, STEPS.len(), step.name, step.what, step.work.command());
        let start = Instant::now();
        let done = step.work.run();
        let seconds = start.elapsed().as_secs_f64();
        done.with_context(|| {
            let before = if green.is_empty() { String::new() } else { format!("\nGreen before it:\n{}", summary(&green)) };
            format!("{} failed after {seconds:.0} s. It alone: {}{before}\nWhy", step.name, step.work.command())
        })?;
        println!("== {}: green in {seconds:.0} s", step.name);
        green.push((step.name, seconds));
    }
    println!("\nAll green:\n{}", summary(&green));
    Ok(())
}

/// A line for each step, and their sum.
fn summary(steps: &[(&str, f64)]) -> String {
    let all = ("all", steps.iter().map(|(_, seconds)| seconds).sum());
    let lines = steps.iter().chain([&all]).map(|(name, seconds)| format!("   {name:10} {seconds:6.0} s"));
    lines.collect::<Vec<_>>().join("\n")
}

impl Work {
    /// What somebody types to do it alone.
    fn command(&self) -> String {
        match self {
            Self::Cargo(arguments, None) => format!("cargo {}", arguments.join(" ")),
            Self::Cargo(arguments, Some((name, value))) => format!("{name}=\"{value}\" cargo {}", arguments.join(" ")),
            Self::Chore(name, _) => format!("cargo xtask {name}"),
        }
    }

    fn run(&self) -> Result<()> {
        match self {
            Self::Cargo(arguments, variable) => must(cargo(arguments).envs(*variable)),
            Self::Chore(_, run) => run(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_told_as_they_are_typed() {
        let command = |name: &str| STEPS.iter().find(|step| step.name == name).map(|step| step.work.command());
        assert_eq!(command("format").unwrap(), "cargo fmt --all --check");
        assert_eq!(command("docs").unwrap(), "RUSTDOCFLAGS=\"-D warnings\" cargo doc --workspace --no-deps");
        assert_eq!(command("regress").unwrap(), "cargo xtask regress");
    }

    #[test]
    fn the_summary_has_the_sum() {
        assert_eq!(summary(&[("a", 1.2), ("b", 2.0)]), "   a               1 s\n   b               2 s\n   all             3 s");
    }
}
