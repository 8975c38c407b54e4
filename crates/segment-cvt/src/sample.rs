//! The stage: budget, sites on arcs, sites in patches.

use crate::arc_measure::ArcMeasure;
use crate::{Budget, CvtOptions, budget, candidates, lloyd};
use glam::DVec3;
use mesh_core::{Id, IdVec, SurfacePoint, TriMesh, VertexId};
use rayon::prelude::*;
use region_map::{CellArc, CellArcId, CellPatch, Cells, PatchId, Sites, Sizing, Surface};

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
    #[error("the surface has no area to sample: all its triangles are degenerate, or so large that their area is no number")]
    NoArea,
    /// Cells or sizing field are of another mesh.
    #[error("{0} is not of this surface")]
    OtherMesh(&'static str),
    /// The sizing field has a value that no edge can have.
    #[error(
        "relative edge length {0} in the sizing field: all must be 1e-60 to 1e60, and the greatest at most a million times the least"
    )]
    Sizing(f64),
    /// More base vertices are asked for than can be made.
    #[error("{0} base vertices are too many to sample, at most 1,000,000")]
    TooMany(usize),
}

/// Candidates for every inner site: with these, cells are known to about a tenth of their size.
const CANDIDATES_PER_SITE: usize = 100;
/// A site on the border of a patch has only a part of its cell inside: so many of them get the candidates of one inner site. Fewer make sites
/// near the border a little more even, and every Lloyd step slower.
const BORDER_SITES_PER_SITE: usize = 4;
/// Base vertices at most: their candidates fill the memory of a large machine.
const MOST_VERTICES: usize = 1_000_000;
/// Relative edge lengths from one over this to this are numbers whose fourth powers are numbers.
const MOST_RELATIVE: f64 = 1e60;
/// The greatest relative edge length over the least at most: beyond it, counting of segments and sites fails.
const MOST_RATIO: f64 = 1e6;

/// Chooses the sites of the base mesh: all corners, points on arcs at even steps of the sizing field, and relaxed points in patches.
///
/// The sizing field is one of this mesh. On arcs the spacing is in proportion to it; inside patches the sites are as many to an area
/// as its inverse square says.
///
/// Fails where the surface has no area, cells or sizing field are of another mesh, a relative edge length is not above 0, or more than a
/// million base vertices are asked for. More are made than are asked for where the topology of the cells needs more.
///
/// Patches are independent: the same seed gives the same sites on any number of threads.
pub fn sample(surface: &Surface, cells: &Cells, sizing: &Sizing, options: &CvtOptions) -> Result<Sampled, CvtError> {
    let mesh = surface.mesh();
    check(mesh, cells, sizing, options)?;
    let measures: IdVec<CellArcId, ArcMeasure> = cells.arcs.iter().map(|arc| ArcMeasure::new(arc, sizing)).collect();
    let budget = budget::budget(mesh, cells, &measures, sizing, options.base_vertices);
    let on_arcs: IdVec<CellArcId, Vec<f64>> = measures.enumerate().map(|(id, m)| m.even_steps(budget.segments[id])).collect();
    let in_patches: Vec<Vec<SurfacePoint>> = cells
        .patches
        .as_slice()
        .par_iter()
        .enumerate()
        .map(|(i, patch)| match surface.interrupt().is_set() {
            true => Vec::new(),
            false => in_patch(mesh, cells, patch, &on_arcs, sizing, budget.inner[PatchId::new(i)], options),
        })
        .collect();
    Ok(Sampled { sites: Sites { on_arcs, in_patches: IdVec::from_vec(in_patches) }, budget })
}

fn check(mesh: &TriMesh, cells: &Cells, sizing: &Sizing, options: &CvtOptions) -> Result<(), CvtError> {
    let area = mesh.total_area();
    if !(area.is_finite() && area > 0.0) {
        return Err(CvtError::NoArea);
    }
    let has_vertex = |v: &VertexId| v.index() < mesh.n_vertices();
    let fits =
        |arc: &CellArc| arc.vertices.len() > 1 && arc.lengths.len() == arc.vertices.len() && arc.vertices.iter().all(has_vertex);
    let has_parts = |p: &CellPatch| {
        p.faces.iter().all(|f| f.index() < mesh.n_faces()) && p.border.iter().all(|b| cells.arcs.get(b.0).is_some())
    };
    if !(cells.arcs.iter().all(fits) && cells.patches.iter().all(has_parts) && cells.corners.iter().all(has_vertex)) {
        return Err(CvtError::OtherMesh("the complex of cells"));
    }
    if sizing.relative.len() != mesh.n_vertices() {
        return Err(CvtError::OtherMesh("the sizing field"));
    }
    let possible = MOST_RELATIVE.recip()..=MOST_RELATIVE;
    let least = sizing.relative.iter().copied().fold(f64::INFINITY, f64::min);
    let wrong = |is_wrong: &dyn Fn(f64) -> bool| sizing.relative.iter().copied().find(|&h| is_wrong(h));
    if let Some(h) = wrong(&|h| !possible.contains(&h)).or_else(|| wrong(&|h| h > MOST_RATIO * least)) {
        return Err(CvtError::Sizing(h));
    }
    if options.base_vertices > MOST_VERTICES {
        return Err(CvtError::TooMany(options.base_vertices));
    }
    Ok(())
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
    let n_candidates = CANDIDATES_PER_SITE * (n + border.len() / BORDER_SITES_PER_SITE);
    let candidates = candidates::spread(mesh, &patch.faces, sizing, n_candidates, options.seed);
    lloyd::relaxed_sites(&candidates, &border, n, options.max_steps)
}
