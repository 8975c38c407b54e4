//! Shape optimisation that never ends with less than it began with.

use crate::measured::Measured;
use crate::mend::Mender;
use crate::shape::optimise_shape;
use crate::{Quality, ShapeOptions};
use mesh_core::{FaceId, IdVec};

/// What the optimisation of a placement came to.
pub(crate) struct BestShape {
    pub(crate) measured: Measured,
    pub(crate) quality: Quality,
    /// Newton steps of all attempts.
    pub(crate) steps: usize,
}

/// The start with optimised shapes, or itself where it was better. Of its mean quality it may give up `slack`.
pub(crate) fn best_shape(
    mender: &Mender,
    targets: &IdVec<FaceId, f64>,
    start: Measured,
    slack: f64,
    options: &ShapeOptions,
) -> BestShape {
    let domain = mender.domain;
    let start_quality = Quality::of(&start, domain);
    let mut best = shaped_and_mended(mender, targets, start.clone(), options);
    if best.quality.inverted > 0 {
        // Untangling moves far; where it fails, the start may have been nearer to a sound mesh.
        let smooth_only = ShapeOptions { untangling_steps: 0, ..options.clone() };
        let other = shaped_and_mended(mender, targets, mender.mended(start.clone()), &smooth_only);
        let steps = best.steps + other.steps;
        best = if other.quality.is_better_than(&best.quality) { other } else { best };
        best.steps = steps;
    }
    let end_at_least = Quality { ar_mean: best.quality.ar_mean + slack, ..best.quality };
    if start_quality.is_better_than(&end_at_least) {
        best = BestShape { measured: start, quality: start_quality, ..best };
    }
    best
}

/// Shape optimisation, and then the mending of what it left folded.
fn shaped_and_mended(mender: &Mender, targets: &IdVec<FaceId, f64>, start: Measured, options: &ShapeOptions) -> BestShape {
    let (measured, steps) = optimise_shape(mender.domain, start, targets, options);
    let measured = mender.mended(measured);
    let quality = Quality::of(&measured, mender.domain);
    BestShape { measured, quality, steps }
}
