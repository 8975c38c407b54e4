//! Better connectivity for the base mesh, by what it can be relaxed to.

use super::rating::{rate, relaxed_once};
use crate::{Error, Options};
use basemesh::Replay;
use region_map::{BaseMesh, Sizing, Surface};
use relax::Relaxed;

/// A base mesh of more faces is not searched: it would take minutes, and it has more vertices than anybody asks for.
const MOST_FACES: usize = 6_000;

/// The base mesh after edits that lower the energy of its relaxed first subdivision, if that is rated higher, and its rating.
pub(super) fn searched(surface: &Surface, sizing: &Sizing, base: BaseMesh, asked: usize, options: &Options) -> (f64, BaseMesh) {
    let Ok(relaxed) = relaxed_once(surface, &base, options) else { return (f64::NEG_INFINITY, base) };
    let rating = rate(surface, &base, &relaxed, asked);
    if base.mesh().n_faces() > MOST_FACES {
        return (rating, base);
    }
    // Where the search fails there still is the base mesh.
    let Ok(Some(found)) = search(surface, sizing, &base, &relaxed) else { return (rating, base) };
    let Ok(relaxed) = relaxed_once(surface, &found, options) else { return (rating, base) };
    let its_rating = rate(surface, &found, &relaxed, asked);
    if its_rating > rating { (its_rating, found) } else { (rating, base) }
}

/// The base mesh after the edits that were found, with a map of its own; `None` where none was.
fn search(surface: &Surface, sizing: &Sizing, base: &BaseMesh, relaxed: &Relaxed) -> Result<Option<BaseMesh>, Error> {
    let mut replay = Replay::new(surface, base.clone())?;
    let found = reconnect::reconnect(surface, &relaxed.domain, sizing, &Default::default(), |edit| replay.edit(edit))?;
    if found.edits.is_empty() {
        return Ok(None);
    }
    let base = replay.finish()?;
    // As in all other places the map of the edits is one, too.
    Ok(Some(trace_base::retrace(surface, &base).unwrap_or(base)))
}
