//! The verb of this crate.

use crate::editable_base::EditableBase;
use crate::search::Search;
use crate::{ReconnectError, ReconnectOptions, Reconnected};
use mesh_core::TriMesh;
use region_map::{BaseEdit, Domain, Sizing, Surface};
use relax::parts::Whole;

/// Finds edits of a base mesh that lower the shape energy of its first subdivision: edges are flipped, and vertices are taken
/// away while as many are put in elsewhere.
///
/// `domain` is the base mesh subdivided once and relaxed. `carry_out` does each edit that is chosen in the base mesh itself;
/// where it cannot and returns false, the edit is not done. Vertices are taken away only where the sizing field, one length for
/// each vertex of the working mesh, does not ask for shorter edges. A removal comes just
/// before the split that makes up for it. The energy never grows, but where `carry_out` does a removal and refuses its split.
///
/// Fails when the domain does not fit the surface or was not subdivided once, when the sizing field is of another mesh, and for
/// an option out of its range.
pub fn reconnect(
    surface: &Surface,
    domain: &Domain,
    sizing: &Sizing,
    options: &ReconnectOptions,
    carry_out: impl FnMut(&BaseEdit) -> bool + Sync,
) -> Result<Reconnected, ReconnectError> {
    options.check()?;
    check_sizing(sizing, surface.mesh())?;
    let whole = Whole::new(surface, domain)?;
    let base = EditableBase::new(&whole, domain, &options.shape)?;
    let mut search = Search::new(base, sizing, options, surface.interrupt().clone(), carry_out);
    let mut near = search.base.edges();
    while !near.is_empty() && !search.is_exhausted() {
        search.flip_all(near);
        near = search.exchange();
    }
    Ok(search.found)
}

fn check_sizing(sizing: &Sizing, mesh: &TriMesh) -> Result<(), ReconnectError> {
    let (found, expected) = (sizing.relative.len(), mesh.n_vertices());
    if found != expected {
        return Err(ReconnectError::SizingOfAnotherMesh { found, expected });
    }
    match sizing.relative.enumerate().find(|(_, length)| !(**length > 0.0 && length.is_finite())) {
        Some((vertex, &length)) => Err(ReconnectError::Sizing { vertex, length }),
        None => Ok(()),
    }
}
