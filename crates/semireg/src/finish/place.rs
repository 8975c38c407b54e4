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

/// Subdivides a base mesh, projects and relaxes its finest level. Fails early where too much of it is folded.
pub(super) fn placed(input: &Input, stages: &BaseStages, options: &Options, run: &mut Run) -> Result<Placed, Error> {
    let BaseStages { surface, base, .. } = stages;
    let subdivided = run.stage("subdivide", || subdiv::subdivide(base.domain(), options.levels))?;
    let origins = base.mapped().map(|base| Origins { base, points: &subdivided.origins });
    let projected = run.stage("project", || project::project(surface, &subdivided.domain, origins, &options.project))?;
    let n_triangles = projected.domain.mesh.n_faces();
    NextStage::Relax.is_worth(relax::inverted(surface, &projected.domain)?.len(), n_triangles)?;
    let base_edge_length = equilateral_edge_length(input.cleaned.mesh.total_area(), base.mesh().n_vertices());
    let relaxed = run.stage("relax", || {
        relax::relax_keeping(surface, &projected.domain, &input.cleaned.mesh, base_edge_length, &options.relax)
    })?;
    NextStage::Mend.is_worth(relaxed.inverted.len(), n_triangles)?;
    let faults = faulty_faces(&input.reference, &relaxed.domain.mesh);
    let candidate = Candidate {
        base: base.clone(),
        counts: stages.counts.clone(),
        surface: surface.clone(),
        relaxed,
        faults,
        snapped: SnapCounts::default(),
    };
    Ok(Placed { subdivided: subdivided.domain.mesh, projected: projected.domain.mesh, project: projected.report, candidate })
}
