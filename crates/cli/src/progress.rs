//! How far a run has come, for people, and Ctrl-C.

use crate::failure::Failure;
use crate::print;
use crate::talk::Talk;
use indicatif::{ProgressBar, ProgressStyle};
use semireg::Progress;
use std::io::{self, IsTerminal as _, Write as _};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU8, Ordering};
use std::time::Duration;
use std::{process, thread};

/// What the program is at.
static PHASE: Phase = Phase::new();
/// A run that Ctrl-C has not ended by itself after this time is ended with the whole program.
const GRACE: Duration = Duration::from_millis(200);

/// What the bar shows.
const TEMPLATE: &str = "{bar:30} {percent:>3} %  {elapsed}  {msg}";
/// Steps of a whole bar.
const STEPS: u64 = 1000;

/// Shows how far a run has come: as a bar on a terminal, else as a line a stage where the user wants to hear more, else not at all.
pub(crate) struct Meter<'a> {
    bar: Option<ProgressBar>,
    lines: bool,
    last: Option<(&'static str, usize)>,
    phase: &'a Phase,
}

/// Whether there is work that Ctrl-C may end. It may until files are written: these are written whole.
struct Phase(AtomicU8);

impl Phase {
    const WORKING: u8 = 0;
    const WRITING: u8 = 1;
    const CANCELLED: u8 = 2;

    const fn new() -> Self {
        Self(AtomicU8::new(Self::WORKING))
    }

    /// Goes from work to another phase, unless it has gone already. Returns whether it is in that phase now.
    fn enter(&self, phase: u8) -> bool {
        let before = self.0.compare_exchange(Self::WORKING, phase, Ordering::Relaxed, Ordering::Relaxed);
        before.is_ok() || before == Err(phase)
    }

    /// Goes back to work after what was written.
    fn resume(&self) {
        self.0.compare_exchange(Self::WRITING, Self::WORKING, Ordering::Relaxed, Ordering::Relaxed).ok();
    }

    fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed) == Self::CANCELLED
    }
}

/// From now on the program ends when standard input does, that is, with whoever holds the other end of it; not while files are written.
pub(crate) fn end_with_stdin() {
    thread::spawn(|| {
        io::copy(&mut io::stdin().lock(), &mut io::sink()).ok();
        if PHASE.enter(Phase::CANCELLED) {
            process::exit(i32::from(Failure::cancelled().exit_code()));
        }
    });
}

impl Meter<'static> {
    /// A meter on standard error. From now on Ctrl-C ends the run, and the program with it within a quarter of a second.
    pub(crate) fn new(talk: Talk) -> Self {
        PHASE.resume();
        let cancel = move || {
            if PHASE.enter(Phase::CANCELLED) {
                // The run ends between its steps. A long step is not waited for: nothing was written yet.
                thread::sleep(GRACE);
                let failure = Failure::cancelled();
                print::failure(&failure, talk);
                process::exit(i32::from(failure.exit_code()));
            }
        };
        // Without a handler, Ctrl-C ends the program as ever.
        ctrlc::set_handler(cancel).ok();
        let is_bar = !talk.quiet && io::stderr().is_terminal();
        let lines = talk.verbose && !is_bar;
        Self { bar: is_bar.then(bar), lines, last: None, phase: &PHASE }
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
        if self.phase.is_cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// Files are written from now on, and Ctrl-C is not heard any more. Fails when the user has ended the run before.
    pub(crate) fn begin_writing(&self) -> Result<(), Failure> {
        if self.phase.enter(Phase::WRITING) { Ok(()) } else { Err(Failure::cancelled()) }
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
        let phase = Phase::new();
        let mut meter = Meter { bar: Some(ProgressBar::hidden()), lines: false, last: None, phase: &phase };
        let progress = Progress { stage: "relax", attempt: 2, share: 0.5 };
        assert_eq!(meter.step(progress), ControlFlow::Continue(()));
        assert_eq!(meter.bar.as_ref().map(|bar| bar.message()), Some("relax (attempt 2)".to_owned()));
        assert!(phase.enter(Phase::CANCELLED));
        assert_eq!(meter.step(progress), ControlFlow::Break(()));
        let failure = meter.begin_writing().unwrap_err();
        assert_eq!((failure.to_string(), failure.exit_code()), ("cancelled".to_owned(), 130));
    }

    #[test]
    fn what_is_being_written_is_written_whole() {
        let phase = Phase::new();
        let meter = Meter { bar: None, lines: false, last: None, phase: &phase };
        assert!(meter.begin_writing().is_ok() && !phase.enter(Phase::CANCELLED) && !phase.is_cancelled());
        // The next result can be cancelled again.
        phase.resume();
        assert!(phase.enter(Phase::CANCELLED) && phase.is_cancelled());
        assert!(meter.begin_writing().is_err());
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
