//! Better connectivity for the base mesh, by what it can be relaxed to.

use crate::rating::relaxed_once;
use crate::{Error, Options};
use mesh_core::Topology;
use region_map::{BaseMesh, Surface};

/// The base mesh with the edits that lower the energy of its relaxed first subdivision, and a map of its own; `None` where none does.
pub(crate) fn searched(surface: &Surface, base: &BaseMesh, options: &Options) -> Result<Option<BaseMesh>, Error> {
    let relaxed = relaxed_once(surface, base, options)?;
    let topology = Topology::new(relaxed.mesh.faces(), relaxed.mesh.n_vertices())?;
    let found = relax::reconnect(surface, &topology, &relaxed.map, &Default::default())?;
    if found.edits.is_empty() {
        return Ok(None);
    }
    let base = basemesh::edited(surface, base.clone(), &found.edits)?;
    // As in all other places the map of the edits is one, too.
    Ok(Some(trace_base::retrace(surface, &base).unwrap_or(base)))
}
