//! The state of a search, the flips, and how an edit is tried and carried out.

use super::ReconnectOptions;
use super::Reconnected;
use super::coarse::{Change, Coarse, FaceIndex};
use super::exchange::Site;
use super::flip::flip;
use super::part::{RelaxedPart, relaxed};
use crate::ShapeOptions;
use mesh_core::{Id as _, VertexId};
use rayon::prelude::*;
use region_map::{BaseEdit, Sizing};
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

/// Before an edit is tried with all that is around it, it is looked at with the next faces alone and so many steps; where the energy has
/// grown by more than this then, it is left. With .5 for flips half of them were missed on rocker arms, with 1.5 hardly any.
const LOOK_STEPS: usize = 2;
const FLIP_LOSS: f64 = 1.5;
const SITE_LOSS: f64 = 2.0;

/// A search under way.
pub(super) struct Search<'a, F> {
    pub(super) coarse: Coarse<'a>,
    pub(super) sizing: &'a Sizing,
    pub(super) options: &'a ReconnectOptions,
    /// Carries edits out in the base mesh.
    edit_base: F,
    pub(super) found: Reconnected,
    /// Tries at most.
    most_tries: usize,
    /// Numbers of vertices that were put in, as the edits have them.
    numbers: FxHashMap<VertexId, VertexId>,
    n_numbers: usize,
    /// Numbers of middles that are given away.
    pub(super) n_middles: usize,
    /// Counts the edits; and when each face was last changed.
    clock: usize,
    changed: Vec<usize>,
    /// Splits and removals, as far as they were rated.
    pub(super) rated: BTreeMap<Site, Trial>,
}

/// An edit that was tried.
pub(super) struct Trial {
    /// By how much the energy falls.
    pub(super) gain: f64,
    /// The faces that were relaxed with it, in rising order.
    pub(super) region: Vec<FaceIndex>,
    change: Change,
    relaxed: RelaxedPart,
    /// What the clock showed.
    at: usize,
}

impl<'a, F: FnMut(&BaseEdit) -> bool + Sync> Search<'a, F> {
    pub(super) fn new(coarse: Coarse<'a>, sizing: &'a Sizing, options: &'a ReconnectOptions, edit_base: F) -> Self {
        let found = Reconnected { energy: [coarse.costs.iter().sum(); 2], ..Default::default() };
        Self {
            most_tries: options.tries * coarse.edges().len(),
            n_numbers: coarse.vertices().last().map_or(0, |v| v.index() + 1),
            changed: vec![0; coarse.faces.len()],
            n_middles: coarse.placed.len(),
            numbers: FxHashMap::default(),
            rated: BTreeMap::new(),
            clock: 0,
            coarse,
            sizing,
            options,
            edit_base,
            found,
        }
    }

    pub(super) fn is_tired(&self) -> bool {
        self.found.tries >= self.most_tries
    }

    /// Tries flips of some edges, then of those near what was flipped, until none gains.
    pub(super) fn flip_all(&mut self, mut edges: Vec<[VertexId; 2]>) {
        while !edges.is_empty() && !self.is_tired() {
            self.found.tries += edges.len();
            let gain = |&e: &[VertexId; 2]| Some((e, self.tried(flip(&self.coarse, e)?)?));
            let trials: Vec<_> = edges.par_iter().filter_map(gain).collect();
            let mut trials: Vec<_> = trials.into_iter().filter(|t| t.1.gain > self.options.least_gain).collect();
            trials.sort_by(|a, b| b.1.gain.total_cmp(&a.1.gain).then(a.0.cmp(&b.0)));
            let (mut near, mut corners) = (Vec::new(), Vec::new());
            for (edge, trial) in trials {
                if self.holds(&trial) {
                    corners.extend(self.carry_out(trial).into_iter().flatten());
                } else {
                    near.push(edge);
                }
            }
            edges = self.near(&corners, near);
        }
    }

    /// Relaxes a change with what is around it.
    pub(super) fn tried(&self, change: Change) -> Option<Trial> {
        if self.is_hopeless(&change) {
            return None;
        }
        let (relaxed, region) = (1..=self.options.rings).rev().find_map(|rings| {
            let region = self.coarse.around(&change.corners, rings);
            Some((relaxed(&self.coarse, &region, &change, &self.options.shape)?, region))
        })?;
        let gain = self.coarse.cost(&region) - relaxed.costs.iter().sum::<f64>();
        Some(Trial { gain, region, change, relaxed, at: self.clock })
    }

    /// A quick look with the next faces only: does the energy grow by much?
    fn is_hopeless(&self, change: &Change) -> bool {
        let most_loss = if matches!(change.edit, BaseEdit::Flip(_)) { FLIP_LOSS } else { SITE_LOSS };
        let region = self.coarse.around(&change.corners, 1);
        let quick = ShapeOptions { steps: LOOK_STEPS, untangling_steps: LOOK_STEPS, ..self.options.shape.clone() };
        let looked = relaxed(&self.coarse, &region, change, &quick);
        looked.is_some_and(|r| r.costs.iter().sum::<f64>() > self.coarse.cost(&region) + most_loss)
    }

    /// Is all as it was when the edit was tried?
    pub(super) fn holds(&self, trial: &Trial) -> bool {
        trial.region.iter().all(|&f| self.changed[f] <= trial.at)
    }

    /// Carries an edit out, first in the base mesh. Returns the corners of the faces that come; `None` where the base mesh refuses.
    pub(super) fn carry_out(&mut self, trial: Trial) -> Option<Vec<VertexId>> {
        let Trial { gain, region, change, relaxed, .. } = trial;
        let edit = self.numbered(&change.edit);
        if !(self.edit_base)(&edit) {
            return None;
        }
        // The first face that a split makes has the new vertex as its second corner.
        if let (BaseEdit::Split(_), Some(face)) = (&edit, change.new.first()) {
            self.numbers.insert(face.corners[1], VertexId::new(self.n_numbers));
            self.n_numbers += 1;
        }
        self.found.edits.push(edit);
        self.found.energy[1] -= gain;
        self.coarse.apply(&region, &change, &relaxed);
        self.clock += 1;
        self.changed.resize(self.coarse.faces.len(), self.clock);
        region.iter().for_each(|&f| self.changed[f] = self.clock);
        Some(change.new.iter().flat_map(|f| f.corners).collect())
    }

    /// An edit with the vertices that were put in numbered as [`BaseEdit`] says.
    fn numbered(&self, edit: &BaseEdit) -> BaseEdit {
        let number = |v: VertexId| self.numbers.get(&v).copied().unwrap_or(v);
        match edit {
            BaseEdit::Flip(e) => BaseEdit::Flip(e.map(number)),
            BaseEdit::Split(e) => BaseEdit::Split(e.map(number)),
            BaseEdit::Remove { vertex, filling } => {
                BaseEdit::Remove { vertex: number(*vertex), filling: filling.iter().map(|t| t.map(number)).collect() }
            }
        }
    }

    /// Some edges, and all of the faces at some vertices, each once.
    pub(super) fn near(&self, corners: &[VertexId], mut edges: Vec<[VertexId; 2]>) -> Vec<[VertexId; 2]> {
        edges.extend(self.coarse.edges_of(self.coarse.around(corners, 1)));
        edges.sort_unstable();
        edges.dedup();
        edges
    }
}
