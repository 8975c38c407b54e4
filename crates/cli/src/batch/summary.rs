//! How a batch came out. Field names are a contract (docs/batch.md).

use super::line::{Line, Outcome};
use super::plan::BatchPlan;
use crate::failure::Kind;
use crate::print::Table;
use serde::Serialize;
use std::collections::BTreeMap;

/// What is printed at the end.
#[derive(Serialize)]
pub(super) struct Summary {
    version: &'static str,
    /// The output folder.
    out: String,
    /// The file of lines.
    pub(super) results: String,
    pub(super) files: usize,
    /// Files that had a line before this run.
    done_before: usize,
    /// Files with a result that falls short in nothing.
    certified: usize,
    /// Files with a result that falls short in something.
    with_shortcomings: usize,
    pub(super) failed: usize,
    /// Files that were left when the user ended the batch.
    pub(super) not_done: usize,
    /// Why files failed, the most frequent first.
    causes: Vec<Cause>,
    /// Wall time of this run.
    seconds: f64,
    /// The first file that falls short in something, and in what.
    #[serde(skip)]
    short: Option<(String, String)>,
}

/// Files that failed for the same kind of reason.
#[derive(Serialize)]
struct Cause {
    kind: Kind,
    files: usize,
    /// The first of them, and its error, in words with the name of the file and what to do.
    input: String,
    error: String,
}

impl Summary {
    /// Counts the lines of all files that are done.
    pub(super) fn new(plan: &BatchPlan, mut lines: Vec<Line>, done_before: usize, seconds: f64) -> Self {
        lines.sort_by(|a, b| a.input.cmp(&b.input));
        let not_done = plan.files.len() - lines.len();
        let (mut certified, mut with_shortcomings, mut failed, mut short) = (0, 0, 0, None);
        for line in &lines {
            match &line.outcome {
                Outcome::Made { shortcomings, .. } if shortcomings.is_empty() => certified += 1,
                Outcome::Made { shortcomings, .. } => {
                    with_shortcomings += 1;
                    short.get_or_insert_with(|| (line.input.clone(), shortcomings.join("; ")));
                }
                Outcome::Failed(_) => failed += 1,
            }
        }
        Self {
            version: env!("CARGO_PKG_VERSION"),
            out: plan.out.display().to_string(),
            results: plan.lines.display().to_string(),
            files: plan.files.len(),
            done_before,
            certified,
            with_shortcomings,
            failed,
            not_done,
            causes: causes(&lines),
            seconds,
            short,
        }
    }

    /// For people: how many came out, and why the others did not.
    pub(super) fn table(&self) -> Table {
        let Self { out, results, files, done_before, certified, with_shortcomings, not_done, seconds, .. } = self;
        let mut table = Table::default();
        let before = if *done_before > 0 { format!(" ({done_before} done before)") } else { String::new() };
        table.row(
            "files",
            format!("{files} after {seconds:.1} s{before}; what came out is in {out}, a line of each in {results}"),
        );
        table.row("certified", certified);
        table.row_if(
            "certified, but",
            self.short.as_ref().map(|(input, why)| format!("{with_shortcomings}, such as {input}: {why}")),
        );
        for Cause { kind, files, error, .. } in &self.causes {
            table.row(&kind.to_string(), format!("{files}, such as {error}"));
        }
        table.row_if("not done", (*not_done > 0).then_some(not_done));
        table
    }
}

/// The failures by their kinds.
fn causes(lines: &[Line]) -> Vec<Cause> {
    let mut causes: BTreeMap<Kind, Cause> = BTreeMap::new();
    for line in lines {
        let Outcome::Failed(failure) = &line.outcome else { continue };
        let (kind, input, error) = (failure.kind(), line.input.clone(), line.named(failure));
        causes.entry(kind).or_insert(Cause { kind, files: 0, input, error }).files += 1;
    }
    let mut causes: Vec<Cause> = causes.into_values().collect();
    causes.sort_by_key(|cause| std::cmp::Reverse(cause.files));
    causes
}
