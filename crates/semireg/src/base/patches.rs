//! The paper's way to a base mesh: patches, their sites, and these triangulated in charts.

use crate::Error;
use crate::run::Run;
use basemesh::{BaseError, BaseOptions};
use mesh_core::equilateral_edge_length;
use region_map::{BaseMesh, Cells, Segmentation, Sites, Sizing, Surface};
use segment_cvt::CvtOptions;
use segment_vsa::VsaOptions;

/// What the paper's way to a base mesh made.
#[derive(Clone, Debug)]
pub struct Patches {
    /// Patches.
    pub segmentation: Segmentation,
    /// Patches with their borders.
    pub cells: Cells,
    /// Sites.
    pub sites: Sites,
    /// The base mesh of the sites, improved.
    pub base: BaseMesh,
    /// Vertices that the corners and arcs need.
    pub(super) needed: usize,
    /// Patches that were split, as they could not be laid flat.
    n_split: usize,
}

impl Patches {
    /// Tells of the patches that were split; `None` where none was.
    pub(super) fn split_warning(&self) -> Option<String> {
        let told = || format!("{} patches were too long or too winding to lay flat and were split", self.n_split);
        (self.n_split > 0).then(told)
    }
}

/// How patches are made and joined.
pub(super) struct Style {
    /// Sites for each vertex wanted.
    pub(super) sites: f64,
    /// Rounds of improvement; without any the triangulation of the sites stays as it is.
    pub(super) rounds: usize,
    /// Weight of the distance beside the normals.
    pub(super) compactness: f64,
}

/// The first base mesh has so many sites for each vertex wanted: it is coarsened in its map.
const SITES: f64 = 2.0;
/// Fewer sites, and nothing is left for the inside of the patches.
const SITES_A_PATCH: usize = 16;
/// So often patches are split for their distortion; later only those that have no chart at all.
const SPLITTING_ROUNDS: usize = 4;

impl Style {
    /// More sites than vertices, and a base mesh that is improved from there.
    pub(super) fn improved() -> Self {
        let (base, vsa) = (BaseOptions::default(), VsaOptions::default());
        Self { sites: SITES, rounds: base.rounds, compactness: vsa.compactness }
    }
}

/// Patches, their sites, and the base mesh of these (paper, sections 3.1 and 3.2).
pub(super) fn patches(
    surface: &Surface,
    sizing: &Sizing,
    wanted: usize,
    style: &Style,
    seed: u64,
    run: &mut Run,
) -> Result<Patches, Error> {
    let Style { sites, rounds: improvement, compactness } = *style;
    let mesh = surface.mesh();
    let n_sites = (wanted as f64 * sites).round() as usize;
    let base_edge_length = equilateral_edge_length(mesh.total_area(), wanted);
    let vsa = VsaOptions { max_patches: (n_sites / SITES_A_PATCH).max(6), base_edge_length, compactness, ..Default::default() };
    let (mut segmentation, _) = run.stage("segment", || segment_vsa::segment(surface, &vsa))?;
    let (mut n_split, mut rounds) = (0, 0);
    loop {
        let cells = Cells::trace(surface, &segmentation)?;
        let cvt = CvtOptions { base_vertices: n_sites, seed, ..Default::default() };
        let sampled = run.stage("sample", || segment_cvt::sample(surface, &cells, &Sizing::uniform(mesh), &cvt))?;
        let max_shrunk = if rounds < SPLITTING_ROUNDS { BaseOptions::default().max_shrunk } else { 1.0 };
        let base_options = BaseOptions { base_vertices: wanted, rounds: improvement, max_shrunk, ..Default::default() };
        rounds += 1;
        match run.stage("base", || basemesh::build(surface, &cells, &sampled.sites, sizing, &base_options)) {
            Ok(base) => {
                let needed = sampled.budget.needed;
                return Ok(Patches { segmentation, cells, sites: sampled.sites, base, needed, n_split });
            }
            // Patches that can't be laid flat are cut in two; one face always can.
            Err(Error::Base(BaseError::Uncharted(patches))) if patches.iter().any(|&p| cells.patches[p].faces.len() > 1) => {
                n_split += patches.len();
                segmentation = segment_vsa::split(surface, &segmentation, &patches)?;
            }
            Err(e) => return Err(e),
        }
    }
}
