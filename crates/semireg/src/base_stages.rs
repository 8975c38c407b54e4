//! The stages from the cleaned mesh to the base mesh.

use crate::ladder::Rung;
use crate::{Error, Options, StageSeconds};
use basemesh::{BaseError, BaseOptions};
use features::FeatureOptions;
use mesh_core::{Cleaned, TriMesh};
use region_map::{BaseCounts, BaseMesh, Cells, Network, Segmentation, SheetNormals, Sites, Surface};
use segment_cvt::{Budget, CvtOptions, SizingField};
use segment_vsa::VsaOptions;
use sizing::SizingOptions;

/// What the stages up to the base mesh made.
#[derive(Clone, Debug)]
pub struct BaseStages {
    /// The working mesh with its repairs.
    pub cleaned: Cleaned,
    /// Corners, arcs and sheets.
    pub network: Network,
    /// One-sided normals of the working mesh.
    pub normals: SheetNormals,
    /// Patches.
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

/// Fewer, and nothing is left for the inside of the patches (design, section 3).
const VERTICES_A_PATCH: usize = 16;
/// So often patches are split for their distortion; later only those that have no chart at all.
const SPLITTING_ROUNDS: usize = 4;

/// Runs the stages on a cleaned mesh.
pub(crate) fn base_stages(
    cleaned: &Cleaned,
    options: &Options,
    rung: &Rung,
    seconds: &mut StageSeconds,
) -> Result<BaseStages, Error> {
    let (mesh, topology) = (&cleaned.mesh, &cleaned.topology);
    let asked = options.wanted_base_vertices(mesh.n_vertices());
    let wanted = (asked as f64 * rung.base_vertices).round() as usize;
    let base_edge_length = mean_edge_length(mesh, wanted);
    let persistence = options.features.persistence * rung.persistence;
    let feature_options = FeatureOptions { base_edge_length, persistence, ..options.features.clone() };
    let network = seconds.time("features", || features::detect(mesh, topology, &feature_options))?;
    let vsa = VsaOptions { max_patches: (wanted / VERTICES_A_PATCH).max(6), base_edge_length, ..Default::default() };
    let (mut segmentation, _) = seconds.time("segment", || segment_vsa::segment(mesh, topology, &network, &vsa))?;
    let normals = SheetNormals::new(mesh, topology, &network);
    let surface = Surface { mesh, topology, network: &network, normals: &normals };
    let sizing_options = SizingOptions { turn: rung.turn, ..SizingOptions::new(base_edge_length) };
    let sizing = seconds.time("sizing", || sizing::sizing(&surface, &sizing_options));
    let mut warnings = Vec::new();
    let (mut n_split, mut rounds) = (0, 0);
    loop {
        let cells = Cells::trace(mesh, topology, &network, &segmentation)?;
        let cvt = CvtOptions { base_vertices: wanted, seed: options.seed, ..Default::default() };
        let sampled = seconds.time("sample", || segment_cvt::sample(mesh, &cells, &SizingField::uniform(), &cvt))?;
        let max_shrunk = if rounds < SPLITTING_ROUNDS { BaseOptions::default().max_shrunk } else { 1.0 };
        let base_options = BaseOptions { base_vertices: wanted, max_shrunk, ..Default::default() };
        rounds += 1;
        match seconds.time("base", || basemesh::build(&surface, &cells, &sampled.sites, &sizing, &base_options)) {
            Ok(mut base) => {
                if n_split > 0 {
                    warnings.push(format!("{n_split} patches were too long or too winding to lay flat and were split"));
                }
                base.counts = counts(&base, asked, &sampled.budget, &network, rung);
                let cleaned = cleaned.clone();
                return Ok(BaseStages { cleaned, sites: sampled.sites, network, normals, segmentation, cells, base, warnings });
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

/// The length of the edges of `n` vertices spread evenly in equilateral triangles (eq. 3).
fn mean_edge_length(mesh: &TriMesh, n: usize) -> f64 {
    (2.0 * mesh.total_area() / (3f64.sqrt() * n.max(1) as f64)).sqrt()
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
