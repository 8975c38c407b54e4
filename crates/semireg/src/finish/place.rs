//! The finest level of a base mesh, placed on the surface and relaxed there.

use crate::base::BaseStages;
use crate::candidate::Candidate;
use crate::input::Input;
use crate::report::SnapCounts;
use crate::rescue::NextStage;
use crate::run::Run;
use crate::{Error, Options};
use certify::faulty_faces;
use mesh_core::{TriMesh, equilateral_edge_length};
use project::{Origins, ProjectReport};
use relax::{QuadricOptions, RelaxOptions, RelaxReport, Relaxed, ShapeOptions};

/// The finest level of a base mesh, relaxed, and what led to it.
pub(super) struct Placed {
    /// The base mesh subdivided, before projection.
    pub(super) subdivided: TriMesh,
    /// After projection.
    pub(super) projected: TriMesh,
    /// What the projection did.
    pub(super) project: ProjectReport,
    /// After relaxation.
    pub(super) candidate: Candidate,
}

/// Newton steps on the working mesh, after those on its proxy. More takes longer and hardly changes anything.
const STEPS_AFTER_PROXY: usize = 6;

fn few_steps(options: &RelaxOptions) -> RelaxOptions {
    RelaxOptions {
        quadric: QuadricOptions { iterations: 0, ..options.quadric.clone() },
        shape: ShapeOptions { steps: STEPS_AFTER_PROXY, ..options.shape.clone() },
    }
}

/// Subdivides a base mesh, projects and relaxes its finest level. Fails early where too much of it is folded.
pub(super) fn placed(input: &Input, stages: &BaseStages, options: &Options, run: &mut Run) -> Result<Placed, Error> {
    let BaseStages { surface, proxy, base, .. } = stages;
    let base_surface = stages.base_surface();
    let subdivided = run.stage("subdivide", || subdiv::subdivide(base.domain(), options.levels))?;
    let origins = base.mapped().map(|base| Origins { base, points: &subdivided.origins });
    let projected = run.stage("project", || project::project(base_surface, &subdivided.domain, origins, &options.project))?;
    let n_triangles = projected.domain.mesh.n_faces();
    NextStage::Relax.is_worth(relax::inverted(base_surface, &projected.domain)?.len(), n_triangles)?;
    let base_edge_length = equilateral_edge_length(input.cleaned.mesh.total_area(), base.mesh().n_vertices());
    let kept = proxy.as_ref().map_or(&input.cleaned.mesh, |proxy| proxy.surface.mesh());
    let mut relaxed =
        run.stage("relax", || relax::relax_keeping(base_surface, &projected.domain, kept, base_edge_length, &options.relax))?;
    if let Some(proxy) = proxy {
        let there = run.stage("project", || proxy.carried(&relaxed.domain, surface))?;
        let again = run.stage("relax", || relax::relax(surface, &there, &few_steps(&options.relax)))?;
        let shape_steps = relaxed.report.shape_steps + again.report.shape_steps;
        relaxed = Relaxed { report: RelaxReport { shape_steps, end: again.report.end, ..relaxed.report }, ..again };
    }
    NextStage::Mend.is_worth(relaxed.inverted.len(), n_triangles)?;
    let faults = faulty_faces(&input.reference, &relaxed.domain.mesh);
    let candidate = Candidate {
        base: base.clone(),
        counts: stages.counts.clone(),
        base_surface: base_surface.clone(),
        surface: surface.clone(),
        relaxed,
        faults,
        snapped: SnapCounts::default(),
    };
    Ok(Placed { subdivided: subdivided.domain.mesh, projected: projected.domain.mesh, project: projected.report, candidate })
}
