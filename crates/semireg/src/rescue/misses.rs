//! Places where a result misses the input by more than a person accepts, or a sharp edge of it, or cuts itself: the base mesh gets vertices there,
//! and nowhere else.

use super::mender::Mender;
use super::places::mended;
use super::together::matched;
use crate::attempt::{EdgeChoice, Remedy};
use crate::candidate::Candidate;
use crate::run::Run;
use crate::{Error, Options};
use certify::{ACCEPTED_SHARP_COVER, Reference, SharpEdges, mean_edge};
use glam::DVec3;
use mesh_core::FaceId;
use std::time::Instant;

/// Distances are kept below this share of what is accepted: the measure of a result takes other points than these.
const MARGIN: f64 = 0.96;
/// Sharp edges are followed until this share of what may be missing is: for the same reason.
const MISSING: f64 = 0.5;
/// Distances that differ by less than this share are the same.
const AS_FAR: f64 = 0.05;
/// Rounds of bisection at most. Each halves the edges under what is missed, and so the distance or better.
const ROUNDS: usize = 6;
/// So many rounds one after the other may miss as much as the best before: what is snapped to changes with each, and may be less for once.
const MOST_IN_VAIN: usize = 1;
/// The base mesh grows by this share at most: where more is missed, the whole result is too coarse for the shape.
const MOST_GROWTH: f64 = 0.5;
/// How far around a place where a finer base mesh has faulty triangles nothing is refined any more, in base edges. Less leaves vertices beside it that
/// fold it again, more leaves what is missed elsewhere.
const AROUND: f64 = 2.0;

/// Finishes a candidate by `finish`, and refines its base mesh where the result misses the input, as long as that helps. The result that misses
/// least is kept.
///
/// `sharp` are the edges of the input that a person sees as sharp.
///
/// Only where no number of base vertices is asked for, or a distance is: else that number holds. Of a result that the certificate refuses nobody
/// asks what it misses; and one that had to be nudged would fold on a finer base mesh.
pub(crate) fn followed(
    input: &Reference,
    start: Candidate,
    sharp: &SharpEdges,
    options: &Options,
    run: &mut Run,
    mut finish: impl FnMut(Candidate, &mut Run) -> Result<Candidate, Error>,
) -> Result<Candidate, Error> {
    let is_number_kept = options.base_vertices.is_some() && options.max_distance.is_none();
    if is_number_kept || options.base_mesh.is_some() {
        return finish(start, run);
    }
    let mut best = finish(start.clone(), run)?;
    if best.n_faults() > 0 || best.is_nudged {
        return Ok(best);
    }
    let mender = Mender::new(input, options, &start, MOST_GROWTH, "it misses the input or a sharp edge somewhere");
    let mut now = start;
    let missed = |candidate: &Candidate| {
        let mesh = &candidate.relaxed.domain.mesh;
        let accepted = MARGIN * options.accepted_distance(input.diagonal(), mean_edge(mesh));
        missed(input, sharp, candidate, accepted)
    };
    let mut last = missed(&best);
    let mut least = last.clone();
    let base_edge = f64::from(1 << options.levels()) * mean_edge(&now.relaxed.domain.mesh);
    let mut spoilt = Spoilt { middles: Vec::new(), reach: AROUND * base_edge };
    let mut in_vain = 0;
    for _ in 0..ROUNDS {
        let faces = spoilt.without_those_near(&now, &last.faces);
        if faces.is_empty() {
            break;
        }
        let begun = Instant::now();
        // The triangles of the finished candidate are those of the one before, in other places.
        let Some(refined) = mender.refined(&now, &faces, EdgeChoice::OnArc)? else { break };
        let refined = mended(input, matched(input, refined, options)?, options, run)?;
        let finished = if refined.n_faults() == 0 { finish(refined.clone(), run)? } else { refined.clone() };
        run.record(Remedy::BisectBase(EdgeChoice::OnArc), None, finished.verdict(), begun);
        if finished.n_faults() > 0 {
            spoilt.take(&finished);
            continue;
        }
        let missed = missed(&finished);
        if missed.is_less_than(&least) {
            (best, least, in_vain) = (finished, missed.clone(), 0);
        } else {
            in_vain += 1;
        }
        if in_vain > MOST_IN_VAIN {
            break;
        }
        (now, last) = (refined, missed);
    }
    Ok(best)
}

/// Places where a finer base mesh has faulty triangles: there the input is missed rather than the result refused.
struct Spoilt {
    /// The middles of these triangles.
    middles: Vec<DVec3>,
    /// How far around them nothing is refined, a length.
    reach: f64,
}

impl Spoilt {
    fn take(&mut self, candidate: &Candidate) {
        self.middles.extend(candidate.faults.faces().into_iter().map(|f| candidate.relaxed.domain.mesh.centroid(f)));
    }

    /// Those of some triangles that are in none of these places, in their order.
    fn without_those_near(&self, candidate: &Candidate, faces: &[FaceId]) -> Vec<FaceId> {
        let mesh = &candidate.relaxed.domain.mesh;
        let is_near = |f: FaceId| self.middles.iter().any(|m| m.distance(mesh.centroid(f)) < self.reach);
        faces.iter().copied().filter(|&f| !is_near(f)).collect()
    }
}

/// Where a result misses the input, or a sharp edge of it, or cuts itself where the input does not.
#[derive(Clone)]
struct Misses {
    /// The triangles there, in rising order.
    faces: Vec<FaceId>,
    /// The greatest distance over the one that is accepted, 0 where none is greater.
    greatest: f64,
}

impl Misses {
    /// Distance first, then how many triangles miss something: of a place that stays as it is the distance changes by rounding alone.
    fn is_less_than(&self, other: &Self) -> bool {
        let is_as_far = (self.greatest - other.greatest).abs() <= AS_FAR * other.greatest;
        if is_as_far { self.faces.len() < other.faces.len() } else { self.greatest < other.greatest }
    }
}

/// Where a result is farther from the input than what is accepted, a length.
fn missed(input: &Reference, sharp: &SharpEdges, candidate: &Candidate, accepted: f64) -> Misses {
    let mesh = &candidate.relaxed.domain.mesh;
    let far = certify::missed(input, mesh, accepted);
    let of_sharp_edges = sharp.missed(mesh, 1.0 - MISSING * (1.0 - ACCEPTED_SHARP_COVER));
    let mut faces = [far.faces, of_sharp_edges, certify::new_cuts(input, mesh)].concat();
    faces.sort_unstable();
    faces.dedup();
    Misses { faces, greatest: far.greatest / accepted }
}
