//! The smallest result that keeps to a greatest error.

use super::search::{Search, can_size_help, greatest_error};
use crate::Error;
use crate::remeshed::Remeshed;

/// An error is kept by this factor: whoever measures it takes other points than we do.
const HELD: f64 = 0.95;
/// Triangles of the first try.
const FIRST: f64 = 4_000.0;
/// Triangles of results at least and at most.
const RANGE: [f64; 2] = [100.0, 2e6];
/// The smallest result is found to this factor of its triangles.
const FOUND: f64 = 1.4;
/// From try to try triangles change by these factors at least and at most, until one result is known that holds and one that does not.
const STEP: [f64; 2] = [1.5, 6.0];

impl Search<'_> {
    /// The smallest of the results tried that keeps to an error, a share of the diagonal.
    pub(super) fn within(&mut self, error: f64) -> Result<Remeshed, Error> {
        let mut holding: Option<Remeshed> = None;
        let mut nearest = f64::INFINITY;
        let mut bracket = Bracket::default();
        let mut next = Some(FIRST);
        while let Some(triangles) = next {
            let split = self.extent.split(triangles, self.levels(triangles));
            // Where curves set the base mesh, fewer vertices than that make the same result once more.
            if self.was_tried(split) {
                break;
            }
            let reached = match self.made(split, Some(error)) {
                Ok(remeshed) => {
                    let reached = greatest_error(&remeshed);
                    if reached <= HELD * error && holding.as_ref().is_none_or(|h| remeshed.mesh.n_faces() < h.mesh.n_faces()) {
                        holding = Some(remeshed);
                    }
                    reached
                }
                Err(failure) if can_size_help(&failure) => f64::INFINITY,
                Err(failure) => return Err(failure),
            };
            nearest = nearest.min(reached);
            next = bracket.next(triangles, reached / (HELD * error));
        }
        holding.ok_or(Error::NotWithin { error, nearest })
    }
}

/// Numbers of triangles between which the smallest result lies.
#[derive(Default)]
struct Bracket {
    /// The greatest one whose result did not hold.
    fails: Option<f64>,
    /// The least one whose result did.
    holds: Option<f64>,
}

impl Bracket {
    /// What to try after a number of triangles whose result has an error of `ratio` times the greatest one. `None` at the end.
    fn next(&mut self, triangles: f64, ratio: f64) -> Option<f64> {
        if ratio <= 1.0 {
            self.holds = Some(triangles);
        } else {
            self.fails = Some(triangles);
        }
        // The error of a smooth surface falls as triangles get more.
        let step = ratio.max(1.0 / ratio).clamp(STEP[0], STEP[1]);
        let [least, most] = RANGE;
        match (self.fails, self.holds) {
            (Some(fails), Some(holds)) => (holds > FOUND * fails).then_some((fails * holds).sqrt()),
            (Some(fails), None) => (fails < most).then_some((step * fails).min(most)),
            (None, Some(holds)) => (holds > least).then_some((holds / step).max(least)),
            (None, None) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Goal, Options, Target, remesh_to};
    use std::ops::ControlFlow;

    /// Whatever the least number is, one within 40 % above it is found in at most a dozen tries.
    #[test]
    fn the_smallest_that_holds_is_found() {
        for least in [30.0, 150.0, 3_999.0, 4_000.0, 4_001.0, 1e5, 1.9e6] {
            for power in [0.5, 1.0, 2.0] {
                let (mut bracket, mut next, mut tries) = (Bracket::default(), Some(FIRST), 0);
                while let Some(triangles) = next {
                    next = bracket.next(triangles, (least / triangles).powf(power));
                    tries += 1;
                }
                let holds = bracket.holds.unwrap();
                assert!(holds >= least && holds <= (FOUND * least).max(RANGE[0]) && tries <= 12, "{least} {holds} {tries}");
            }
        }
        let (mut bracket, mut next) = (Bracket::default(), Some(FIRST));
        while let Some(triangles) = next {
            next = bracket.next(triangles, f64::INFINITY);
        }
        assert_eq!((bracket.fails, bracket.holds), (Some(RANGE[1]), None));
    }

    /// A half of the error takes more triangles, on a sphere about twice as many.
    #[test]
    fn a_smaller_error_takes_more_triangles() {
        let soup = fixtures::icosphere(24).to_soup();
        let [coarse, fine] = [4e-3, 1e-3].map(|error| {
            let goal = Goal { target: Target::MaxError(error), levels: None };
            let remeshed = remesh_to(&soup, &goal, &Options::default(), &mut |_| ControlFlow::Continue(())).unwrap();
            assert!(greatest_error(&remeshed) <= error, "{:?}", remeshed.report.sizes);
            remeshed.mesh.n_faces()
        });
        assert!(fine > 2 * coarse, "{coarse} {fine}");
    }
}
