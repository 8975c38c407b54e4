//! The fit and the certificate: what the fit has spoilt is left out of it.

use crate::attempt::Remedy;
use crate::candidate::Candidate;
use crate::run::Run;
use crate::verdict::Verdict;
use crate::{Error, Options};
use certify::{Certificate, Reference};
use fit::{FitReport, Fitted};
use mesh_core::{FaceId, IdVec, TriMesh, VertexId};
use region_map::Domain;
use std::time::Instant;

/// So often the fit is tried, each time with the triangles held that it turned over before.
const TRIES: usize = 3;

/// A certified domain.
pub(super) struct Certified {
    pub(super) domain: Domain,
    /// How far each vertex is off its point of the surface.
    pub(super) offsets: IdVec<VertexId, f64>,
    /// `None` where no fit was asked for.
    pub(super) fit: Option<FitReport>,
    pub(super) certificate: Certificate,
}

/// Fits a candidate, where the options ask for it, and certifies it. Fails where it is refused with and without the fit.
pub(super) fn certified(
    input: &Reference,
    candidate: &Candidate,
    options: &Options,
    run: &mut Run,
    warnings: &mut Vec<String>,
) -> Result<Certified, Error> {
    let mut held: Vec<FaceId> = Vec::new();
    let mut left_out = None;
    let tries = if options.fit.is_some() { TRIES } else { 0 };
    for number in 0..tries {
        let Some(fit_options) = &options.fit else { break };
        let begun = Instant::now();
        let fitted = run.stage("fit", || fit::fit_holding(&candidate.surface, &candidate.relaxed.domain, &held, fit_options))?;
        let Fitted { domain, offsets, report } = fitted;
        let certificate = certificate(input, &domain.mesh, options, run)?;
        let Some(failure) = certificate.failures().first().filter(|_| report.used) else {
            return passed(Certified { domain, offsets, fit: Some(report), certificate });
        };
        left_out = Some(format!("the fit was left out: with it, {failure}"));
        let verdict = Verdict::Failed { reason: failure.to_string() };
        run.record(if number == 0 { Remedy::Fit } else { Remedy::HoldFaces }, None, verdict, begun);
        match certificate.measures.flipped {
            Some(flipped) if !flipped.is_empty() => held.extend(flipped),
            _ => break,
        }
    }
    let domain = candidate.relaxed.domain.clone();
    let begun = Instant::now();
    let certificate = certificate(input, &domain.mesh, options, run)?;
    let offsets = IdVec::filled(0.0, domain.mesh.n_vertices());
    let fit = options.fit.as_ref().map(|_| FitReport::default());
    let certified = passed(Certified { domain, offsets, fit, certificate })?;
    if let Some(warning) = left_out {
        run.record(Remedy::LeaveUnfitted, None, Verdict::Certified, begun);
        warnings.push(warning);
    }
    Ok(certified)
}

fn certificate(input: &Reference, mesh: &TriMesh, options: &Options, run: &mut Run) -> Result<Certificate, Error> {
    run.stage("certify", || certify::certify(input, mesh, options.levels, &Default::default()))
}

fn passed(certified: Certified) -> Result<Certified, Error> {
    match certified.certificate.failures().first() {
        Some(failure) => Err(Error::NotCertified(failure.to_string())),
        None => Ok(certified),
    }
}
