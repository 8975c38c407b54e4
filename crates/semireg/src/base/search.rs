//! Better connectivity for a base mesh, by what it can be relaxed to.

use super::rating::{rate, relaxed_once};
use crate::{Error, Options};
use basemesh::Replay;
use region_map::{BaseMesh, Sizing, Surface};
use relax::Relaxed;
use std::sync::Arc;

/// A base mesh of more faces is not searched: it would take minutes, and it has more vertices than anybody asks for.
const MOST_FACES: usize = 6_000;

/// The search for a better base mesh, from its relaxed first subdivision.
pub(super) struct Search {
    sizing: Arc<Sizing>,
    relaxed: Relaxed,
    /// What the base mesh promises as it is.
    pub(super) rating: f64,
}

/// What a search found.
pub(super) struct Found {
    /// A better base mesh; `None` where there is none.
    pub(super) base: Option<BaseMesh>,
    /// Faults of ours on the way: the base mesh is as it was before them.
    pub(super) faults: Vec<String>,
}

impl Search {
    /// Rates a base mesh as it is. Fails where it cannot be subdivided, projected or relaxed.
    pub(super) fn new(
        surface: &Surface,
        sizing: Arc<Sizing>,
        base: &BaseMesh,
        asked: usize,
        options: &Options,
    ) -> Result<Self, Error> {
        let relaxed = relaxed_once(surface, base, options)?;
        let rating = rate(surface, base, &relaxed, asked);
        Ok(Self { sizing, relaxed, rating })
    }

    /// Searches edits that lower the energy of the relaxed first subdivision. What they lead to is better if it is rated higher.
    pub(super) fn run(&self, surface: &Surface, base: &BaseMesh, asked: usize, options: &Options) -> Found {
        if base.mesh().n_faces() > MOST_FACES {
            return Found { base: None, faults: Vec::new() };
        }
        self.edited(surface, base, asked, options).unwrap_or_else(|e| {
            let told = format!("the search for better connectivity failed: {}", e.with_request());
            Found { base: None, faults: vec![told] }
        })
    }

    fn edited(&self, surface: &Surface, base: &BaseMesh, asked: usize, options: &Options) -> Result<Found, Error> {
        let mut replay = Replay::new(surface, base.clone())?;
        let domain = &self.relaxed.domain;
        let edits = reconnect::reconnect(surface, domain, &self.sizing, &Default::default(), |edit| replay.edit(edit))?.edits;
        if edits.is_empty() {
            return Ok(Found { base: None, faults: Vec::new() });
        }
        let (base, faults) = retraced(surface, replay.finish()?);
        let relaxed = relaxed_once(surface, &base, options)?;
        let is_better = rate(surface, &base, &relaxed, asked) > self.rating;
        Ok(Found { base: is_better.then_some(base), faults })
    }
}

/// The base mesh with a map of its own instead of the history of its edits, which distorts. Where edges cannot be traced, that history still
/// is a map; it is told.
pub(super) fn retraced(surface: &Surface, base: BaseMesh) -> (BaseMesh, Vec<String>) {
    match trace_base::retrace(surface, &base) {
        Ok(traced) => (traced, Vec::new()),
        Err(reason) => {
            let told = format!("the base mesh keeps the map of its edits, which could not be traced anew: {reason}");
            (base, vec![told])
        }
    }
}
