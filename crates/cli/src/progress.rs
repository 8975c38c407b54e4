//! How far a run has come, for people, and Ctrl-C.

use crate::args::Talk;
use crate::failure::Failure;
use indicatif::{ProgressBar, ProgressStyle};
use semireg::Progress;
use std::io::{self, IsTerminal as _, Write as _};
use std::ops::ControlFlow;
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};

/// Set when the user has pressed Ctrl-C.
static CANCELLED: AtomicBool = AtomicBool::new(false);

/// What the bar shows.
const TEMPLATE: &str = "{bar:30} {percent:>3} %  {elapsed}  {msg}";
/// Steps of a whole bar.
const STEPS: u64 = 1000;

/// Shows how far a run has come: as a bar on a terminal, else as a line a stage where the user wants to hear more, else not at all.
pub(crate) struct Meter<'a> {
    bar: Option<ProgressBar>,
    lines: bool,
    last: Option<(&'static str, usize)>,
    cancelled: &'a AtomicBool,
}

impl Meter<'static> {
    /// A meter on standard error, which Ctrl-C ends from now on: the run is asked to end, and a second Ctrl-C ends the program at once.
    pub(crate) fn new(talk: Talk) -> Self {
        let on_second = || {
            if CANCELLED.swap(true, Ordering::Relaxed) {
                process::exit(i32::from(Failure::cancelled().exit_code()));
            }
        };
        // Without a handler, Ctrl-C ends the program as ever.
        ctrlc::set_handler(on_second).ok();
        let is_bar = !talk.quiet && io::stderr().is_terminal();
        let lines = talk.verbose && !is_bar;
        Self { bar: is_bar.then(bar), lines, last: None, cancelled: &CANCELLED }
    }
}

impl Meter<'_> {
    /// Shows the progress of a run; breaks when it shall end.
    pub(crate) fn step(&mut self, progress: Progress) -> ControlFlow<()> {
        let Progress { stage, attempt, share } = progress;
        let text = if attempt > 1 { format!("{stage} (attempt {attempt})") } else { stage.to_owned() };
        if let Some(bar) = &self.bar {
            bar.set_position((share * STEPS as f64) as u64);
            bar.set_message(text);
        } else if self.lines && self.last != Some((stage, attempt)) {
            self.last = Some((stage, attempt));
            writeln!(io::stderr(), "{:3.0} %  {text}", 100.0 * share).ok();
        }
        if self.cancelled.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// Fails when the user has ended the run: for the time when nobody asks for progress.
    pub(crate) fn check(&self) -> Result<(), Failure> {
        if self.cancelled.load(Ordering::Relaxed) { Err(Failure::cancelled()) } else { Ok(()) }
    }
}

impl Drop for Meter<'_> {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

fn bar() -> ProgressBar {
    let style = ProgressStyle::with_template(TEMPLATE);
    ProgressBar::new(STEPS).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_goes_on_until_the_user_cancels() {
        let cancelled = AtomicBool::new(false);
        let mut meter = Meter { bar: Some(ProgressBar::hidden()), lines: false, last: None, cancelled: &cancelled };
        let progress = Progress { stage: "relax", attempt: 2, share: 0.5 };
        assert_eq!(meter.step(progress), ControlFlow::Continue(()));
        assert!(meter.check().is_ok());
        assert_eq!(meter.bar.as_ref().map(|bar| bar.message()), Some("relax (attempt 2)".to_owned()));
        cancelled.store(true, Ordering::Relaxed);
        assert_eq!(meter.step(progress), ControlFlow::Break(()));
        let failure = meter.check().unwrap_err();
        assert_eq!((failure.to_string(), failure.exit_code()), ("cancelled".to_owned(), 130));
    }

    #[test]
    fn the_template_of_the_bar_is_sound() {
        assert!(ProgressStyle::with_template(TEMPLATE).is_ok());
    }

    #[test]
    fn a_cancelled_run_is_told_as_such() {
        let mut stop = |_: Progress| ControlFlow::Break(());
        let triangle = mesh_core::Soup::from_slices(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[0, 1, 2]]);
        let error = semireg::remesh_with(&triangle, &semireg::Options::default(), &mut stop).unwrap_err();
        assert_eq!(Failure::of(anyhow::Error::from(error).context("a.obj")), Failure::cancelled());
    }
}
