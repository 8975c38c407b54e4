//! The stages in order.

use crate::base_stages::{BaseStages, base_stages};
use crate::ladder::LADDER;
use crate::{Error, Options, Report, StageSeconds};
use mesh_core::{Soup, Topology, TriMesh, VertexId};
use region_map::{ArcKind, RegionMap, Surface};

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

/// Triangles of a result beyond which it is refused: it would take hours and tens of gigabytes.
pub const MAX_TRIANGLES: u64 = 50_000_000;
/// Once rungs of the ladder with this many triangles in all have failed, no further one is tried. Two cores make
/// 9,000 (mech-holes-shark, six rungs) to 15,000 triangles (fandisk) a second, so this is about a minute, and then the last rung's own.
const MOST_FAILED: u64 = 500_000;

/// A result with a greater share of folded triangles is given up at once. Measured: the worst that a later rung mended had .032
/// (the fixture `brick_small`); conrod, DamagedHelmet and 2CylinderEngine, which none mended, had .2 to .6.
const HOPELESS: f64 = 0.1;

/// Remeshes a soup of triangles: all stages, then the certificate. Nothing is returned that does not pass it.
///
/// Where a result does not pass, the next rung of a ladder is tried (other creases, more base vertices), and the report's warnings
/// say so. Large results have fewer tries.
pub fn remesh(soup: &Soup, options: &Options) -> Result<Remeshed, Error> {
    let mut seconds = StageSeconds::default();
    let cleaned = seconds.time("clean", || mesh_core::clean(soup, &options.clean))?;
    let mut warnings = Vec::new();
    let mut first_failure = None;
    let mut triangles = 0;
    for rung in &LADDER {
        if triangles > MOST_FAILED {
            break;
        }
        let result = base_stages(&cleaned, options, rung, &mut seconds).and_then(|stages| {
            triangles += finest_triangles(&stages, options.levels)?;
            run(stages, options, &mut seconds)
        });
        match result {
            Ok(mut remeshed) => {
                warnings.append(&mut remeshed.report.warnings);
                remeshed.report.warnings = warnings;
                remeshed.report.seconds = seconds;
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
    base_stages(&mesh_core::clean(soup, &options.clean)?, options, &LADDER[0], &mut StageSeconds::default())
}

/// Triangles of the finest level. Refuses too many here, as nobody knows the size of the base mesh before it is made.
fn finest_triangles(stages: &BaseStages, levels: u32) -> Result<u64, Error> {
    let base = &stages.base.mesh;
    let triangles = 4u64.saturating_pow(levels).saturating_mul(base.n_faces() as u64);
    if triangles > MAX_TRIANGLES {
        return Err(Error::TooLarge { base_vertices: base.n_vertices(), triangles });
    }
    Ok(triangles)
}

/// The stages after the base mesh.
fn run(stages: BaseStages, options: &Options, seconds: &mut StageSeconds) -> Result<Remeshed, Error> {
    let BaseStages { cleaned, network, normals, base, .. } = &stages;
    let surface = Surface { mesh: &cleaned.mesh, topology: &cleaned.topology, network, normals };
    let domain = seconds.time("subdivide", || subdiv::subdivide(&base.mesh, &base.region, options.levels))?;
    let origins = project::Origins { base, points: &domain.origins };
    let projected =
        seconds.time("project", || project::project(&surface, &domain.mesh, &domain.region, Some(origins), &options.project))?;
    let topology = Topology::new(projected.mesh.faces(), projected.mesh.n_vertices())?;
    let relaxed =
        seconds.time("relax", || relax::relax(&surface, &projected.mesh, &topology, &projected.region, &options.relax))?;
    let (inverted, faces) = (relaxed.report.end.inverted, relaxed.mesh.n_faces());
    if inverted as f64 > HOPELESS * faces as f64 {
        return Err(Error::Folded { inverted, faces });
    }
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
        seconds: StageSeconds::default(),
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
