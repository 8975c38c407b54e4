//! The fit and the certificate: what the fit has spoilt is left out of it.

use crate::attempt::Remedy;
use crate::candidate::Candidate;
use crate::raised::Raised;
use crate::run::Run;
use crate::verdict::Verdict;
use crate::{Error, Options};
use certify::{Certificate, Reference};
use fit::{FitReport, Fitted};
use mesh_core::{IdVec, TriMesh, VertexId};
use region_map::{Domain, Surface};
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
    let raised = &candidate.raised;
    // The triangles at raised vertices are judged as they are.
    let mut held = raised.faces(&candidate.relaxed.domain);
    let mut left_out = None;
    let tries = if options.fit.is_some() { TRIES } else { 0 };
    for number in 0..tries {
        let Some(fit_options) = &options.fit else { break };
        let begun = Instant::now();
        let fitted = run.stage("fit", || fit::fit_holding(&candidate.surface, &candidate.relaxed.domain, &held, fit_options))?;
        let Fitted { domain, offsets, mut report } = fitted;
        report.max_offset = report.max_offset.max(raised.greatest());
        let (domain, offsets) = with_raised(raised, &candidate.surface, domain, offsets);
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
    let offsets = IdVec::filled(0.0, domain.mesh.n_vertices());
    let (domain, offsets) = with_raised(raised, &candidate.surface, domain, offsets);
    let certificate = certificate(input, &domain.mesh, options, run)?;
    let fit = options.fit.as_ref().map(|_| FitReport::default());
    let certified = passed(Certified { domain, offsets, fit, certificate })?;
    if let Some(warning) = left_out {
        run.record(Remedy::LeaveUnfitted, None, Verdict::Certified, begun);
        warnings.push(warning);
    }
    Ok(certified)
}

/// A domain and its offsets, with raised vertices that were held.
fn with_raised(
    raised: &Raised,
    surface: &Surface,
    domain: Domain,
    mut offsets: IdVec<VertexId, f64>,
) -> (Domain, IdVec<VertexId, f64>) {
    raised.offsets().for_each(|(v, offset)| offsets[v] = offset);
    (Domain { mesh: raised.mesh(surface, &domain), ..domain }, offsets)
}

fn certificate(input: &Reference, mesh: &TriMesh, options: &Options, run: &mut Run) -> Result<Certificate, Error> {
    run.stage("certify", || certify::certify(input, mesh, options.levels(), &Default::default()))
}

fn passed(certified: Certified) -> Result<Certified, Error> {
    match certified.certificate.failures().first() {
        Some(failure) => Err(Error::NotCertified(failure.to_string())),
        None => Ok(certified),
    }
}

#[cfg(test)]
mod tests {
    use super::super::place::first_candidate;
    use super::*;
    use crate::progress::Watch;
    use certify::{Faults, faulty_faces};
    use glam::DVec3;
    use mesh_core::FaceId;

    /// A sphere's finest level, relaxed.
    fn sphere(options: &Options, run: &mut Run) -> Candidate {
        first_candidate(&fixtures::icosphere(12), options, run).1
    }

    /// A mesh in which a face is a flat tent, with a small triangle for its top that faces inwards.
    fn with_tent(mesh: &TriMesh, face: FaceId, top: DVec3) -> TriMesh {
        const SIZE_OF_TOP: f64 = 0.1;
        let n = mesh.n_vertices() as u32;
        let corners = mesh.face(face);
        let mut positions: Vec<DVec3> = mesh.positions().iter().copied().collect();
        // As from the middle of the face to its corners, but the other way around.
        let mirrored = [corners[0], corners[2], corners[1]];
        positions.extend(mirrored.map(|v| top + (mesh.position(v) - mesh.centroid(face)) * SIZE_OF_TOP));
        let others = mesh.faces().ids().filter(|&f| f != face).map(|f| mesh.face(f).map(|v| v.0));
        let [a, b, c] = corners.map(|v| v.0);
        let [d, e, f] = [n, n + 1, n + 2];
        let tent = [[d, e, f], [a, b, e], [a, e, d], [b, c, f], [b, f, e], [c, a, d], [c, d, f]];
        let faces: Vec<[u32; 3]> = others.chain(tent).collect();
        let positions: Vec<[f64; 3]> = positions.iter().map(|p| p.to_array()).collect();
        TriMesh::from_slices(&positions, &faces).unwrap()
    }

    /// The fit lifts a triangle onto what faces the other way; the second try leaves that triangle where it was, and fits all others.
    #[test]
    fn triangles_that_the_fit_turns_over_are_held_in_the_next_try() {
        let options = Options { base_vertices: Some(12), levels: Some(2), ..Options::default() };
        let mut run = Run::new(Watch::default());
        let candidate = sphere(&options, &mut run);
        let relaxed = &candidate.relaxed.domain;
        let fitted = fit::fit(&candidate.surface, relaxed, options.fit.as_ref().unwrap()).unwrap();
        let face = FaceId(7);
        let reference = Reference::new(with_tent(&relaxed.mesh, face, fitted.domain.mesh.centroid(face))).unwrap();
        assert_eq!(faulty_faces(&reference, &fitted.domain.mesh), Faults { flipped: vec![face], degenerate: Vec::new() });

        let mut warnings = Vec::new();
        let certified = certified(&reference, &candidate, &options, &mut run, &mut warnings).unwrap();
        assert!(certified.fit.is_some_and(|fit| fit.used) && warnings.is_empty(), "{warnings:?}");
        assert!(relaxed.mesh.face(face).iter().all(|&v| certified.offsets[v] == 0.0));
        assert!(certified.offsets.iter().filter(|&&offset| offset != 0.0).count() > relaxed.mesh.n_vertices() / 2);
        let (_, attempts) = run.end(0.0);
        let tried: Vec<Remedy> = attempts.iter().map(|a| a.remedy).collect();
        assert_eq!(tried, [Remedy::Fit]);
    }
}
