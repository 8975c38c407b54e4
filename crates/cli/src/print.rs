//! Standard output, or standard error where a mesh goes to standard output.

use crate::failure::Failure;
use crate::talk::Talk;
use anyhow::Context as _;
use serde::Serialize;
use std::io::{self, ErrorKind, Write};

/// Where something is printed.
#[derive(Clone, Copy)]
pub(crate) enum Stream {
    Output,
    Error,
}

impl From<Talk> for Stream {
    fn from(talk: Talk) -> Self {
        if talk.on_stderr { Self::Error } else { Self::Output }
    }
}

/// Writes bytes. That nobody reads them to the end (`| head`) is no error.
pub(crate) fn bytes(stream: Stream, bytes: &[u8]) -> anyhow::Result<()> {
    let write = |out: &mut dyn Write| out.write_all(bytes).and_then(|()| out.flush());
    let (written, name) = match stream {
        Stream::Output => (write(&mut io::stdout().lock()), "output"),
        Stream::Error => (write(&mut io::stderr().lock()), "error"),
    };
    match written {
        Err(e) if e.kind() == ErrorKind::BrokenPipe => Ok(()),
        done => done.with_context(|| format!("cannot write to standard {name}")),
    }
}

/// Writes one JSON object. A figure that is not finite becomes null.
pub(crate) fn json(stream: Stream, value: &impl Serialize) -> anyhow::Result<()> {
    bytes(stream, (serde_json::to_string_pretty(value)? + "\n").as_bytes())
}

/// Prints a report as the user wants it: as JSON, in full, as a summary, or not at all.
pub(crate) fn report(
    talk: Talk,
    json: &impl Serialize,
    summary: impl FnOnce() -> Table,
    full: impl FnOnce() -> Table,
) -> anyhow::Result<()> {
    let table = |table: Table| bytes(talk.into(), table.0.as_bytes());
    match talk {
        Talk { json: true, .. } => self::json(talk.into(), json),
        Talk { quiet: true, .. } => Ok(()),
        Talk { verbose: true, .. } => table(full()),
        _ => table(summary()),
    }
}

/// Prints what went wrong. That nobody listens is no error: the exit code still tells.
pub(crate) fn failure(failure: &Failure, talk: Talk) {
    if talk.json && !failure.told {
        json(talk.into(), failure).ok();
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
}
