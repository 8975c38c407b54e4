//! The stages in order.

use crate::anchors::relax_anchored;
use crate::base_stages::{BaseStages, Way};
use crate::failing::Failing;
use crate::fitting::fit_and_certify;
use crate::input::Input;
use crate::ladder::{climb, climb_to_base};
use crate::repair::{OnBase, repaired};
use crate::snapping::{Settled, settle};
use crate::{Error, Options, Report, StageSeconds};
use mesh_core::{IdVec, Soup, Topology, TriMesh, VertexId};
use region_map::{Network, RegionMap, Surface};
use std::borrow::Cow;

/// What the stages from the base mesh on made.
#[derive(Clone, Debug)]
pub struct Stages {
    /// Up to the base mesh.
    pub base: BaseStages,
    /// The subdivided base before projection.
    pub subdivided: TriMesh,
    /// After the first projection.
    pub projected: TriMesh,
    /// The network of the result: that of the base, with bends and minor creases that the finest level was snapped to.
    pub network: Network,
    /// The map of the result on that network.
    pub region: RegionMap,
    /// How far each vertex of the result is off its point of that map, along the surface's normal there, in the units of the mesh.
    pub offsets: IdVec<VertexId, f64>,
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
/// The same where the base mesh has more than so many times the vertices that were asked for: nobody expects to wait for that.
const MOST_UNASKED: u64 = 500_000;
const MOST_TIMES: usize = 4;
/// A large result is not worth to be relaxed with a greater share of triangles folded before. Measured: those that were certified had .0003 to
/// .0045, those that never were .014 to .03.
const HOPELESS_AT_FIRST: f64 = 0.01;
/// A result with a greater share of folded triangles is not worth to be snapped. Snapping mended up to .032 (brick_small).
const HOPELESS: f64 = 0.04;
/// Of a result with more triangles than this, snapping is no hope: it took 15 to 45 s, and mended nothing (DamagedHelmet, crank_cse).
const LARGE: usize = 50_000;
/// A result with a greater share of folded triangles is not worth a fit and a certificate: neither mends any.
const HOPELESS_AT_LAST: f64 = 1e-3;

/// Remeshes a soup of triangles: all stages, then the certificate. Nothing is returned that does not pass it.
///
/// Where a result does not pass, the next rung of a ladder is tried (other creases, more base vertices), and the report's warnings
/// say so. Large results have fewer tries.
pub fn remesh(soup: &Soup, options: &Options) -> Result<Remeshed, Error> {
    let mut seconds = StageSeconds::default();
    let mut options = options.clone();
    let input = Input::new(soup, &mut options, &mut seconds)?;
    let mut remeshed = climb(&input, &options, &mut seconds)?;
    remeshed.report.seconds = seconds;
    Ok(remeshed)
}

/// A base mesh and how long it took.
#[derive(Clone, Debug)]
pub struct Based {
    /// What every stage made.
    pub stages: BaseStages,
    /// Wall time of the stages.
    pub seconds: StageSeconds,
}

/// The stages from cleaning to the base mesh. Where there is none, the next rung of the ladder is tried, and the warnings say so.
pub fn base(soup: &Soup, options: &Options) -> Result<Based, Error> {
    let mut seconds = StageSeconds::default();
    let mut options = options.clone();
    let input = Input::new(soup, &mut options, &mut seconds)?;
    let stages = climb_to_base(&input, &options, &mut seconds)?;
    Ok(Based { stages, seconds })
}

/// Triangles of the finest level on a base mesh of so many vertices and faces. Refuses too many.
pub(crate) fn finest_triangles((vertices, faces): (usize, usize), asked: usize, levels: u32) -> Result<u64, Error> {
    let triangles = 4u64.saturating_pow(levels).saturating_mul(faces as u64);
    let is_unasked = triangles > MOST_UNASKED && vertices > MOST_TIMES * asked;
    if triangles > MAX_TRIANGLES || is_unasked {
        return Err(Error::TooLarge { base_vertices: vertices, triangles });
    }
    Ok(triangles)
}

/// The stages after the base mesh.
pub(crate) fn run(stages: &BaseStages, options: &Options, seconds: &mut StageSeconds) -> Result<Remeshed, Error> {
    let BaseStages { cleaned, working, network, normals, base, .. } = stages;
    let surface = Surface { mesh: &working.mesh, topology: &working.topology, network, normals };
    let domain = seconds.time("subdivide", || subdiv::subdivide(&base.mesh, &base.region, options.levels))?;
    // A base mesh from elsewhere may have no map.
    let origins = (!base.map.charts().is_empty()).then_some(project::Origins { base, points: &domain.origins });
    let projected =
        seconds.time("project", || project::project(&surface, &domain.mesh, &domain.region, origins, &options.project))?;
    let topology = Topology::new(projected.mesh.faces(), projected.mesh.n_vertices())?;
    let n_faces = topology.n_faces();
    if n_faces > LARGE {
        // The relaxation of a large result that starts out so takes minutes, and fails.
        is_worth_more(relax::inverted(&surface, &topology, &projected.region)?.len(), n_faces, HOPELESS_AT_FIRST)?;
    }
    let of_base = (&topology, base.mesh.n_vertices());
    let relaxed = seconds.time("relax", || relax_anchored(&surface, &cleaned.mesh, &projected, of_base, &options.relax))?;
    is_worth_more(relaxed.inverted.len(), n_faces, HOPELESS)?;
    let input = certify::Surface::new(&cleaned.mesh).map_err(certify::MeasureError::Original)?;
    let as_it_is = OnBase { base: Cow::Borrowed(base), topology, relaxed };
    let (OnBase { base, topology, relaxed }, failing) = match stages.way {
        // A base mesh from elsewhere stays as it is.
        Way::Given => {
            let failing = Failing::of(&as_it_is.relaxed.mesh, &input);
            (as_it_is, failing)
        }
        _ => seconds.time("repair", || repaired(&surface, &input, as_it_is, options))?,
    };
    let n_faces = topology.n_faces();
    is_worth_more(relaxed.inverted.len(), n_faces, if n_faces > LARGE { HOPELESS_AT_LAST } else { HOPELESS })?;
    let settled = seconds.time("snap", || settle(&surface, &input, (relaxed, failing), &topology, &options.relax));
    let Settled { network, normals, relaxed, failing, snapped, warning } = settled;
    is_worth_more(failing.flipped, n_faces, HOPELESS_AT_LAST)?;
    let surface = Surface { network: &network, normals: &normals, ..surface };
    let relaxed_domain = (relaxed.mesh, relaxed.map);
    let certified = fit_and_certify(&surface, &cleaned.mesh, relaxed_domain, &topology, options, seconds)?;
    let report = Report {
        clean: cleaned.report.clone(),
        base: base.counts.clone(),
        cells: stages.cell_counts(),
        crease_length: stages.crease_length(),
        warnings: stages.warnings.iter().cloned().chain(warning).chain(certified.warning).collect(),
        project: projected.report,
        relax: relaxed.report,
        snapped,
        fit: certified.fit,
        certificate: certified.certificate,
        seconds: StageSeconds::default(),
    };
    let stages = Stages {
        subdivided: domain.mesh,
        projected: projected.mesh,
        network: surface.network.clone(),
        region: certified.map,
        offsets: certified.offsets,
        base: BaseStages { base: base.into_owned(), ..stages.clone() },
    };
    Ok(Remeshed { mesh: certified.mesh, report, stages })
}

/// Fails where more than a share of the triangles is folded.
fn is_worth_more(inverted: usize, faces: usize, most_folded: f64) -> Result<(), Error> {
    if inverted as f64 > most_folded * faces as f64 { Err(Error::Folded { inverted, faces }) } else { Ok(()) }
}
