//! All stages after the base mesh, straight through.

use super::fitting::{Certified, certified};
use super::place::{Placed, placed};
use super::snapping::snapped;
use crate::base::{Base, BaseStages, Way};
use crate::candidate::Candidate;
use crate::input::Input;
use crate::remeshed::{Remeshed, Stages};
use crate::report::Report;
use crate::rescue::{NextStage, mended};
use crate::run::{Run, StageSeconds};
use crate::{Error, Options};
use mesh_core::TriMesh;
use project::ProjectReport;

/// Makes the finest level of a base mesh. Nothing is returned that the certificate refuses.
pub(crate) fn finished(input: &Input, stages: &BaseStages, options: &Options, run: &mut Run) -> Result<Remeshed, Error> {
    let Placed { subdivided, projected, project, candidate } = placed(input, stages, options, run)?;
    let candidate = match stages.way {
        // A base mesh from elsewhere stays as it is.
        Way::Given => candidate,
        _ => mended(&input.reference, candidate, options, run)?,
    };
    NextStage::Snap.is_worth(candidate.relaxed.inverted.len(), candidate.n_triangles())?;
    let mut warnings = stages.warnings.clone();
    let candidate = snapped(&input.reference, candidate, &options.relax, run, &mut warnings);
    NextStage::Fit.is_worth(candidate.faults.flipped.len(), candidate.n_triangles())?;
    let certified = certified(&input.reference, &candidate, options, run, &mut warnings);
    let certified = certified.map_err(|e| on_its_base(e, stages))?;
    Ok(assembled(input, stages, Starts { subdivided, projected, project }, candidate, certified, warnings))
}

/// The finest level before its relaxation.
pub(super) struct Starts {
    pub(super) subdivided: TriMesh,
    pub(super) projected: TriMesh,
    pub(super) project: ProjectReport,
}

/// A certified candidate with all that led to it.
pub(super) fn assembled(
    input: &Input,
    stages: &BaseStages,
    starts: Starts,
    candidate: Candidate,
    certified: Certified,
    warnings: Vec<String>,
) -> Remeshed {
    let Certified { domain, offsets, fit, certificate } = certified;
    let report = Report {
        clean: input.cleaned.report.clone(),
        base: candidate.counts.clone(),
        way: stages.way,
        cells: stages.cell_counts(),
        crease_lengths: stages.crease_lengths(),
        attempts: Vec::new(),
        warnings,
        project: starts.project,
        relax: candidate.relaxed.report,
        snapped: candidate.snapped,
        fit,
        certificate,
        seconds: StageSeconds::default(),
    };
    let base = BaseStages { base: candidate.base, counts: candidate.counts, ..stages.clone() };
    let Starts { subdivided, projected, .. } = starts;
    let stages = Stages { base, subdivided, projected, surface: candidate.surface, region: domain.region, offsets };
    Remeshed { mesh: domain.mesh, report, stages }
}

/// The error of a result; on a base mesh that was given it asks for another one.
pub(super) fn on_its_base(error: Error, stages: &BaseStages) -> Error {
    match (error, stages.way) {
        (Error::NotCertified(failure), Way::Given) => {
            let untraced = match &*stages.base {
                Base::Unmapped { reason, .. } => format!(" (placed by rays: {reason})"),
                Base::Mapped(_) => String::new(),
            };
            Error::BaseNotCertified { failure, untraced }
        }
        (error, _) => error,
    }
}
