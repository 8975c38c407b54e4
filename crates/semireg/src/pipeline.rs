//! The stages in order.

use crate::base_stages::{BaseStages, base_stages};
use crate::ladder::{LADDER, Rung};
use crate::{Error, Options, Report};
use mesh_core::{Cleaned, Soup, Topology, TriMesh, VertexId};
use region_map::{ArcKind, RegionMap, SheetNormals, Surface};

/// What the stages from the base mesh on made.
#[derive(Clone, Debug)]
pub struct Stages {
    /// Up to the base mesh.
    pub base: BaseStages,
    /// The subdivided base before projection.
    pub subdivided: TriMesh,
    /// After the first projection.
    pub projected: TriMesh,
    /// The region map of the result.
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
///
/// Where a result does not pass, the next rung of a ladder is tried (other creases, more base vertices), and the report's warnings
/// say so.
pub fn remesh(soup: &Soup, options: &Options) -> Result<Remeshed, Error> {
    let cleaned = mesh_core::clean(soup, &options.clean)?;
    let mut warnings = Vec::new();
    let mut first_failure = None;
    for rung in &LADDER {
        match run(&cleaned, options, rung) {
            Ok(mut remeshed) => {
                warnings.append(&mut remeshed.report.warnings);
                remeshed.report.warnings = warnings;
                return Ok(remeshed);
            }
            Err(e @ (Error::NotCertified(_) | Error::Base(_))) => {
                warnings.push(format!("{} it was tried and failed: {e}", rung.what));
                first_failure.get_or_insert(e);
            }
            Err(e) => return Err(e),
        }
    }
    Err(first_failure.unwrap_or(Error::NotCertified("nothing was tried".into())))
}

/// The stages from cleaning to the base mesh.
pub fn base(soup: &Soup, options: &Options) -> Result<BaseStages, Error> {
    base_stages(&mesh_core::clean(soup, &options.clean)?, options, &LADDER[0])
}

/// All stages on one rung of the ladder.
fn run(cleaned: &Cleaned, options: &Options, rung: &Rung) -> Result<Remeshed, Error> {
    let mut stages = base_stages(cleaned, options, rung)?;
    let mut seconds = std::mem::take(&mut stages.seconds);
    let BaseStages { network, base, .. } = &stages;
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
    let report = Report {
        clean: cleaned.report.clone(),
        base: base.counts.clone(),
        cells: [stages.segmentation.n_patches, network.corners.len(), network.arcs.len()],
        crease_length: crease_length(&stages),
        warnings: stages.warnings.clone(),
        project: projected.report,
        relax: relaxed.report,
        certificate,
        seconds,
    };
    let stages = Stages { subdivided: domain.mesh, projected: projected.mesh, region: relaxed.map, base: stages };
    Ok(Remeshed { mesh: relaxed.mesh, report, stages })
}

/// Lengths of the creases that were kept and that were left out.
fn crease_length(stages: &BaseStages) -> [f64; 2] {
    let BaseStages { network, cleaned, .. } = stages;
    let kept = network.arcs.iter().filter(|a| a.kind == ArcKind::Sharp).map(|a| a.length()).sum();
    let length = |chain: &[VertexId]| -> f64 { chain.windows(2).map(|w| cleaned.mesh.distance(w[0], w[1])).sum() };
    [kept, network.minor.iter().map(|c| length(c)).sum()]
}
