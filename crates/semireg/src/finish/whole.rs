//! All stages after the base mesh, straight through.

use super::fitting::{Certified, certified};
use super::place::{Placed, placed};
use super::snapping::{seen, snapped};
use crate::base::{Base, BaseStages, Way};
use crate::candidate::Candidate;
use crate::input::Input;
use crate::remeshed::{Remeshed, Stages};
use crate::report::Report;
use crate::rescue::{NextStage, followed, joined, matched, mended};
use crate::run::{Run, StageSeconds};
use crate::{Error, Options};
use certify::{SharpEdges, Shortcoming};
use mesh_core::TriMesh;
use project::ProjectReport;

/// Makes the finest level of a base mesh. Nothing is returned that the certificate refuses.
pub(crate) fn finished(input: &Input, stages: &BaseStages, options: &Options, run: &mut Run) -> Result<Remeshed, Error> {
    let Placed { subdivided, projected, project, candidate } = placed(input, stages, options, run)?;
    let candidate = matched(&input.reference, candidate, options)?;
    let candidate = mended(&input.reference, candidate, options, run)?;
    NextStage::Snap.is_worth(candidate.n_faults(), candidate.n_triangles())?;
    let sharp = seen_edges(input, &candidate.relaxed.domain.mesh, options);
    // However the base mesh is refined, the surface stays.
    let seen = seen(&candidate.surface, &sharp);
    let finish = |candidate, run: &mut Run| {
        let snapped = snapped(&input.reference, candidate, &seen, &options.relax, run);
        joined(&input.reference, snapped, &options.relax.shape)
    };
    let candidate = followed(&input.reference, candidate, &sharp, options, run, finish)?;
    let mut warnings = stages.warnings.clone();
    warnings.extend(candidate.unsnapped.iter().map(|why| format!("bends and minor creases were left as they came out: {why}")));
    if candidate.is_released {
        warnings.push("creases are not followed in full where triangles beside them would have folded".into());
    }
    warnings.extend(candidate.raised.warning(input.reference.diagonal()));
    candidate.check()?;
    let certified = certified(&input.reference, &candidate, options, run, &mut warnings);
    let certified = certified.map_err(|e| on_its_base(e, stages))?;
    Ok(assembled(input, stages, Starts { subdivided, projected, project }, candidate, certified, options, warnings))
}

/// The edges of the input that a person sees as sharp, as far as a result can tell them from round ones. Who wants no creases misses none.
fn seen_edges(input: &Input, result: &TriMesh, options: &Options) -> SharpEdges {
    if !options.features.finds_creases() {
        return SharpEdges::none();
    }
    SharpEdges::new(&input.cleaned.mesh, certify::mean_edge(result))
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
    options: &Options,
    mut warnings: Vec<String>,
) -> Remeshed {
    let Certified { domain, offsets, fit, certificate } = certified;
    let edge = certify::mean_edge(&domain.mesh);
    let sharp_edges = seen_edges(input, &domain.mesh, options).cover(&domain.mesh);
    let diagonal = input.cleaned.mesh.diagonal();
    let accepted = options.accepted_distance(1.0, edge / diagonal);
    let shortcomings = Shortcoming::all(&certificate.measures, sharp_edges, accepted);
    warnings.extend(input.warnings());
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
        sharp_edges,
        shortcomings,
        sizes: Vec::new(),
        seconds: StageSeconds::default(),
    };
    let base = BaseStages { base: candidate.base, counts: candidate.counts, ..stages.clone() };
    let Starts { subdivided, projected, .. } = starts;
    let (surface, source_face) = (candidate.surface, input.source_face.clone());
    let stages = Stages { base, subdivided, projected, surface, source_face, region: domain.region, offsets };
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

#[cfg(test)]
mod tests {
    use super::super::place::first_candidate;
    use super::*;
    use crate::candidate::Candidate;
    use crate::progress::Watch;
    use mesh_core::VertexId;

    /// What is pulled off the surface in the first result gets base vertices; where a number is asked for it holds.
    #[test]
    fn the_base_mesh_is_refined_where_a_result_misses_the_input() {
        let asked = Options { base_vertices: Some(24), levels: Some(2), ..Options::default() };
        let mut run = Run::new(Watch::default());
        let (input, start) = first_candidate(&fixtures::cylinder(0.5, 1.5, 96), &asked, &mut run);
        let n = start.base.mesh().n_vertices();
        let pulled = |mut candidate: Candidate, _: &mut Run| {
            if candidate.base.mesh().n_vertices() == n {
                let mut positions: Vec<glam::DVec3> = candidate.relaxed.domain.mesh.positions().iter().copied().collect();
                positions.iter_mut().take(1).for_each(|p| *p *= 1.5);
                candidate.relaxed.domain.mesh = candidate.relaxed.domain.mesh.with_positions(positions).unwrap();
            }
            Ok(candidate)
        };
        let mut after = |options: &Options| {
            followed(&input.reference, start.clone(), &SharpEdges::none(), options, &mut run, pulled).unwrap()
        };
        let greatest = |result: &Candidate| certify::missed(&input.reference, &result.relaxed.domain.mesh, 0.0).greatest;
        let as_asked = after(&asked);
        assert_eq!(as_asked.base.mesh().n_vertices(), n);
        let refined = after(&Options { base_vertices: None, ..asked.clone() });
        let grown = refined.base.mesh().n_vertices() - n;
        assert!((1..=n / 2).contains(&grown) && refined.n_faults() == 0, "{grown}");
        assert!(greatest(&refined) < 0.5 * greatest(&as_asked), "{} {}", greatest(&refined), greatest(&as_asked));
        certify::connectivity(&refined.relaxed.domain.mesh, 2).unwrap();
    }

    /// Where a finer base mesh folds the input stays missed; what is missed elsewhere is followed all the same.
    #[test]
    fn a_place_that_folds_is_left_as_it_is() {
        let asked = Options { base_vertices: Some(150), levels: Some(2), ..Options::default() };
        let mut run = Run::new(Watch::default());
        let (input, start) = first_candidate(&fixtures::cylinder(0.5, 3.0, 96), &asked, &mut run);
        let base = start.base.mesh().clone();
        let vertices = || base.positions().ids();
        let lowest = vertices().min_by(|&v, &w| base.position(v).z.total_cmp(&base.position(w).z)).unwrap();
        let highest = vertices().max_by(|&v, &w| base.position(v).z.total_cmp(&base.position(w).z)).unwrap();
        let is_refined_at = |candidate: &Candidate, v: VertexId| {
            let new = candidate.base.mesh().positions().iter().skip(base.n_vertices()).copied();
            new.into_iter().any(|p| p.distance(base.position(v)) < 0.5)
        };
        // Both ends are pulled off the surface until they are refined, and the upper one folds then.
        let pulled = |mut candidate: Candidate, _: &mut Run| {
            let mut positions = candidate.relaxed.domain.mesh.positions().clone();
            let ends = [lowest, highest].into_iter().filter(|&v| !is_refined_at(&candidate, v));
            ends.for_each(|v| positions[v] *= 1.5);
            if is_refined_at(&candidate, highest) {
                candidate.faults.flipped.extend(candidate.relaxed.domain.topology.faces_at(highest).take(1));
            }
            candidate.relaxed.domain.mesh = candidate.relaxed.domain.mesh.with_positions(positions.into_vec()).unwrap();
            Ok(candidate)
        };
        let ours = Options { base_vertices: None, ..asked };
        let followed = followed(&input.reference, start, &SharpEdges::none(), &ours, &mut run, pulled).unwrap();
        assert_eq!(followed.n_faults(), 0);
        let at = [lowest, highest].map(|v| is_refined_at(&followed, v));
        assert_eq!(at, [true, false]);
    }
}
