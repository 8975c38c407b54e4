//! [`Best`]: the best result so far, and why all others are not right.

use crate::Error;
use crate::attempt::Remedy;
use crate::verdict::Verdict;

/// The best result so far, and why all others are not right.
pub(crate) struct Best<T> {
    /// What the tries so far came to that did not come out right, in plain words.
    pub(crate) warnings: Vec<String>,
    first_failure: Option<Error>,
    certified: Option<(Verdict, T)>,
}

impl<T> Best<T> {
    pub(crate) fn new() -> Self {
        Self { warnings: Vec::new(), first_failure: None, certified: None }
    }

    pub(crate) fn has_tried(&self) -> bool {
        self.certified.is_some() || self.first_failure.is_some()
    }

    /// Whether nothing better can come.
    pub(crate) fn is_right(&self) -> bool {
        self.certified.as_ref().is_some_and(|(verdict, _)| *verdict == Verdict::Certified)
    }

    /// Takes a certified result.
    pub(crate) fn pass(&mut self, remedy: Remedy, verdict: Verdict, result: T) {
        if let Verdict::Lost { base_edges } = verdict {
            self.warnings.push(format!("{remedy} it misses the input by {base_edges:.2} base edges somewhere"));
        }
        if self.certified.as_ref().is_none_or(|(best, _)| verdict > *best) {
            self.certified = Some((verdict, result));
        }
    }

    /// Takes a failure; returns it where no other base mesh can help.
    pub(crate) fn fail(&mut self, remedy: Remedy, error: Error) -> Result<(), Error> {
        if !matches!(error, Error::NotCertified(_) | Error::Folded { .. } | Error::Base(_)) {
            return Err(error);
        }
        self.warnings.push(format!("{remedy} it was tried and failed: {error}"));
        self.first_failure.get_or_insert(error);
        Ok(())
    }

    /// The best result with the warnings of all tries, or the first failure.
    pub(crate) fn end(self) -> Result<(T, Vec<String>), Error> {
        match self.certified {
            Some((_, result)) => Ok((result, self.warnings)),
            None => Err(self.first_failure.unwrap_or(Error::NotCertified("nothing was tried".into()))),
        }
    }
}
