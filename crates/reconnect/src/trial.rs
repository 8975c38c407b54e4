//! Edits that were tried: estimated at first, and in earnest where that promises something.

use crate::ReconnectOptions;
use crate::change::Change;
use crate::editable_base::{EditableBase, FaceIndex};
use crate::region::{RelaxedRegion, relaxed};
use mesh_core::VertexId;
use region_map::BaseEdit;
use relax::ShapeOptions;
use relax::parts::Freedom;

/// Steps of an estimate. More find more of the edits that gain in the end, and cost time for all that don't.
const ESTIMATE_STEPS: usize = 2;
/// A flip that loses more than this by its estimate is given up. Less saves time and misses flips: with .5 half of them were missed on rocker
/// arms, with 1.5 hardly any.
const MOST_LOSS_OF_FLIP: f64 = 1.5;
/// The same for a split or a removal, which is judged together with its partner later.
const MOST_LOSS_OF_SITE: f64 = 2.0;

/// What a split's new faces may cost before anything moves, in costs of those that go (each of these counted with [`SOUND`] more). Less
/// saves more estimates. Measured on seven models: all splits that are worth their vertex cost less, and half of the others.
const SPLIT_AT_START: f64 = 6.7;
/// A flip that makes valences more irregular is not estimated where its new faces cost more than this before anything moves, and the faces at
/// its corners less than [`CALM`] now: there is little to gain. Less saves more estimates, and misses flips. Measured on five models: 2 to
/// 63 % are saved, and all but .01 % of what flips gain is found.
const FLIP_AT_START: f64 = 12.0;
/// See [`FLIP_AT_START`].
const CALM: f64 = 5.0;
/// The cost that sound faces count with.
const SOUND: f64 = 1.0;
/// What the faces that fill the hole of a removed vertex may cost before anything moves, beyond those that go. Measured: all
/// removals that an estimate does not rule out cost no more, and 70 % of the others.
const REMOVAL_AT_START: f64 = 21.0;

/// Where a vertex could be put in or taken away.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Site {
    Edge([VertexId; 2]),
    Vertex(VertexId),
}

/// An edit, estimated: relaxed a little with the next faces alone.
pub(crate) struct Estimate {
    pub(crate) change: Change,
    /// By how much the energy falls, about. Nothing is known where the next faces are no manifold by themselves: 0.
    pub(crate) gain: f64,
    /// The next faces, in rising order.
    pub(crate) region: Vec<FaceIndex>,
    /// What the clock of the search showed.
    pub(crate) at: usize,
}

/// An edit that was tried in earnest.
pub(crate) struct Trial {
    /// By how much the energy falls.
    pub(crate) gain: f64,
    /// The faces that were relaxed with it, in rising order.
    pub(crate) region: Vec<FaceIndex>,
    pub(crate) change: Change,
    pub(crate) relaxed: RelaxedRegion,
    /// What the clock of the search showed.
    pub(crate) at: usize,
}

impl Estimate {
    /// Estimates a change at this time.
    pub(crate) fn new(base: &EditableBase, change: Change, options: &ReconnectOptions, at: usize) -> Self {
        let region = base.around(&change.corners, 1);
        let before = base.cost(&region);
        let gain = if is_hopeless_at_start(base, &change, &options.shape) {
            f64::NEG_INFINITY
        } else {
            let few = ShapeOptions { steps: ESTIMATE_STEPS, untangling_steps: ESTIMATE_STEPS, ..options.shape.clone() };
            relaxed(base, &region, &change, &few).map_or(0.0, |relaxed| before - relaxed.costs.iter().sum::<f64>())
        };
        Self { change, gain, region, at }
    }

    /// Whether it is worth a trial.
    pub(crate) fn is_promising(&self) -> bool {
        let most_loss = if matches!(self.change.edit, BaseEdit::Flip(_)) { MOST_LOSS_OF_FLIP } else { MOST_LOSS_OF_SITE };
        self.gain >= -most_loss
    }
}

/// Whether the faces that come cost so much more than those that are there that no estimate is needed.
fn is_hopeless_at_start(base: &EditableBase, change: &Change, options: &ShapeOptions) -> bool {
    let old = || base.cost(&change.old);
    let new = || change.cost_at_start(base, options);
    match change.edit {
        // What is known already is asked first.
        BaseEdit::Flip(_) => {
            let at_corners: f64 = change.corners.iter().map(|&v| base.cost(&base.stars[v])).sum();
            at_corners < CALM && makes_irregular(base, &change.corners) && new() > FLIP_AT_START
        }
        BaseEdit::Split(_) => new() + SOUND > SPLIT_AT_START * (old() + SOUND),
        BaseEdit::Remove { .. } => new() > old() + REMOVAL_AT_START,
    }
}

/// Whether a flip takes the valences inside sheets farther away from six: those of the first two corners fall, those of the others rise.
fn makes_irregular(base: &EditableBase, corners: &[VertexId]) -> bool {
    let change = |(&v, change): (&VertexId, i64)| match base.freedoms[v] {
        Freedom::Sheet => {
            let excess = base.stars[v].len() as i64 - 6;
            (excess + change).pow(2) - excess.pow(2)
        }
        _ => 0,
    };
    corners.iter().zip([-1, -1, 1, 1]).map(change).sum::<i64>() > 0
}

impl Trial {
    /// Relaxes a change with what is around it. `None` where that is no manifold.
    pub(crate) fn new(base: &EditableBase, change: Change, options: &ReconnectOptions, at: usize) -> Option<Self> {
        let (relaxed, region) = (1..=options.rings).rev().find_map(|rings| {
            let region = base.around(&change.corners, rings);
            Some((relaxed(base, &region, &change, &options.shape)?, region))
        })?;
        let gain = base.cost(&region) - relaxed.costs.iter().sum::<f64>();
        Some(Self { gain, region, change, relaxed, at })
    }
}
