//! `semireg batch`: many files, each remeshed in a process of its own, so that none can stop the others, whatever it does.
//!
//! The parent process plans, starts a child (`semireg remesh`) for each file, and alone writes lines and puts results in their places. A
//! child works in a folder of its own inside a hidden one of the output folder, and ends when the parent does.

mod child;
mod file;
mod handed_on;
mod inputs;
mod line;
mod lines;
mod meter;
mod names;
mod plan;
mod resident;
mod summary;
mod work;

use crate::args::BatchArgs;
use crate::failure::{Failure, Kind};
use crate::print;
use lines::LinesFile;
use meter::Meter;
use plan::BatchPlan;
use std::time::Instant;
use summary::Summary;

/// Remeshes what is not done yet, then prints how all files came out. Fails where some did not.
pub(crate) fn run(args: &BatchArgs) -> anyhow::Result<()> {
    let start = Instant::now();
    let plan = BatchPlan::new(args)?;
    let (file, done) = LinesFile::open(&plan.lines, plan.opening)?;
    let (mut lines, open) = plan.split(done)?;
    let done_before = lines.len();
    work::stop_at_ctrl_c();
    let meter = Meter::new(plan.talk, plan.files.len(), done_before);
    lines.extend(work::run(&plan, &open, &file, &meter)?);
    drop(meter);
    let summary = Summary::new(&plan, lines, done_before, start.elapsed().as_secs_f64());
    let Some(failure) = failure(&summary) else {
        return print::report(plan.talk, &summary, || summary.table(), || summary.table());
    };
    Err(print::failed(plan.talk, &summary, failure, || summary.table(), || summary.table()))
}

fn failure(summary: &Summary) -> Option<Failure> {
    let Summary { files, failed, not_done, results, .. } = summary;
    if *not_done > 0 {
        let message = format!("cancelled when {not_done} of {files} files were not done; add --resume to go on with them");
        return Some(Failure::new(Kind::Cancelled, message));
    }
    let message = || format!("{failed} of {files} files did not come out; {results} says why of each");
    (*failed > 0).then(|| Failure::new(Kind::SomeFailed, message()))
}
