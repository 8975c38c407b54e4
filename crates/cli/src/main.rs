//! The `semireg` program: see the README for its commands.
//!
//! Exit codes: 0 done (and certified), 1 refused or failed (of a batch: some files did) with `error: <what, where, what to do>` as the last line on standard
//! error, 2 wrong usage, 130 cancelled by the user.

mod args;
mod arrays;
mod base;
mod batch;
mod carry;
mod check;
mod compare;
mod decode;
mod decode_args;
mod displacement_arrays;
mod displacement_figures;
mod displacement_folder;
mod failure;
mod figures;
mod goal_args;
mod inspect;
mod kept;
mod load;
mod map_file;
mod marks;
mod number;
mod output;
mod outputs;
mod overwrite;
mod plan;
mod print;
mod progress;
mod relaxation_args;
mod remesh;
mod repairs;
mod report;
mod seconds;
mod shard;
mod stages;
mod stream;
mod stream_args;
mod talk;
mod verdict;

use args::{Args, Command};
use clap::Parser as _;
use failure::{Failure, Kind};
use print::Stream;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;
use std::sync::Mutex;

fn main() -> ExitCode {
    let command = match Args::try_parse() {
        Ok(args) => args.command,
        Err(e) => return wrong_usage(&e),
    };
    let talk = command.talk();
    match guarded(|| run(command)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(e) => {
            let failure = Failure::of(e);
            print::failure(&failure, talk);
            ExitCode::from(failure.exit_code())
        }
    }
}

fn run(command: Command) -> anyhow::Result<()> {
    match command {
        Command::Remesh(args) => remesh::run(&plan::RemeshPlan::new(args)?),
        Command::Batch(args) => batch::run(&args),
        Command::Base(args) => base::run(&plan::BasePlan::base(args)?),
        Command::Stages(args) => base::run(&plan::BasePlan::stages(args)?),
        Command::Inspect(args) => inspect::run(&args),
        Command::Compare(args) => compare::run(&args),
        Command::Check(args) => check::run(&args),
        Command::Decode(args) => decode::run(&args),
    }
}

/// Prints what clap says: help that was asked for, or what is wrong with the command line.
fn wrong_usage(error: &clap::Error) -> ExitCode {
    if error.use_stderr() && std::env::args_os().any(|arg| arg == "--json") {
        let text = error.to_string();
        let first = text.lines().next().unwrap_or_default().trim_start_matches("error: ");
        print::json(Stream::Output, &Failure::new(Kind::Usage, format!("{first}; see --help"))).ok();
    }
    error.print().ok();
    ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2))
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
        Err(Failure::new(Kind::Internal, format!("internal error: {message}; please report it with the input file")).into())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_one_line() {
        let line = Failure::of(guarded(|| panic!("index 3 of\n2")).unwrap_err()).to_string();
        assert!(line.starts_with("internal error: panicked at"), "{line}");
        assert!(line.ends_with("index 3 of 2; please report it with the input file"), "{line}");
    }
}
