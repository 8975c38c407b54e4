//! The files of a batch, some at the same time.

use super::file;
use super::line::Line;
use super::lines::LinesFile;
use super::meter::Meter;
use super::plan::{BatchFile, BatchPlan};
use anyhow::Context as _;
use std::fs;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;

/// Whether no more files shall be begun, and those at work be ended.
static STOP: AtomicBool = AtomicBool::new(false);

/// From now on Ctrl-C ends the work, and leaves what is done.
pub(super) fn stop_at_ctrl_c() {
    // Without a handler, Ctrl-C ends the program as ever, and the children with it.
    ctrlc::set_handler(|| STOP.store(true, Ordering::Relaxed)).ok();
}

fn is_stopped() -> bool {
    STOP.load(Ordering::Relaxed)
}

/// Remeshes the files and writes their lines in the order in which files are done. Returns them in brief; when it was stopped, of the
/// files that were done by then.
pub(super) fn run(plan: &BatchPlan, files: &[&BatchFile], lines: &LinesFile, meter: &Meter) -> anyhow::Result<Vec<Line>> {
    // Of a batch that was killed: it holds the lock on the lines no more, so nothing in there has an owner.
    fs::remove_dir_all(&plan.unfinished).ok();
    let next = AtomicUsize::new(0);
    let work = || -> anyhow::Result<Vec<Line>> {
        let mut done = Vec::new();
        while !is_stopped() {
            let number = next.fetch_add(1, Ordering::Relaxed);
            let Some(file) = files.get(number) else { break };
            let Some(line) = file::remesh(plan, file, number, is_stopped)? else { break };
            lines.append(&line)?;
            meter.done(&line);
            done.push(line.in_brief());
        }
        Ok(done)
    };
    // When one cannot go on, nor can the others.
    let work = || work().inspect_err(|_| STOP.store(true, Ordering::Relaxed));
    let done: anyhow::Result<Vec<Vec<Line>>> = thread::scope(|scope| {
        let workers: Vec<_> = (0..plan.jobs.min(files.len())).map(|_| scope.spawn(work)).collect();
        workers.into_iter().map(|worker| worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))).collect()
    });
    fs::remove_dir_all(&plan.unfinished).ok();
    let done = done.context("the batch cannot go on")?;
    Ok(done.concat())
}
