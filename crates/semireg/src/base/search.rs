//! Better connectivity for a base mesh, by what it can be relaxed to.

use super::rating::{rate, relaxed_once};
use crate::{Error, Options};
use basemesh::Replay;
use region_map::{BaseMesh, Sizing, Surface};
use relax::Relaxed;

/// A base mesh of more faces is not searched: it would take minutes, and it has more vertices than anybody asks for.
const MOST_FACES: usize = 6_000;

/// A base mesh after the search, and what it promises.
pub(super) struct Searched {
    pub(super) rating: f64,
    /// The mean quality (AR) of its first subdivision, relaxed.
    pub(super) quality: f64,
    pub(super) base: BaseMesh,
    /// Faults of ours on the way: the base mesh is as it was before them.
    pub(super) faults: Vec<String>,
}

/// The base mesh after edits that lower the energy of its relaxed first subdivision, if that is rated higher. Fails where the base mesh
/// cannot be subdivided, projected or relaxed.
pub(super) fn searched(
    surface: &Surface,
    sizing: &Sizing,
    base: BaseMesh,
    asked: usize,
    options: &Options,
) -> Result<Searched, Error> {
    let relaxed = relaxed_once(surface, &base, options)?;
    let before = rated(surface, base, &relaxed, asked, Vec::new());
    if before.base.mesh().n_faces() > MOST_FACES {
        return Ok(before);
    }
    match found(surface, sizing, &before.base, &relaxed, asked, options) {
        Ok(Some(found)) if found.rating > before.rating => Ok(found),
        Ok(Some(found)) => Ok(Searched { faults: found.faults, ..before }),
        Ok(None) => Ok(before),
        // There still is the base mesh as it was.
        Err(e) => {
            Ok(Searched { faults: vec![format!("the search for better connectivity failed: {}", e.with_request())], ..before })
        }
    }
}

/// The base mesh after the edits that the search finds, with a map of its own; `None` where it finds none.
fn found(
    surface: &Surface,
    sizing: &Sizing,
    base: &BaseMesh,
    relaxed: &Relaxed,
    asked: usize,
    options: &Options,
) -> Result<Option<Searched>, Error> {
    let mut replay = Replay::new(surface, base.clone())?;
    let edits = reconnect::reconnect(surface, &relaxed.domain, sizing, &Default::default(), |edit| replay.edit(edit))?.edits;
    if edits.is_empty() {
        return Ok(None);
    }
    let (base, faults) = retraced(surface, replay.finish()?);
    let relaxed = relaxed_once(surface, &base, options)?;
    Ok(Some(rated(surface, base, &relaxed, asked, faults)))
}

fn rated(surface: &Surface, base: BaseMesh, relaxed: &Relaxed, asked: usize, faults: Vec<String>) -> Searched {
    Searched { rating: rate(surface, &base, relaxed, asked), quality: relaxed.report.end.ar_mean, base, faults }
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
