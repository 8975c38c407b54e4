//! The stages in order.

use crate::{Error, Options, Report, StageSeconds};
use basemesh::{BaseError, BaseOptions};
use features::FeatureOptions;
use mesh_core::{Cleaned, Soup, Topology, TriMesh};
use region_map::{ArcKind, BaseMesh, Cells, Network, RegionMap, Segmentation, SheetNormals, Sites, Surface};
use segment_cvt::{CvtOptions, SizingField};
use segment_vsa::VsaOptions;
use sizing::SizingOptions;

/// What the stages up to the base mesh made.
#[derive(Clone, Debug)]
pub struct BaseStages {
    /// The working mesh with its repairs.
    pub cleaned: Cleaned,
    /// Corners, arcs and sheets.
    pub network: Network,
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
    /// Wall time of the stages.
    pub seconds: StageSeconds,
}

/// What the stages from the base mesh on made.
#[derive(Clone, Debug)]
pub struct Stages {
    /// Up to the base mesh.
    pub base: BaseStages,
    /// The subdivided base before projection.
    pub subdivided: TriMesh,
    /// After the first projection.
    pub projected: TriMesh,
    /// After relaxation, with the region map of the result.
    pub region: RegionMap,
}

/// A finished mesh and how it came about.
#[derive(Clone, Debug)]
pub struct Remeshed {
    /// The certified semi-regular mesh.
    pub mesh: TriMesh,
    /// What was done, in figures.
    pub report: Report,
    /// What every stage made.
    pub stages: Stages,
}

/// Remeshes a soup of triangles: all stages, then the certificate. Nothing is returned that does not pass it.
pub fn remesh(soup: &Soup, options: &Options) -> Result<Remeshed, Error> {
    let mut stages = base(soup, options)?;
    let mut seconds = std::mem::take(&mut stages.seconds);
    let BaseStages { cleaned, network, base, .. } = &stages;
    let normals = SheetNormals::new(&cleaned.mesh, &cleaned.topology, network);
    let surface = Surface { mesh: &cleaned.mesh, topology: &cleaned.topology, network, normals: &normals };
    let domain = seconds.time("subdivide", || subdiv::subdivide(&base.mesh, &base.region, options.levels))?;
    let origins = project::Origins { base, points: &domain.origins };
    let projected =
        seconds.time("project", || project::project(&surface, &domain.mesh, &domain.region, Some(origins), &options.project))?;
    let topology = Topology::new(projected.mesh.faces(), projected.mesh.n_vertices())?;
    let relaxed =
        seconds.time("relax", || relax::relax(&surface, &projected.mesh, &topology, &projected.region, &options.relax))?;
    let certificate =
        seconds.time("certify", || certify::certify(&cleaned.mesh, &relaxed.mesh, options.levels, &Default::default()))?;
    if let Some(failure) = certificate.failures().first() {
        return Err(Error::NotCertified(failure.to_string()));
    }
    let length = |chains: &[Vec<mesh_core::VertexId>]| -> f64 {
        chains.iter().flat_map(|c| c.windows(2)).map(|w| cleaned.mesh.distance(w[0], w[1])).sum()
    };
    let kept = network.arcs.iter().filter(|a| a.kind == ArcKind::Sharp).map(|a| a.length()).sum();
    let report = Report {
        clean: cleaned.report.clone(),
        base: base.counts.clone(),
        cells: [stages.segmentation.n_patches, network.corners.len(), network.arcs.len()],
        crease_length: [kept, length(&network.minor)],
        warnings: stages.warnings.clone(),
        project: projected.report,
        relax: relaxed.report,
        certificate,
        seconds,
    };
    let stages = Stages { subdivided: domain.mesh, projected: projected.mesh, region: relaxed.map, base: stages };
    Ok(Remeshed { mesh: relaxed.mesh, report, stages })
}

/// Fewer, and nothing is left for the inside of the patches (design, section 3).
const VERTICES_A_PATCH: usize = 16;

/// So often patches are split for their distortion; later only those that have no chart at all.
const SPLITTING_ROUNDS: usize = 4;

/// The stages from cleaning to the base mesh.
pub fn base(soup: &Soup, options: &Options) -> Result<BaseStages, Error> {
    let mut seconds = StageSeconds::default();
    let cleaned = seconds.time("clean", || mesh_core::clean(soup, &options.clean))?;
    let (mesh, topology) = (&cleaned.mesh, &cleaned.topology);
    let wanted = options.wanted_base_vertices(mesh.n_vertices());
    // eq. 3
    let base_edge_length = (2.0 * mesh.total_area() / (3f64.sqrt() * wanted as f64)).sqrt();
    let feature_options = FeatureOptions { base_edge_length, ..options.features.clone() };
    let network = seconds.time("features", || features::detect(mesh, topology, &feature_options))?;
    let vsa = VsaOptions { max_patches: (wanted / VERTICES_A_PATCH).max(6), base_edge_length, ..Default::default() };
    let (mut segmentation, _) = seconds.time("segment", || segment_vsa::segment(mesh, topology, &network, &vsa))?;
    let normals = SheetNormals::new(mesh, topology, &network);
    let surface = Surface { mesh, topology, network: &network, normals: &normals };
    let mut warnings = Vec::new();
    let (mut n_split, mut rounds) = (0, 0);
    let sizing = seconds.time("sizing", || sizing::sizing(&surface, &SizingOptions::new(base_edge_length)));
    loop {
        let cells = Cells::trace(mesh, topology, &network, &segmentation)?;
        let cvt = CvtOptions { base_vertices: wanted, seed: options.seed, ..Default::default() };
        let sampled = seconds.time("sample", || segment_cvt::sample(mesh, &cells, &SizingField::uniform(), &cvt))?;
        let distortion = if rounds < SPLITTING_ROUNDS { BaseOptions::default().max_shrunk } else { 1.0 };
        let base_options = BaseOptions { base_vertices: wanted, max_shrunk: distortion, ..Default::default() };
        rounds += 1;
        let made = seconds.time("base", || basemesh::build(&surface, &cells, &sampled.sites, &sizing, &base_options));
        match made {
            Ok(base) => {
                if n_split > 0 {
                    warnings.push(format!("{n_split} patches were too long or too winding to lay flat and were split"));
                }
                return Ok(BaseStages { sites: sampled.sites, network, segmentation, cells, base, warnings, seconds, cleaned });
            }
            // The ladder: patches that can't be laid flat are cut in two.
            Err(BaseError::Uncharted(patches)) if patches.iter().any(|&p| cells.patches[p].faces.len() > 1) => {
                n_split += patches.len();
                segmentation = segment_vsa::split(mesh, topology, &network, &segmentation, &patches);
            }
            Err(e) => return Err(e.into()),
        }
    }
}
