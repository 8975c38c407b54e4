//! The finest level of a base mesh, placed on the surface and relaxed there.

use super::levels::{Finest, again, relaxed_levels};
use crate::base::BaseStages;
use crate::candidate::Candidate;
use crate::input::Input;
use crate::report::SnapCounts;
use crate::rescue::NextStage;
use crate::run::Run;
use crate::{Error, Options};
use certify::faulty_faces;
use mesh_core::{TriMesh, equilateral_edge_length};
use project::ProjectReport;
use relax::Relaxed;

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
    let BaseStages { surface, proxy, base, .. } = stages;
    let base_surface = stages.base_surface();
    let subdivided = run.stage("subdivide", || subdiv::subdivide(base.domain(), options.levels))?;
    let base_edge_length = equilateral_edge_length(input.cleaned.mesh.total_area(), base.mesh().n_vertices());
    let kept = proxy.as_ref().map_or(&input.cleaned.mesh, |proxy| proxy.surface.mesh());
    let Finest { projected, mut relaxed } = relaxed_levels(base_surface, base, kept, base_edge_length, options, run)?;
    let n_triangles = relaxed.domain.mesh.n_faces();
    if let Some(proxy) = proxy {
        let there = run.stage("project", || proxy.carried(&relaxed.domain, surface))?;
        let on_surface = run.stage("relax", || relax::relax(surface, &there, &again(&options.relax)))?;
        relaxed = Relaxed { report: relaxed.report.then(on_surface.report), ..on_surface };
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
        unsnapped: None,
    };
    Ok(Placed { subdivided: subdivided.domain.mesh, projected: projected.domain.mesh, project: projected.report, candidate })
}
