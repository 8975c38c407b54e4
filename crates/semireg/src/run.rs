//! A run under way: how long its stages take, and what was tried.

use crate::Error;
use crate::attempt::{Attempt, Remedy};
use crate::base::Way;
use crate::progress::{Progress, Watch};
use crate::verdict::Verdict;
use mesh_core::Interrupt;
use std::time::Instant;

/// How long a stage took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StageTime {
    /// The stage.
    pub stage: &'static str,
    /// Wall time in seconds, over all attempts.
    pub seconds: f64,
}

/// Wall time of the stages, in the order that they ran first. Together they are the time of the whole run: of stages that ran side by side
/// each has its share of the time that both took, and what belongs to no stage is `other`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StageSeconds(pub Vec<StageTime>);

impl StageSeconds {
    fn add(&mut self, stage: &'static str, seconds: f64) {
        match self.0.iter_mut().find(|s| s.stage == stage) {
            Some(entry) => entry.seconds += seconds,
            None => self.0.push(StageTime { stage, seconds }),
        }
    }

    /// Their sum.
    pub fn total(&self) -> f64 {
        self.0.iter().map(|s| s.seconds).sum()
    }
}

/// A run under way: it times the stages, keeps what was tried, tells the caller of both, and ends when the caller wants that.
pub(crate) struct Run {
    seconds: StageSeconds,
    watch: Watch,
    /// What was tried, in order.
    attempts: Vec<Attempt>,
    /// Number of the base mesh that is tried, from 1.
    n_bases: usize,
}

impl Run {
    pub(crate) fn new(watch: Watch) -> Self {
        Self { seconds: StageSeconds::default(), watch, attempts: Vec::new(), n_bases: 1 }
    }

    /// Keeps what an attempt came to that began at `start`.
    pub(crate) fn record(&mut self, remedy: Remedy, way: Option<Way>, verdict: Verdict, start: Instant) {
        self.n_bases += usize::from(remedy.makes_a_base());
        self.attempts.push(Attempt { remedy, way, verdict, seconds: start.elapsed().as_secs_f64() });
    }

    /// The flag that ends long work.
    pub(crate) fn interrupt(&self) -> &Interrupt {
        &self.watch.interrupt
    }

    /// Runs a stage. Fails with [`Error::Cancelled`] when the caller has ended the run meanwhile: the stage may not be finished then.
    pub(crate) fn stage<T, E: Into<Error>>(
        &mut self,
        stage: &'static str,
        run: impl FnOnce() -> Result<T, E>,
    ) -> Result<T, Error> {
        self.watch.tell(Progress::at(stage, self.n_bases));
        let start = Instant::now();
        let result = run();
        self.seconds.add(stage, start.elapsed().as_secs_f64());
        if self.interrupt().is_set() {
            return Err(Error::Cancelled);
        }
        result.map_err(Into::into)
    }

    /// Goes on with two parts side by side, each with a run of its own.
    pub(crate) fn side_by_side<A: Send, B: Send>(
        &mut self,
        first: impl FnOnce(&mut Self) -> A + Send,
        second: impl FnOnce(&mut Self) -> B + Send,
    ) -> (A, B) {
        let side = || Self { n_bases: self.n_bases, ..Self::new(self.watch.clone()) };
        let mut sides = [side(), side()];
        let [of_first, of_second] = &mut sides;
        let start = Instant::now();
        let results = rayon::join(|| first(of_first), || second(of_second));
        let wall = start.elapsed().as_secs_f64();
        let sum: f64 = sides.iter().map(|side| side.seconds.total()).sum();
        for time in sides.iter().flat_map(|side| &side.seconds.0) {
            self.seconds.add(time.stage, time.seconds * wall / sum.max(f64::MIN_POSITIVE));
        }
        results
    }

    /// The end of a run that took so long in all: the times of its stages, and what was tried.
    pub(crate) fn end(mut self, total: f64) -> (StageSeconds, Vec<Attempt>) {
        let other = (total - self.seconds.total()).max(0.0);
        self.seconds.add("other", other);
        (self.seconds, self.attempts)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn stages_side_by_side_share_the_time_that_both_took() {
        let mut run = Run::new(Watch::default());
        let wait = |stage| {
            move |run: &mut Run| {
                run.stage(stage, || {
                    std::thread::sleep(Duration::from_millis(30));
                    Ok::<_, Error>(())
                })
            }
        };
        let start = Instant::now();
        let (a, b) = run.side_by_side(wait("one"), wait("two"));
        a.and(b).unwrap();
        let total = start.elapsed().as_secs_f64();
        let seconds = run.end(total).0;
        assert_eq!(seconds.0.iter().map(|s| s.stage).collect::<Vec<_>>(), ["one", "two", "other"]);
        assert!((seconds.total() - total).abs() < 1e-9);
    }

    #[test]
    fn an_interrupted_stage_is_an_error() {
        let watch = Watch::default();
        let mut run = Run::new(watch.clone());
        assert_eq!(run.stage("one", || Ok::<_, Error>(1)).unwrap(), 1);
        watch.interrupt.set();
        assert!(matches!(run.stage("two", || Ok::<_, Error>(2)), Err(Error::Cancelled)));
    }
}
