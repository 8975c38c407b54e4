//! The `semireg` program: see the README for its commands.
//!
//! Exit codes: 0 done (and certified), 1 refused or failed with `error: <what, where, what to do>` as the last line on standard
//! error, 2 wrong usage.

mod args;
mod base;
mod check;
mod compare;
mod figures;
mod inspect;
mod load;
mod plan;
mod print;
mod remesh;
mod report;
mod stages;

use args::{Args, Command};
use clap::Parser as _;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;
use std::sync::Mutex;

fn main() -> ExitCode {
    let command = Args::parse().command;
    match guarded(|| run(command)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(e) => {
            eprintln!("error: {}", one_line(&format!("{e:#}")));
            ExitCode::FAILURE
        }
    }
}

fn run(command: Command) -> anyhow::Result<()> {
    match command {
        Command::Remesh(args) => remesh::run(&plan::RemeshPlan::new(args)?),
        Command::Base(args) => base::run(&plan::BasePlan::base(args)?),
        Command::Stages(args) => base::run(&plan::BasePlan::stages(args)?),
        Command::Inspect(args) => inspect::run(&args),
        Command::Compare(args) => compare::run(&args),
        Command::Check(args) => check::run(&args),
    }
}

/// Runs with panics turned into errors: a bug of ours must not look like one of the user's, nor print more than its line.
fn guarded(run: impl FnOnce() -> anyhow::Result<()>) -> anyhow::Result<()> {
    static PANIC: Mutex<String> = Mutex::new(String::new());
    std::panic::set_hook(Box::new(|info| {
        if let Ok(mut message) = PANIC.lock() {
            *message = info.to_string();
        }
    }));
    catch_unwind(AssertUnwindSafe(run)).unwrap_or_else(|_| {
        let message = PANIC.lock().map(|m| m.clone()).unwrap_or_default();
        Err(anyhow::anyhow!("internal error, please report it with the input file: {message}"))
    })
}

fn one_line(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_one_line() {
        let error = guarded(|| panic!("index 3 of\n2")).unwrap_err();
        let line = one_line(&error.to_string());
        assert!(line.starts_with("internal error, please report it with the input file: panicked at"), "{line}");
        assert!(line.ends_with("index 3 of 2"), "{line}");
    }
}
