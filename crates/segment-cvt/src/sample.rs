//! The stage: budget, sites on arcs, sites in patches.

use crate::arc_measure::ArcMeasure;
use crate::{Budget, CvtOptions, budget, candidates, lloyd};
use glam::DVec3;
use mesh_core::{Id, IdVec, SurfacePoint, TriMesh};
use rayon::prelude::*;
use region_map::{CellArcId, CellPatch, Cells, PatchId, Sites, Sizing, Surface};

/// Sites, and the budget that they were made by.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampled {
    /// The sites.
    pub sites: Sites,
    /// How many of each, and the edge length.
    pub budget: Budget,
}

/// Why there are no sites.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CvtError {
    /// The mesh has no area.
    #[error("the surface has no area to sample: all its triangles are degenerate")]
    NoArea,
}

/// Candidates for every inner site: with these, cells are known to about a tenth of their size.
const CANDIDATES_PER_SITE: usize = 100;

/// Chooses the sites of the base mesh: all corners, points on arcs at even steps of the sizing field, and relaxed points in patches.
///
/// The sizing field is one of this mesh. On arcs the spacing is in proportion to it; inside patches the sites are as many to an area
/// as its inverse square says.
///
/// Patches are independent: the same seed gives the same sites on any number of threads.
pub fn sample(surface: &Surface, cells: &Cells, sizing: &Sizing, options: &CvtOptions) -> Result<Sampled, CvtError> {
    let mesh = surface.mesh();
    if mesh.total_area() <= 0.0 {
        return Err(CvtError::NoArea);
    }
    let measures: IdVec<CellArcId, ArcMeasure> = cells.arcs.iter().map(|arc| ArcMeasure::new(arc, sizing)).collect();
    let budget = budget::budget(mesh, cells, &measures, sizing, options.base_vertices);
    let on_arcs: IdVec<CellArcId, Vec<f64>> = measures.enumerate().map(|(id, m)| m.even_steps(budget.segments[id])).collect();
    let in_patches: Vec<Vec<SurfacePoint>> = cells
        .patches
        .as_slice()
        .par_iter()
        .enumerate()
        .map(|(i, patch)| in_patch(mesh, cells, patch, &on_arcs, sizing, budget.inner[PatchId::new(i)], options))
        .collect();
    Ok(Sampled { sites: Sites { on_arcs, in_patches: IdVec::from_vec(in_patches) }, budget })
}

fn in_patch(
    mesh: &TriMesh,
    cells: &Cells,
    patch: &CellPatch,
    on_arcs: &IdVec<CellArcId, Vec<f64>>,
    sizing: &Sizing,
    n: usize,
    options: &CvtOptions,
) -> Vec<SurfacePoint> {
    if n == 0 {
        return Vec::new();
    }
    let border: Vec<DVec3> = patch
        .border
        .iter()
        .flat_map(|&(id, _)| {
            let arc = &cells.arcs[id];
            on_arcs[id].iter().copied().chain([0.0]).chain([arc.length()]).map(|t| arc.position(mesh, t))
        })
        .collect();
    let candidates = candidates::spread(mesh, &patch.faces, sizing, CANDIDATES_PER_SITE * (n + border.len() / 4), options.seed);
    lloyd::relaxed_sites(&candidates, &border, n, options.max_steps)
}
