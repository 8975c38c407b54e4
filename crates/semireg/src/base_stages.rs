//! The stages from the cleaned mesh to the base mesh.

use crate::ladder::Rung;
use crate::marked::with_marked_edges;
use crate::{Error, Options, StageSeconds};
use basemesh::{BaseError, BaseOptions};
use features::FeatureOptions;
use mesh_core::{Cleaned, Soup, TriMesh, equilateral_edge_length};
use refine::{RefineOptions, Refined};
use region_map::{BaseCounts, BaseMesh, Cells, Network, Segmentation, SheetNormals, Sites, Sizing, Surface};
use segment_cvt::{Budget, CvtOptions};
use segment_vsa::VsaOptions;
use sizing::SizingOptions;
use std::sync::Arc;

/// What the stages up to the base mesh made.
#[derive(Clone, Debug)]
pub struct BaseStages {
    /// The input with its repairs.
    pub cleaned: Arc<Cleaned>,
    /// The working mesh: the same surface in triangles that are not in the way.
    pub working: Arc<Refined>,
    /// Corners, arcs and sheets.
    pub network: Network,
    /// One-sided normals of the working mesh.
    pub normals: SheetNormals,
    /// Patches; these, cells and sites are empty with a base mesh from elsewhere.
    pub segmentation: Segmentation,
    /// Patches with their borders.
    pub cells: Cells,
    /// Sites.
    pub sites: Sites,
    /// The base mesh.
    pub base: BaseMesh,
    /// What did not go as usual.
    pub warnings: Vec<String>,
}

/// Fewer, and nothing is left for the inside of the patches.
const VERTICES_A_PATCH: usize = 16;
/// So often patches are split for their distortion; later only those that have no chart at all.
const SPLITTING_ROUNDS: usize = 4;

/// The mesh that the stages run on: cleaned and refined.
pub(crate) struct Input {
    pub(crate) cleaned: Arc<Cleaned>,
    pub(crate) working: Arc<Refined>,
}

/// Edges of the working mesh are at most this share of a base edge.
const LONGEST_EDGE: f64 = 0.5;

impl Input {
    /// Cleans and refines a soup. `options` then mark the edges of the refined mesh.
    pub(crate) fn new(soup: &Soup, options: &mut Options, seconds: &mut StageSeconds) -> Result<Self, Error> {
        let cleaned = seconds.time("clean", || mesh_core::clean(soup, &options.clean))?;
        *options = with_marked_edges(&cleaned, options)?;
        let base_edge = mean_edge_length(&cleaned.mesh, options.wanted_base_vertices(cleaned.mesh.n_vertices()));
        let refine_options = RefineOptions::new(LONGEST_EDGE * base_edge);
        let marked = std::mem::take(&mut options.features.marked);
        let working = seconds.time("refine", || refine::refine(&cleaned.mesh, &cleaned.topology, &marked, &refine_options))?;
        options.features.marked.clone_from(&working.marked);
        Ok(Self { cleaned: Arc::new(cleaned), working: Arc::new(working) })
    }
}

/// Runs the stages on an input. `needed` base vertices are what corners and arcs took on an earlier rung, 0 on the first.
pub(crate) fn base_stages(
    input: &Input,
    options: &Options,
    rung: &Rung,
    needed: usize,
    seconds: &mut StageSeconds,
) -> Result<BaseStages, Error> {
    let (mesh, topology) = (&input.working.mesh, &input.working.topology);
    let asked = options.wanted_base_vertices(input.cleaned.mesh.n_vertices());
    let at_least = if rung.as_needed { needed.max(asked) } else { asked };
    let wanted = (at_least as f64 * rung.base_vertices).round() as usize;
    let n_sites = (wanted as f64 * rung.sites).round() as usize;
    let base_edge_length = mean_edge_length(mesh, wanted);
    let persistence = options.features.persistence * rung.persistence;
    let feature_options = FeatureOptions { base_edge_length, persistence, ..options.features.clone() };
    let network = seconds.time("features", || features::detect(mesh, topology, &feature_options))?;
    let vsa = VsaOptions { max_patches: (n_sites / VERTICES_A_PATCH).max(6), base_edge_length, ..Default::default() };
    let (mut segmentation, _) = seconds.time("segment", || segment_vsa::segment(mesh, topology, &network, &vsa))?;
    let normals = SheetNormals::new(mesh, topology, &network);
    let surface = Surface { mesh, topology, network: &network, normals: &normals };
    let sizing_options = SizingOptions { turn: rung.turn, ..SizingOptions::new(base_edge_length) };
    let sizing = seconds.time("sizing", || sizing::sizing(&surface, &sizing_options));
    let mut warnings = Vec::new();
    let (mut n_split, mut rounds) = (0, 0);
    loop {
        let cells = Cells::trace(mesh, topology, &network, &segmentation)?;
        let cvt = CvtOptions { base_vertices: n_sites, seed: options.seed, ..Default::default() };
        let sampled = seconds.time("sample", || segment_cvt::sample(mesh, &cells, &Sizing::uniform(mesh), &cvt))?;
        let max_shrunk = if rounds < SPLITTING_ROUNDS { BaseOptions::default().max_shrunk } else { 1.0 };
        let base_options = BaseOptions { base_vertices: wanted, max_shrunk, ..Default::default() };
        rounds += 1;
        match seconds.time("base", || basemesh::build(&surface, &cells, &sampled.sites, &sizing, &base_options)) {
            Ok(mut base) => {
                if n_split > 0 {
                    warnings.push(format!("{n_split} patches were too long or too winding to lay flat and were split"));
                }
                base.counts = counts(&base, asked, &sampled.budget, &network, rung);
                let (cleaned, working, sites) = (input.cleaned.clone(), input.working.clone(), sampled.sites);
                return Ok(BaseStages { cleaned, working, sites, network, normals, segmentation, cells, base, warnings });
            }
            // Patches that can't be laid flat are cut in two; one face always can.
            Err(BaseError::Uncharted(patches)) if patches.iter().any(|&p| cells.patches[p].faces.len() > 1) => {
                n_split += patches.len();
                segmentation = segment_vsa::split(mesh, topology, &network, &segmentation, &patches);
            }
            Err(e) => return Err(e.into()),
        }
    }
}

/// The mean length of the edges of a base mesh of `n` vertices (eq. 3).
pub(crate) fn mean_edge_length(mesh: &TriMesh, n: usize) -> f64 {
    equilateral_edge_length(mesh.total_area(), n)
}

/// Base vertices asked, needed and made, and why there are more than asked.
fn counts(base: &BaseMesh, asked: usize, budget: &Budget, network: &Network, rung: &Rung) -> BaseCounts {
    let made = base.mesh.n_vertices();
    let needed = budget.needed.min(made);
    let reason = if made <= asked {
        String::new()
    } else if rung.base_vertices > 1.0 {
        format!("asked {asked}, took {made}: with fewer the result did not pass the certificate")
    } else {
        let (corners, arcs) = (network.corners.len(), network.arcs.len());
        format!("asked {asked}, needs {made}: {corners} corners and {arcs} arcs must be kept")
    };
    BaseCounts { asked, needed, made, reason }
}
