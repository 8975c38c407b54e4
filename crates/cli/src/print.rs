//! Standard output.

use crate::args::Talk;
use crate::failure::Failure;
use anyhow::Context as _;
use serde::Serialize;
use std::io::{self, ErrorKind, Write as _};

/// Writes text to standard output. That nobody reads it to the end (`| head`) is no error.
pub(crate) fn text(text: &str) -> anyhow::Result<()> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(e) if e.kind() == ErrorKind::BrokenPipe => Ok(()),
        done => done.context("cannot write to standard output"),
    }
}

/// Writes one JSON object to standard output. A figure that is not finite becomes null.
pub(crate) fn json(value: &impl Serialize) -> anyhow::Result<()> {
    text(&(serde_json::to_string_pretty(value)? + "\n"))
}

/// Prints a report as the user wants it: as JSON, in full, as a summary, or not at all.
pub(crate) fn report(
    talk: Talk,
    json: &impl Serialize,
    summary: impl FnOnce() -> Table,
    full: impl FnOnce() -> Table,
) -> anyhow::Result<()> {
    match talk {
        Talk { json: true, .. } => self::json(json),
        Talk { quiet: true, .. } => Ok(()),
        Talk { verbose: true, .. } => full().print(),
        _ => summary().print(),
    }
}

/// Prints what went wrong. That nobody listens is no error: the exit code still tells.
pub(crate) fn failure(failure: &Failure, as_json: bool) {
    if as_json && !failure.told {
        json(failure).ok();
    }
    writeln!(io::stderr(), "error: {failure}").ok();
}

/// The failure after a report that is worth showing all the same. In JSON both are one object.
pub(crate) fn failed(
    talk: Talk,
    json: &impl Serialize,
    failure: impl Into<anyhow::Error>,
    summary: impl FnOnce() -> Table,
    full: impl FnOnce() -> Table,
) -> anyhow::Error {
    #[derive(Serialize)]
    struct Both<'a, T> {
        #[serde(flatten)]
        report: &'a T,
        #[serde(flatten)]
        failure: &'a Failure,
    }
    let mut failure = Failure::of(failure.into());
    let both = Both { report: json, failure: &failure };
    if let Err(e) = report(talk, &both, summary, full) {
        return e;
    }
    failure.told = true;
    failure.into()
}

/// Lines of a name and what it is, the names in one column.
#[derive(Default)]
pub(crate) struct Table(String);

impl Table {
    /// Appends a line.
    pub(crate) fn row(&mut self, name: &str, what: impl std::fmt::Display) {
        self.0 += &format!("{name:18}{what}\n");
    }

    /// Appends a line when there is something to say.
    pub(crate) fn row_if(&mut self, name: &str, what: Option<impl std::fmt::Display>) {
        if let Some(what) = what {
            self.row(name, what);
        }
    }

    /// All lines.
    #[cfg(test)]
    pub(crate) fn text(&self) -> &str {
        &self.0
    }

    /// Writes all lines to standard output.
    pub(crate) fn print(&self) -> anyhow::Result<()> {
        text(&self.0)
    }
}
