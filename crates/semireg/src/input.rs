//! What the stages run on.

use crate::marked::with_marked_edges;
use crate::{Error, Options, StageSeconds};
use mesh_core::{Cleaned, Soup, equilateral_edge_length};
use refine::{RefineOptions, Refined};
use std::sync::Arc;

/// The mesh that the stages run on: cleaned and refined.
pub(crate) struct Input {
    pub(crate) cleaned: Arc<Cleaned>,
    pub(crate) working: Arc<Refined>,
}

/// Edges of the working mesh are at most this share of a base edge.
const LONGEST_EDGE: f64 = 0.5;
/// And at least this share where the shape lets them: a twenty-fifth of an edge of level 3. Measured, arcs that made a result fail: .001 to
/// .004 (mike_box, pyvi_42400, prus_extruder_idler).
const SHORTEST_EDGE: f64 = 5e-3;

impl Input {
    /// Cleans and refines a soup. `options` then mark the edges of the refined mesh.
    pub(crate) fn new(soup: &Soup, options: &mut Options, seconds: &mut StageSeconds) -> Result<Self, Error> {
        let cleaned = seconds.time("clean", || mesh_core::clean(soup, &options.clean))?;
        *options = with_marked_edges(&cleaned, options)?;
        let base_edge =
            equilateral_edge_length(cleaned.mesh.total_area(), options.wanted_base_vertices(cleaned.mesh.n_vertices()));
        let refine_options =
            RefineOptions { shortest_edge: SHORTEST_EDGE * base_edge, ..RefineOptions::new(LONGEST_EDGE * base_edge) };
        let marked = std::mem::take(&mut options.features.marked);
        let working = seconds.time("refine", || refine::refine(&cleaned.mesh, &cleaned.topology, &marked, &refine_options))?;
        options.features.marked.clone_from(&working.marked);
        Ok(Self { cleaned: Arc::new(cleaned), working: Arc::new(working) })
    }
}
