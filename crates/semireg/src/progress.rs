//! How far a run has come, and how its caller ends it.

use mesh_core::Interrupt;
use std::ops::ControlFlow;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;

/// How far a run has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// The stage that runs, by the name that it has in the report's seconds.
    pub stage: &'static str,
    /// Number of the attempt, from 1.
    pub attempt: usize,
    /// Share of the run that is done, 0 to 1: an estimate that never falls.
    pub share: f64,
}

/// What a caller is asked again and again while a run goes on; breaking ends the run.
///
/// It is called on a thread of its own: at the start of each stage, and a few times a second in between.
pub type OnProgress<'a> = dyn FnMut(Progress) -> ControlFlow<()> + Send + 'a;

/// How long the caller is left alone at most.
const PERIOD: Duration = Duration::from_millis(50);

/// The stages in order, and the share of an attempt that is usually done when they begin.
const USUAL_SHARES: [(&str, f64); 18] = [
    ("clean", 0.0),
    ("refine", 0.02),
    ("features", 0.04),
    ("trace", 0.05),
    ("sizing", 0.05),
    ("proxy", 0.06),
    ("segment", 0.06),
    ("sample", 0.1),
    ("decimate", 0.1),
    ("base", 0.15),
    ("retrace", 0.3),
    ("search", 0.35),
    ("subdivide", 0.6),
    ("project", 0.62),
    ("relax", 0.65),
    ("snap", 0.8),
    ("fit", 0.87),
    ("certify", 0.94),
];
/// Most runs need one attempt: it is shown as so much of the whole, and each further one as the same part of what is left.
const SHARE_OF_AN_ATTEMPT: f64 = 0.9;

impl Progress {
    /// The start of a stage.
    pub(crate) fn at(stage: &'static str, attempt: usize) -> Self {
        let usual = USUAL_SHARES.iter().find(|(name, _)| *name == stage).map_or(0.0, |s| s.1);
        let left = (1.0 - SHARE_OF_AN_ATTEMPT).powi(attempt.saturating_sub(1) as i32);
        Self { stage, attempt, share: 1.0 - left * (1.0 - SHARE_OF_AN_ATTEMPT * usual) }
    }
}

/// A run's line to its caller. Copies tell the same caller.
#[derive(Clone, Default)]
pub(crate) struct Watch {
    caller: Option<Sender<Progress>>,
    /// Set when the caller wants the run to end.
    pub(crate) interrupt: Interrupt,
}

impl Watch {
    /// Tells how far the run has come.
    pub(crate) fn tell(&self, progress: Progress) {
        if let Some(caller) = &self.caller {
            // A caller that has ended the run does not listen any more.
            caller.send(progress).ok();
        }
    }
}

/// Runs `work` on this thread, and asks the caller on another one until the work is done.
pub(crate) fn watched<T>(on_progress: &mut OnProgress<'_>, work: impl FnOnce(Watch) -> T) -> T {
    let (sender, receiver) = channel();
    let watch = Watch { caller: Some(sender), interrupt: Interrupt::default() };
    let interrupt = watch.interrupt.clone();
    thread::scope(|scope| {
        scope.spawn(move || ask(on_progress, &receiver, &interrupt));
        work(watch)
    })
}

/// Asks the caller until it breaks, or until the work and its end of the line are gone.
fn ask(on_progress: &mut OnProgress<'_>, news: &Receiver<Progress>, interrupt: &Interrupt) {
    let mut last: Option<Progress> = None;
    loop {
        match news.recv_timeout(PERIOD) {
            Ok(now) => last = Some(Progress { share: now.share.max(last.map_or(0.0, |l| l.share)), ..now }),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return,
        }
        if last.is_some_and(|progress| on_progress(progress).is_break()) {
            interrupt.set();
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_rise_from_stage_to_stage_and_from_attempt_to_attempt() {
        let at = |attempt| USUAL_SHARES.map(|(stage, _)| Progress::at(stage, attempt).share);
        let shares = [at(1), at(2), at(3)].concat();
        assert!(shares.windows(2).all(|pair| pair[0] <= pair[1]) && shares[0] == 0.0, "{shares:?}");
        assert!(shares.iter().all(|s| *s < 1.0));
    }

    #[test]
    fn the_caller_hears_of_every_stage_and_can_end_the_work() {
        let mut heard = Vec::new();
        let mut listen = |progress: Progress| {
            heard.push(progress.stage);
            if progress.stage == "search" { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let ended = watched(&mut listen, |watch| {
            for stage in ["clean", "sizing", "search"] {
                watch.tell(Progress::at(stage, 1));
            }
            // The work goes on until it is told to end.
            (0..1000).any(|_| {
                thread::sleep(Duration::from_millis(5));
                watch.interrupt.is_set()
            })
        });
        assert!(ended);
        heard.dedup();
        assert_eq!(heard, ["clean", "sizing", "search"]);
    }
}
