//! [`Best`]: the best result so far, and why all others are not right.

use crate::Error;
use crate::attempt::Remedy;
use crate::verdict::Verdict;
use std::ops::ControlFlow;

/// The best result so far, and why all others are not right.
pub(crate) struct Best<T> {
    /// What the tries so far came to that did not come out right, in plain words.
    warnings: Vec<String>,
    failures: Vec<Error>,
    certified: Option<(Verdict, T)>,
}

impl<T> Best<T> {
    pub(crate) fn new() -> Self {
        Self { warnings: Vec::new(), failures: Vec::new(), certified: None }
    }

    /// What the best result comes to; `None` where there is none.
    pub(crate) fn verdict(&self) -> Option<&Verdict> {
        self.certified.as_ref().map(|(verdict, _)| verdict)
    }

    /// Takes a certified result. Breaks where it has all parts of the input: other creases or another way could not add any.
    pub(crate) fn pass(&mut self, remedy: Remedy, verdict: Verdict, result: T) -> ControlFlow<()> {
        if let Verdict::Lost { base_edges } = verdict {
            self.warnings.push(format!("{remedy} it misses the input by {base_edges:.2} base edges somewhere"));
        }
        let has_all = matches!(verdict, Verdict::Certified | Verdict::Short { .. });
        if self.certified.as_ref().is_none_or(|(best, _)| verdict > *best) {
            self.certified = Some((verdict, result));
        }
        if has_all { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// Takes a failure. Breaks where no other base mesh can help.
    pub(crate) fn fail(&mut self, remedy: Remedy, error: Error) -> ControlFlow<()> {
        let can_other_help = matches!(error, Error::NotCertified(_) | Error::Folded { .. } | Error::Base(_));
        self.warnings.push(format!("{remedy} it was tried and failed: {}", error.with_request()));
        self.failures.push(error);
        if can_other_help { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }

    /// The best result with the warnings of all tries. Without one, a fault of ours if there was any, else the failure that came nearest to a result,
    /// the first of equals.
    ///
    /// A certified result is never dropped for what failed after it, unless the caller has ended the run.
    pub(crate) fn end(mut self) -> Result<(T, Vec<String>), Error> {
        if let Some(i) = self.failures.iter().position(|e| matches!(e, Error::Cancelled)) {
            return Err(self.failures.swap_remove(i));
        }
        if let Some((_, result)) = self.certified {
            return Ok((result, self.warnings));
        }
        let fault = self.failures.iter().position(Error::is_internal);
        let nearest =
            || (0..self.failures.len()).min_by(|&i, &j| missing(&self.failures[i]).total_cmp(&missing(&self.failures[j])));
        Err(match fault.or_else(nearest) {
            Some(i) => self.failures.swap_remove(i),
            None => Error::NotCertified("nothing was tried".into()),
        })
    }
}

/// How far a failure is from a result: the share of the triangles that were folded, 1 where there were none.
fn missing(error: &Error) -> f64 {
    match *error {
        Error::Folded { folded, triangles } => folded as f64 / triangles.max(1) as f64,
        _ => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FOLDED: Error = Error::Folded { folded: 3, triangles: 100 };
    const TOO_LARGE: Error = Error::TooLarge { base_vertices: 9, triangles: 1 << 40 };

    fn lost(base_edges: f64) -> Verdict {
        Verdict::Lost { base_edges }
    }

    #[test]
    fn of_results_that_have_lost_something_the_one_that_lost_least_is_kept() {
        let mut best = Best::new();
        for (name, base_edges) in [("a", 0.5), ("b", 0.3), ("c", 0.4)] {
            assert!(best.pass(Remedy::AsAsked, lost(base_edges), name).is_continue());
        }
        let (result, warnings) = best.end().unwrap();
        assert_eq!((result, warnings.len()), ("b", 3));
    }

    #[test]
    fn nothing_is_tried_after_a_result_that_is_right() {
        let mut best = Best::new();
        assert!(best.fail(Remedy::AsAsked, FOLDED).is_continue());
        assert!(best.pass(Remedy::OtherBase, Verdict::Certified, "right").is_break());
        assert_eq!(best.end().unwrap().0, "right");
    }

    #[test]
    fn a_certified_result_is_never_dropped() {
        for error in [FOLDED, TOO_LARGE, Error::Fit(fit::FitError::NoFace(mesh_core::FaceId(0)))] {
            let mut best = Best::new();
            assert!(best.pass(Remedy::AsAsked, lost(0.5), "certified").is_continue());
            let text = error.to_string();
            let _ = best.fail(Remedy::MoreCreases, error);
            let (result, warnings) = best.end().unwrap();
            assert_eq!(result, "certified");
            assert!(warnings[1].contains(&text), "{warnings:?}");
        }
    }

    #[test]
    fn a_cancelled_run_leaves_nothing() {
        let mut best = Best::new();
        let _ = best.pass(Remedy::AsAsked, lost(0.5), "certified");
        assert!(best.fail(Remedy::MoreCreases, Error::Cancelled).is_break());
        assert!(matches!(best.end(), Err(Error::Cancelled)));
    }

    #[test]
    fn without_a_result_the_nearest_failure_is_told_or_a_fault_of_ours() {
        let ends = |errors: Vec<Error>| {
            let mut best = Best::<()>::new();
            for error in errors {
                let _ = best.fail(Remedy::AsAsked, error);
            }
            best.end().unwrap_err()
        };
        assert!(matches!(ends(vec![FOLDED, TOO_LARGE]), Error::Folded { .. }));
        let nearer = Error::Folded { folded: 4, triangles: 1_000 };
        assert!(matches!(ends(vec![FOLDED, nearer, TOO_LARGE]), Error::Folded { folded: 4, .. }));
        assert!(matches!(ends(vec![TOO_LARGE]), Error::TooLarge { .. }));
        let fault = || Error::Fit(fit::FitError::NoFace(mesh_core::FaceId(0)));
        assert!(matches!(ends(vec![FOLDED, fault()]), Error::Fit(_)));
    }
}
