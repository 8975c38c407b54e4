//! Vertices that change places: one is taken away where it is worth least, one put in where it is worth most.

use crate::remove::removal;
use crate::search::Search;
use crate::split::{NEW_VERTICES, split};
use crate::trial::{Site, Trial};
use mesh_core::VertexId;
use rayon::prelude::*;
use region_map::BaseEdit;

/// Where the sizing field asks for less than this share of the full length no vertex is taken away: the model spot lost a limb
/// that way. Less lets more vertices move to where shapes need them.
const SPARE: f64 = 0.95;
/// A new vertex is only tried on edges whose two faces together exceed the least energy by more than this. Less tries more, and
/// takes longer.
const LEAST_WORTH: f64 = 1.0;

impl<F: FnMut(&BaseEdit) -> bool + Sync> Search<'_, F> {
    /// Takes vertices away and puts others in, as many, where both together gain. Returns the edges near by.
    pub(crate) fn exchange(&mut self) -> Vec<[VertexId; 2]> {
        self.rate_sites();
        let mut sites: Vec<(f64, Site)> = self.rated.iter().map(|(&s, t)| (t.gain, s)).collect();
        sites.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let (splits, removals): (Vec<Site>, Vec<Site>) = sites.into_iter().map(|s| s.1).partition(|s| matches!(s, Site::Edge(_)));
        let mut corners = Vec::new();
        for split in splits {
            while let Some(partner) = self.partner(split, &removals) {
                let Some(removed) = self.rated.remove(&partner).and_then(|trial| self.carry_out(trial)) else { continue };
                corners.extend(removed);
                let split = self.rated.remove(&split).and_then(|trial| self.carry_out(trial));
                corners.extend(split.into_iter().flatten());
            }
        }
        self.near(&corners, Vec::new())
    }

    /// The removal that is best together with a split, if both gain enough.
    fn partner(&self, split: Site, removals: &[Site]) -> Option<Site> {
        let split = self.rated.get(&split).filter(|t| self.holds(t))?;
        let is_apart = |t: &&Trial| t.region.iter().all(|f| split.region.binary_search(f).is_err());
        let mut open = removals.iter().filter_map(|s| Some((*s, self.rated.get(s)?)));
        let (site, trial) = open.find(|(_, t)| self.holds(t) && is_apart(t))?;
        (split.gain + trial.gain > self.options.least_exchange_gain).then_some(site)
    }

    /// Rates all splits and removals that are not, or not as things are now.
    fn rate_sites(&mut self) {
        let mut rated = std::mem::take(&mut self.rated);
        rated.retain(|_, t| self.holds(t));
        let is_worth = |e: &[VertexId; 2]| self.cost_beside(*e) > LEAST_WORTH;
        let edges = self.base.edges().into_iter().filter(is_worth).map(Site::Edge);
        let removable = self.base.vertices().filter(|&v| self.is_spare(v)).map(Site::Vertex);
        let mut sites: Vec<Site> = edges.chain(removable).filter(|s| !rated.contains_key(s)).collect();
        // Also those that need not be tried count: how long a search may take is said by the number of edges.
        self.found.tries += sites.len();
        let mut hopeless = std::mem::take(&mut self.hopeless);
        hopeless.retain(|_, h| self.is_unchanged(&h.region, h.at));
        sites.retain(|s| !hopeless.contains_key(s));
        // Splits that were rated before keep the numbers that they have.
        let first = self.n_middles;
        self.n_middles += NEW_VERTICES * sites.iter().filter(|s| matches!(s, Site::Edge(_))).count();
        let trial = |(i, &site): (usize, &Site)| {
            let change = match site {
                Site::Edge(e) => split(&self.base, e, first + NEW_VERTICES * i),
                Site::Vertex(v) => removal(&self.base, v),
            };
            Some((site, self.tried(change?)?))
        };
        let new: Vec<_> = sites.par_iter().enumerate().filter_map(trial).collect();
        for (site, tried) in new {
            match tried {
                Ok(trial) => drop(rated.insert(site, trial)),
                Err(loss) => drop(hopeless.insert(site, loss)),
            }
        }
        (self.rated, self.hopeless) = (rated, hopeless);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ReconnectOptions;
    use crate::editable_base::EditableBase;
    use crate::flip::flip;
    use region_map::{Domain, Sizing, Surface};
    use relax::parts::Whole;

    /// After an edit, what is remembered of a site is still what a new try of it finds.
    #[test]
    fn what_is_remembered_is_true() {
        let base = Domain::identity(&Surface::smooth(fixtures::uv_sphere(16)).unwrap());
        let surface = Surface::smooth(subdiv::subdivide(&base, 1).unwrap().domain.mesh).unwrap();
        let domain = Domain::identity(&surface);
        let (whole, options) = (Whole::new(&surface, &domain).unwrap(), ReconnectOptions::default());
        let base = EditableBase::new(&whole, &domain, &options.shape).unwrap();
        let sizing = Sizing::uniform(surface.mesh());
        let mut search = Search::new(base, &sizing, &options, surface.interrupt().clone(), |_| true);
        search.rate_sites();
        let mut edges = search.base.edges().into_iter();
        let trial = edges.find_map(|edge| search.tried(flip(&search.base, edge)?)?.ok());
        search.carry_out(trial.unwrap());
        let change = |site: &Site| match *site {
            Site::Edge(edge) => split(&search.base, edge, search.n_middles),
            Site::Vertex(v) => removal(&search.base, v),
        };
        let tried = |site: &Site| change(site).and_then(|change| search.tried(change));
        let hold: Vec<&Site> =
            search.hopeless.iter().filter(|(_, h)| search.is_unchanged(&h.region, h.at)).map(|h| h.0).collect();
        assert!(hold.iter().all(|site| matches!(tried(site), Some(Err(_)))));
        let gain = |site: &Site| Some(tried(site)?.ok()?.gain);
        assert!(search.rated.iter().filter(|(_, t)| search.holds(t)).all(|(site, t)| gain(site) == Some(t.gain)));
        let n = search.hopeless.len();
        assert!(!hold.is_empty() && hold.len() < n, "{} of {n} hold", hold.len());
    }
}
