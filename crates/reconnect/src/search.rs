//! The state of a search, the flips, and how an edit is tried and carried out.

use crate::editable_base::{EditableBase, FaceIndex};
use crate::flip::flip;
use crate::trial::{Estimate, Site, Trial};
use crate::{ReconnectOptions, Reconnected};
use mesh_core::{Id as _, Interrupt, VertexId};
use rayon::prelude::*;
use region_map::{BaseEdit, Sizing};
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

/// A search under way.
pub(crate) struct Search<'a, F> {
    pub(crate) base: EditableBase<'a>,
    pub(crate) sizing: &'a Sizing,
    pub(crate) options: &'a ReconnectOptions,
    /// Carries edits out in the base mesh.
    carry_out_edit: F,
    pub(crate) found: Reconnected,
    /// Tries at most.
    most_tries: usize,
    /// Ends the search early.
    interrupt: Interrupt,
    /// Numbers of vertices that were put in, as the edits have them.
    numbers: FxHashMap<VertexId, VertexId>,
    n_numbers: usize,
    /// Numbers of middles that are given away.
    pub(crate) n_middles: usize,
    /// Counts the edits; and when each face was last changed.
    pub(crate) clock: usize,
    changed: Vec<usize>,
    /// Splits and removals that were estimated, some of them before things changed around them.
    pub(crate) estimated: BTreeMap<Site, Estimate>,
    /// Those of them that were tried, with all around them as it is now.
    pub(crate) tried: BTreeMap<Site, Trial>,
}

impl<'a, F: FnMut(&BaseEdit) -> bool + Sync> Search<'a, F> {
    pub(crate) fn new(
        base: EditableBase<'a>,
        sizing: &'a Sizing,
        options: &'a ReconnectOptions,
        interrupt: Interrupt,
        carry_out_edit: F,
    ) -> Self {
        let energy = base.costs.iter().sum();
        let found = Reconnected { energy_at_start: energy, energy_at_end: energy, ..Default::default() };
        Self {
            most_tries: options.tries.saturating_mul(base.edges().len()),
            n_numbers: base.vertices().last().map_or(0, |v| v.index() + 1),
            changed: vec![0; base.faces.len()],
            n_middles: base.placed.len(),
            numbers: FxHashMap::default(),
            estimated: BTreeMap::new(),
            tried: BTreeMap::new(),
            clock: 0,
            base,
            sizing,
            options,
            interrupt,
            carry_out_edit,
            found,
        }
    }

    /// Are all tries used up, or shall the search end?
    pub(crate) fn is_exhausted(&self) -> bool {
        self.found.tries >= self.most_tries || self.interrupt.is_set()
    }

    /// Tries flips of some edges, then of those near what was flipped, until none gains.
    pub(crate) fn flip_all(&mut self, mut edges: Vec<[VertexId; 2]>) {
        while !edges.is_empty() && !self.is_exhausted() {
            self.found.tries += edges.len();
            let trials: Vec<_> = edges.par_iter().filter_map(|&e| Some((e, self.tried_flip(e)?))).collect();
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

    /// A flip, tried where its estimate is promising. `None` where it is not, or cannot be done.
    pub(crate) fn tried_flip(&self, edge: [VertexId; 2]) -> Option<Trial> {
        let estimate = Estimate::new(&self.base, flip(&self.base, edge)?, self.options, self.clock);
        if !estimate.is_promising() {
            return None;
        }
        Trial::new(&self.base, estimate.change, self.options, self.clock)
    }

    /// Is all as it was when the edit was tried?
    pub(crate) fn holds(&self, trial: &Trial) -> bool {
        self.is_unchanged(&trial.region, trial.at)
    }

    /// Are some faces, and with them all their vertices, as they were at this time? An edit marks all faces that have a vertex in
    /// common with those that it changes, or one that it moves.
    pub(crate) fn is_unchanged(&self, region: &[FaceIndex], since: usize) -> bool {
        region.iter().all(|&f| self.changed[f] <= since)
    }

    /// Carries an edit out, first in the base mesh. Returns the corners of the faces that come; `None` where the base mesh
    /// refuses.
    pub(crate) fn carry_out(&mut self, trial: Trial) -> Option<Vec<VertexId>> {
        let Trial { gain, region, change, relaxed, .. } = trial;
        let edit = self.numbered(&change.edit);
        if !(self.carry_out_edit)(&edit) {
            return None;
        }
        // The first face that a split makes has the new vertex as its second corner.
        if let (BaseEdit::Split(_), Some(face)) = (&edit, change.new.first()) {
            self.numbers.insert(face.corners[1], VertexId::new(self.n_numbers));
            self.n_numbers += 1;
        }
        self.found.edits.push(edit);
        self.found.energy_at_end -= gain;
        relaxed.apply(&mut self.base, &region, &change);
        self.clock += 1;
        self.changed.resize(self.base.faces.len(), self.clock);
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
    pub(crate) fn near(&self, corners: &[VertexId], mut edges: Vec<[VertexId; 2]>) -> Vec<[VertexId; 2]> {
        edges.extend(self.base.edges_of(self.base.around(corners, 1)));
        edges.sort_unstable();
        edges.dedup();
        edges
    }
}
