//! The paper's stages after the base mesh as they are printed (section 4), on any base mesh.

use super::fitting::certified;
use super::whole::{Starts, assembled, on_its_base};
use crate::base::BaseStages;
use crate::candidate::Candidate;
use crate::input::Input;
use crate::relaxation::PaperOptions;
use crate::remeshed::Remeshed;
use crate::rescue::mended;
use crate::run::Run;
use crate::{Error, Options};
use project::Projected;
use relax::{Quality, RelaxReport, Relaxed};
use subdiv::SubdivDomain;

/// Makes the finest level of a base mesh as the paper does: linear subdivision, regional rays, quadric relaxation, and rays again. Nothing is
/// returned that the certificate refuses.
///
/// Only where that leaves a few folded triangles more is done: these places are mended as those of any other result.
pub(crate) fn paper_finished(
    input: &Input,
    stages: &BaseStages,
    paper: PaperOptions,
    options: &Options,
    run: &mut Run,
) -> Result<Remeshed, Error> {
    let subdivided = run.stage("subdivide", || subdiv::subdivide(stages.base.domain(), options.levels()))?;
    let finest = Finest { input, stages, subdivided: &subdivided, paper, options };
    let (projected, candidate) = finest.as_printed(run)?;
    let candidate = mended(&input.reference, candidate, options, run)?;
    let mut warnings = stages.warnings.clone();
    candidate.check()?;
    let without_fit = Options { fit: None, ..options.clone() };
    let certified = certified(&input.reference, &candidate, &without_fit, run, &mut warnings);
    let Projected { domain, report } = projected;
    let starts = Starts { subdivided: subdivided.domain.mesh, projected: domain.mesh, project: report };
    Ok(assembled(input, stages, starts, candidate, certified.map_err(|e| on_its_base(e, stages))?, options, warnings))
}

/// The finest level of a base mesh, and how it is to be placed.
struct Finest<'a> {
    input: &'a Input,
    stages: &'a BaseStages,
    subdivided: &'a SubdivDomain,
    paper: PaperOptions,
    options: &'a Options,
}

impl Finest<'_> {
    /// The first projection by rays (eq. 6), the relaxation in space (eqs. 7 to 9), and the second projection.
    fn as_printed(&self, run: &mut Run) -> Result<(Projected, Candidate), Error> {
        let (surface, options) = (self.stages.base_surface(), self.options);
        let project = |domain: &_| project::project(surface, domain, None, &options.project);
        let first = run.stage("project", || project(&self.subdivided.domain))?;
        let moved = run.stage("relax", || relax::relax_in_space(surface, &first.domain, &self.paper.quadric()))?;
        let mut second = run.stage("project", || project(&moved.domain))?.domain;
        if let Some(proxy) = self.stages.proxy.as_deref() {
            second = run.stage("project", || proxy.carried(&second, &self.stages.surface))?;
        }
        let inverted = relax::inverted(&self.stages.surface, &second)?;
        let quality = |ar_mean| Quality { ar_mean, ..Quality::default() };
        let [start, after_quadric] = moved.ar_mean.map(quality);
        let end = Quality { inverted: inverted.len(), ..after_quadric };
        let report = RelaxReport { start, after_quadric, end, quadric_iterations: moved.iterations, shape_steps: 0 };
        let relaxed = Relaxed { domain: second, inverted, report };
        Ok((first, Candidate::new(&self.input.reference, self.stages, relaxed)))
    }
}
