//! The finest level of a base mesh, placed on the surface and relaxed there.

use super::levels::{Finest, relaxed_levels};
use crate::base::BaseStages;
use crate::candidate::Candidate;
use crate::input::Input;
use crate::rescue::NextStage;
use crate::run::Run;
use crate::{Error, Options};
use mesh_core::TriMesh;
use project::ProjectReport;

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
    let subdivided = run.stage("subdivide", || subdiv::subdivide(stages.base.domain(), options.levels()))?;
    let Finest { projected, relaxed } = relaxed_levels(input, stages, options, run)?;
    let n_triangles = relaxed.domain.mesh.n_faces();
    NextStage::Mend.is_worth(relaxed.inverted.len(), n_triangles)?;
    let candidate = Candidate::new(&input.reference, stages, relaxed);
    Ok(Placed { subdivided: subdivided.domain.mesh, projected: projected.domain.mesh, project: projected.report, candidate })
}

/// The input of a mesh, and the finest level of its first base mesh, for tests of what comes after.
#[cfg(test)]
pub(crate) fn first_candidate(mesh: &TriMesh, options: &Options, run: &mut Run) -> (Input, Candidate) {
    let input = Input::new(&mesh.to_soup(), options, run).unwrap();
    let setting = &crate::rescue::PLAN[0].1;
    let mut proposals = crate::base::Proposals::new(&input, options, setting, 0, &|_, _| Ok(()), run).unwrap();
    let stages = proposals.next(run).unwrap().unwrap();
    let Placed { candidate, .. } = placed(&input, &stages, options, run).unwrap();
    (input, candidate)
}
