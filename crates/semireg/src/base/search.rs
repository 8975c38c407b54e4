//! Better connectivity for a base mesh, by what it can be relaxed to.

use super::rating::{rate, relaxed_once};
use crate::{Error, Options};
use basemesh::Replay;
use region_map::{BaseEdit, BaseMesh, Sizing, Surface};
use relax::Relaxed;

/// A base mesh of more faces is not searched: it would take minutes, and it has more vertices than anybody asks for.
const MOST_FACES: usize = 6_000;

/// A base mesh, and what it promises.
pub(super) struct Rated {
    pub(super) base: BaseMesh,
    pub(super) rating: f64,
    /// The mean quality (AR) of its first subdivision, relaxed.
    pub(super) quality: f64,
    /// That subdivision.
    relaxed: Relaxed,
}

impl Rated {
    /// Rates a base mesh. Fails where it cannot be subdivided, projected or relaxed.
    pub(super) fn new(surface: &Surface, base: BaseMesh, asked: usize, options: &Options) -> Result<Self, Error> {
        let relaxed = relaxed_once(surface, &base, options)?;
        let (rating, quality) = (rate(surface, &base, &relaxed, asked), relaxed.report.end.ar_mean);
        Ok(Self { base, rating, quality, relaxed })
    }
}

/// The base mesh after edits that lower the energy of its relaxed first subdivision, if that is rated higher; and what went wrong on the way,
/// which is our fault: there still is the base mesh as it was.
pub(super) fn searched(
    surface: &Surface,
    sizing: &Sizing,
    before: Rated,
    asked: usize,
    options: &Options,
) -> (Rated, Vec<String>) {
    if before.base.mesh().n_faces() > MOST_FACES {
        return (before, Vec::new());
    }
    match found(surface, sizing, &before, asked, options) {
        Ok(Some((found, faults))) if found.rating > before.rating => (found, faults),
        Ok(found) => (before, found.map_or(Vec::new(), |(_, faults)| faults)),
        Err(e) => (before, vec![format!("the search for better connectivity failed: {}", e.with_request())]),
    }
}

/// The base mesh after the edits that the search finds, with a map of its own, and faults on the way; `None` where it finds none.
fn found(
    surface: &Surface,
    sizing: &Sizing,
    before: &Rated,
    asked: usize,
    options: &Options,
) -> Result<Option<(Rated, Vec<String>)>, Error> {
    let mut replay = Replay::new(surface, before.base.clone())?;
    let carry_out = |edit: &BaseEdit| replay.edit(edit);
    let edits = reconnect::reconnect(surface, &before.relaxed.domain, sizing, &Default::default(), carry_out)?.edits;
    if edits.is_empty() {
        return Ok(None);
    }
    let (base, faults) = retraced(surface, replay.finish()?);
    Ok(Some((Rated::new(surface, base, asked, options)?, faults)))
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
