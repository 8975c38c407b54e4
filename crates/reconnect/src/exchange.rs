//! Vertices that change places: one is taken away where it is worth least, one put in where it is worth most.

use crate::remove::removal;
use crate::search::Search;
use crate::split::{NEW_VERTICES, split};
use crate::trial::{Estimate, Site, Trial};
use mesh_core::VertexId;
use rayon::prelude::*;
use region_map::BaseEdit;
use std::collections::{BTreeMap, BTreeSet};

/// Where the sizing field asks for less than this share of the full length no vertex is taken away: the model spot lost a limb
/// that way. Less lets more vertices move to where shapes need them.
const SPARE: f64 = 0.95;
/// A new vertex is only tried on edges whose two faces together exceed the least energy by more than this. Less tries more, and
/// takes longer.
const LEAST_WORTH: f64 = 1.0;

/// By so much more than its estimate a trial gains, about, as farther faces make way too. Measured on seven models: .7 more for splits and 1 for
/// removals, 90 % of all between 0 and 1.6. More tries pairs that gain too little; with 1.2 some were missed, with 1.8 none (four parts).
const BEYOND_ESTIMATE: f64 = 1.8;

impl<F: FnMut(&BaseEdit) -> bool + Sync> Search<'_, F> {
    /// Takes vertices away and puts others in, as many, where both together gain. Returns the edges near by.
    pub(crate) fn exchange(&mut self) -> Vec<[VertexId; 2]> {
        self.estimate_sites();
        self.try_sites();
        let sites = self.tried.iter().map(|(&site, trial)| (trial.gain, site));
        let [splits, removals] = by_gain(sites.collect());
        let mut corners = Vec::new();
        for (_, split) in splits {
            while let Some(partner) = self.partner(split, &removals) {
                let Some(removed) = self.tried.remove(&partner).and_then(|trial| self.carry_out(trial)) else { continue };
                corners.extend(removed);
                let split = self.tried.remove(&split).and_then(|trial| self.carry_out(trial));
                corners.extend(split.into_iter().flatten());
            }
        }
        self.near(&corners, Vec::new())
    }

    /// The removal that is best together with a split, if both gain enough.
    fn partner(&self, split: Site, removals: &[(f64, Site)]) -> Option<Site> {
        let split = self.tried.get(&split).filter(|t| self.holds(t))?;
        let is_apart = |t: &&Trial| t.region.iter().all(|f| split.region.binary_search(f).is_err());
        let mut open = removals.iter().filter_map(|(_, s)| Some((*s, self.tried.get(s)?)));
        let (site, trial) = open.find(|(_, t)| self.holds(t) && is_apart(t))?;
        (split.gain + trial.gain > self.options.least_exchange_gain).then_some(site)
    }

    /// Estimates all splits and removals that were not estimated before. What a site was estimated to gain holds, about, as long as it is there: only
    /// before it is tried it is asked for anew.
    fn estimate_sites(&mut self) {
        let is_worth = |e: &[VertexId; 2]| self.cost_beside(*e) > LEAST_WORTH;
        let edges = self.base.edges().into_iter().filter(is_worth).map(Site::Edge);
        let removable = self.base.vertices().filter(|&v| self.is_spare(v)).map(Site::Vertex);
        let sites: BTreeSet<Site> = edges.chain(removable).collect();
        self.estimated.retain(|site, _| sites.contains(site));
        let new: Vec<Site> = sites.into_iter().filter(|site| !self.estimated.contains_key(site)).collect();
        self.estimate(&new);
    }

    /// Estimates splits and removals as things are now. Those that cannot be done are forgotten.
    fn estimate(&mut self, sites: &[Site]) {
        self.found.tries += sites.len();
        // Splits that were estimated before keep the numbers that they have.
        let first = self.n_middles;
        self.n_middles += NEW_VERTICES * sites.len();
        let estimate = |(i, &site): (usize, &Site)| {
            let change = match site {
                Site::Edge(e) => split(&self.base, e, first + NEW_VERTICES * i),
                Site::Vertex(v) => removal(&self.base, v),
            };
            (site, change.map(|change| Estimate::new(&self.base, change, self.options, self.clock)))
        };
        let estimates: Vec<_> = sites.par_iter().enumerate().map(estimate).collect();
        for (site, estimate) in estimates {
            match estimate {
                Some(estimate) => drop(self.estimated.insert(site, estimate)),
                None => drop(self.estimated.remove(&site)),
            }
        }
    }

    /// Tries the splits and removals that may come to be done: the best of both, as long as both together are expected to gain enough.
    fn try_sites(&mut self) {
        let mut tried = std::mem::take(&mut self.tried);
        tried.retain(|_, t| self.holds(t));
        loop {
            let new: Vec<Site> = self.expected(&tried).into_iter().filter(|site| !tried.contains_key(site)).collect();
            if new.is_empty() {
                break;
            }
            let is_old = |site: &Site| self.estimated.get(site).is_none_or(|e| !self.is_unchanged(&e.region, e.at));
            let old: Vec<Site> = new.iter().copied().filter(is_old).collect();
            if !old.is_empty() {
                self.estimate(&old);
                continue;
            }
            let trial = |site: &Site| {
                let change = self.estimated.get(site)?.change.clone();
                Trial::new(&self.base, change, self.options, self.clock)
            };
            let trials: Vec<Option<Trial>> = new.par_iter().map(trial).collect();
            for (site, trial) in new.into_iter().zip(trials) {
                match trial {
                    Some(trial) => drop(tried.insert(site, trial)),
                    None => drop(self.estimated.remove(&site)),
                }
            }
        }
        self.tried = tried;
    }

    /// The splits and removals that would be done if each gained what it is expected to.
    fn expected(&self, tried: &BTreeMap<Site, Trial>) -> Vec<Site> {
        let gain = |(&site, estimate): (&Site, &Estimate)| {
            (tried.get(&site).map_or(estimate.gain + BEYOND_ESTIMATE, |trial| trial.gain), site)
        };
        let [splits, removals] = by_gain(self.estimated.iter().filter(|(_, e)| e.is_promising()).map(gain).collect());
        let pairs = splits.into_iter().zip(removals);
        let expected = pairs.take_while(|(split, removal)| split.0 + removal.0 > self.options.least_exchange_gain);
        expected.flat_map(|(split, removal)| [split.1, removal.1]).collect()
    }

    /// May a vertex be taken away? Where the surface turns all are needed, which the first subdivision does not tell of.
    fn is_spare(&self, v: VertexId) -> bool {
        let mesh = self.base.whole.surface().mesh();
        self.sizing.at(mesh, self.base.placed[v].point()) >= SPARE
    }

    fn cost_beside(&self, [a, b]: [VertexId; 2]) -> f64 {
        let sides = [self.base.face_at(a, b), self.base.face_at(b, a)];
        sides.into_iter().flatten().map(|(f, _)| self.base.costs[f]).sum()
    }
}

/// Splits and removals, each from the one that gains most.
fn by_gain(mut sites: Vec<(f64, Site)>) -> [Vec<(f64, Site)>; 2] {
    sites.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let (splits, removals) = sites.into_iter().partition(|s| matches!(s.1, Site::Edge(_)));
    [splits, removals]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ReconnectOptions;
    use crate::editable_base::EditableBase;
    use crate::flip::flip;
    use mesh_core::Id as _;
    use region_map::{Domain, Sizing, Surface};
    use relax::parts::Whole;

    /// Runs a test on a search that begins on a sphere of 16 sides, where all edits are carried out.
    fn on_sphere(test: impl FnOnce(Search<'_, fn(&BaseEdit) -> bool>)) {
        let base = Domain::identity(&Surface::smooth(fixtures::uv_sphere(16)).unwrap());
        let surface = Surface::smooth(subdiv::subdivide(&base, 1).unwrap().domain.mesh).unwrap();
        let domain = Domain::identity(&surface);
        let (whole, options) = (Whole::new(&surface, &domain).unwrap(), ReconnectOptions::default());
        let base = EditableBase::new(&whole, &domain, &options.shape).unwrap();
        let sizing = Sizing::uniform(surface.mesh());
        test(Search::new(base, &sizing, &options, surface.interrupt().clone(), |_| true));
    }

    /// After an edit, what is remembered of a site is still what a new try of it finds.
    #[test]
    fn what_is_remembered_is_true() {
        on_sphere(|mut search| {
            search.estimate_sites();
            search.try_sites();
            let mut edges = search.base.edges().into_iter();
            let trial = edges.find_map(|edge| Trial::new(&search.base, flip(&search.base, edge)?, search.options, search.clock));
            search.carry_out(trial.unwrap());
            let change = |site: &Site| match *site {
                Site::Edge(edge) => split(&search.base, edge, search.n_middles),
                Site::Vertex(v) => removal(&search.base, v),
            };
            let estimate = |site| Estimate::new(&search.base, change(site).unwrap(), search.options, search.clock).gain;
            let hold: Vec<_> = search.estimated.iter().filter(|(_, e)| search.is_unchanged(&e.region, e.at)).collect();
            assert!(hold.iter().all(|(site, e)| estimate(site) == e.gain));
            let gain = |site| Trial::new(&search.base, change(site)?, search.options, search.clock).map(|t| t.gain);
            assert!(search.tried.iter().filter(|(_, t)| search.holds(t)).all(|(site, t)| gain(site) == Some(t.gain)));
            let n = search.estimated.len();
            assert!(!hold.is_empty() && hold.len() < n, "{} of {n} hold", hold.len());
        });
    }

    /// However often splits are estimated anew, no two of them number a new vertex alike: both may be done.
    #[test]
    fn new_vertices_have_numbers_of_their_own() {
        on_sphere(|mut search| {
            search.estimate_sites();
            let mut sites: Vec<Site> = search.estimated.keys().copied().collect();
            sites.reverse();
            search.estimate(&sites[..sites.len() / 2]);
            search.estimate(&sites[sites.len() / 2..]);
            let known = search.base.placed.len();
            let moved = search.estimated.values().flat_map(|estimate| estimate.change.moved.iter().map(|moved| moved.0));
            let mut new: Vec<VertexId> = moved.filter(|v| v.index() >= known).collect();
            let n = new.len();
            new.sort_unstable();
            new.dedup();
            assert!(n > 0 && new.len() == n, "{} of {n}", new.len());
            assert!(new.iter().all(|v| v.index() < search.n_middles));
        });
    }
}
