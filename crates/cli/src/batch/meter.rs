//! How far a batch has come, for people.

use super::line::{Line, Outcome};
use crate::talk::Talk;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::{self, IsTerminal as _, Write as _};
use std::sync::atomic::{AtomicUsize, Ordering};

/// What the bar shows.
const TEMPLATE: &str = "{bar:30} {pos} of {len} files  {elapsed}  {msg}";

/// Shows how many files are done: as a bar on a terminal, and as a line for each where the user wants to hear more.
pub(super) struct Meter {
    bar: Option<ProgressBar>,
    lines: bool,
    failed: AtomicUsize,
}

impl Meter {
    /// A meter on standard error, for so many files of which some are done.
    pub(super) fn new(talk: Talk, files: usize, done: usize) -> Self {
        let is_bar = !talk.quiet && io::stderr().is_terminal();
        let bar = is_bar.then(|| {
            let style = ProgressStyle::with_template(TEMPLATE).unwrap_or_else(|_| ProgressStyle::default_bar());
            ProgressBar::new(files as u64).with_position(done as u64).with_style(style)
        });
        Self { bar, lines: talk.verbose, failed: AtomicUsize::new(0) }
    }

    /// A file is done.
    pub(super) fn done(&self, line: &Line) {
        let told = told(line);
        match &self.bar {
            Some(bar) if self.lines => bar.println(&told),
            Some(_) => {}
            None if self.lines => drop(writeln!(io::stderr(), "{told}")),
            None => {}
        }
        let failed = usize::from(matches!(line.outcome, Outcome::Failed(_)));
        let failed = failed + self.failed.fetch_add(failed, Ordering::Relaxed);
        if let Some(bar) = &self.bar {
            bar.inc(1);
            bar.set_message(if failed > 0 { format!("{failed} did not come out") } else { String::new() });
        }
    }
}

impl Drop for Meter {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

fn told(line: &Line) -> String {
    let Line { input, seconds, outcome, .. } = line;
    match outcome {
        Outcome::Made { verdict, .. } => format!("{input}: {verdict} ({seconds:.1} s)"),
        Outcome::Failed(failure) => format!("{} ({seconds:.1} s)", line.named(failure)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_template_of_the_bar_is_sound() {
        assert!(ProgressStyle::with_template(TEMPLATE).is_ok());
    }
}
