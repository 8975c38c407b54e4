//! Arguments are checked before anything is indexed with them.

use crate::{BaseError, BaseOptions};
use mesh_core::Id as _;
use region_map::{CellArc, Cells, Sites, Sizing, Surface};

/// More base vertices than this are refused: the memory that they take is beyond any use.
const MOST_VERTICES: usize = 10_000_000;
/// More rounds than this are refused: after ten the mesh hardly changes.
const MOST_ROUNDS: usize = 1000;

/// The options are in their ranges, and the sizing field has a positive length at every vertex of the surface.
pub(crate) fn check_wishes(surface: &Surface, sizing: &Sizing, options: &BaseOptions) -> Result<(), BaseError> {
    let wrong = |name, found: String, expected| Err(BaseError::Option { name, found, expected });
    if options.base_vertices > MOST_VERTICES {
        return wrong("base_vertices", options.base_vertices.to_string(), "10 million at most");
    }
    if options.rounds > MOST_ROUNDS {
        return wrong("rounds", options.rounds.to_string(), "1,000 at most");
    }
    if !(0.0..=1.0).contains(&options.max_shrunk) {
        return wrong("max_shrunk", options.max_shrunk.to_string(), "from 0 to 1");
    }
    let is_length = |x: &f64| x.is_finite() && *x > 0.0;
    if sizing.relative.len() != surface.mesh().n_vertices() || !sizing.relative.iter().all(is_length) {
        return Err(BaseError::OtherSurface("the sizing field"));
    }
    Ok(())
}

/// Cells and sites only name what is there.
pub(crate) fn check_sites(surface: &Surface, cells: &Cells, sites: &Sites) -> Result<(), BaseError> {
    let (n_vertices, n_faces) = (surface.mesh().n_vertices(), surface.mesh().n_faces());
    let is_arc = |a: &CellArc| {
        let n = a.vertices.len();
        n > 1
            && (a.halfedges.len() + 1, a.lengths.len()) == (n, n)
            && a.lengths.iter().all(|l| l.is_finite())
            && a.vertices.iter().all(|v| v.index() < n_vertices)
            && a.halfedges.iter().all(|h| h.index() < 3 * n_faces)
            && a.corners.iter().all(|c| c.index() < cells.corners.len())
            && a.on.is_none_or(|on| surface.network().arcs.get(on.arc).is_some())
    };
    let are_cells = cells.corners.iter().all(|v| v.index() < n_vertices)
        && cells.arcs.iter().all(is_arc)
        && cells.patches.iter().all(|p| {
            let border = p.border.iter().all(|(a, _)| a.index() < cells.arcs.len());
            border && !p.faces.is_empty() && p.faces.iter().all(|f| f.index() < n_faces)
        });
    if !are_cells {
        return Err(BaseError::OtherSurface("a cell"));
    }
    let are_sites = (sites.on_arcs.len(), sites.in_patches.len()) == (cells.arcs.len(), cells.patches.len())
        && sites.on_arcs.iter().flatten().all(|t| t.is_finite())
        && sites.in_patches.iter().flatten().all(|p| p.face.index() < n_faces && p.barycentric.is_finite());
    if are_sites { Ok(()) } else { Err(BaseError::OtherSurface("a site")) }
}
