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
use mesh_core::FaceId;
use std::time::Instant;

/// Distances are kept below this share of what is accepted: the measure of a result takes other points than these.
const MARGIN: f64 = 0.96;
/// Sharp edges are followed until this share of what may be missing is: for the same reason.
const MISSING: f64 = 0.5;
/// Rounds of bisection at most. Each halves the edges under what is missed, and so the distance or better.
const ROUNDS: usize = 6;
/// The base mesh grows by this share at most: where more is missed, the whole result is too coarse for the shape.
const MOST_GROWTH: f64 = 0.5;

/// Finishes a candidate by `finish`, and refines its base mesh where the result misses the input, as long as that helps. The result that misses
/// least is kept.
///
/// Only where no number of base vertices is asked for, or a distance is: else that number holds. Of a result that the certificate refuses nobody
/// asks what it misses.
pub(crate) fn followed(
    input: &Reference,
    start: Candidate,
    options: &Options,
    run: &mut Run,
    mut finish: impl FnMut(Candidate, &mut Run) -> Result<Candidate, Error>,
) -> Result<Candidate, Error> {
    let is_number_kept = options.base_vertices.is_some() && options.max_distance.is_none();
    if is_number_kept || options.base_mesh.is_some() {
        return finish(start, run);
    }
    let mut best = finish(start.clone(), run)?;
    if best.n_faults() > 0 {
        return Ok(best);
    }
    let mender = Mender::new(input, options, &start, MOST_GROWTH, "it misses the input or a sharp edge somewhere");
    let mut now = start;
    let sharp = options.features.finds_creases().then(|| SharpEdges::new(input.mesh(), mean_edge(&best.relaxed.domain.mesh)));
    let missed = |candidate: &Candidate| {
        let mesh = &candidate.relaxed.domain.mesh;
        let accepted = MARGIN * options.accepted_distance(input.diagonal(), mean_edge(mesh));
        missed(input, sharp.as_ref(), candidate, accepted)
    };
    let mut last = missed(&best);
    let mut least = last.badness();
    for _ in 0..ROUNDS {
        if last.faces.is_empty() {
            break;
        }
        let begun = Instant::now();
        // The triangles of the finished candidate are those of the one before, in other places.
        let Some(refined) = mender.refined(&now, &last.faces, EdgeChoice::OnArc)? else { break };
        let refined = mended(input, matched(input, refined, options)?, options, run)?;
        let finished = finish(refined.clone(), run)?;
        run.record(Remedy::BisectBase(EdgeChoice::OnArc), None, finished.verdict(), begun);
        if finished.n_faults() > 0 {
            break;
        }
        let missed = missed(&finished);
        let helps = missed.greatest < last.greatest || missed.faces.len() < last.faces.len();
        if !helps {
            break;
        }
        if missed.badness() < least {
            (best, least) = (finished, missed.badness());
        }
        (now, last) = (refined, missed);
    }
    Ok(best)
}

/// Where a result misses the input, or a sharp edge of it, or cuts itself where the input does not.
struct Misses {
    /// The triangles there, in rising order.
    faces: Vec<FaceId>,
    /// The greatest distance over the one that is accepted, 0 where none is greater.
    greatest: f64,
}

impl Misses {
    /// The less the better: distance first, then how much of the sharp edges is missing.
    fn badness(&self) -> (f64, usize) {
        (self.greatest, self.faces.len())
    }
}

/// Where a result is farther from the input than what is accepted, a length.
fn missed(input: &Reference, sharp: Option<&SharpEdges>, candidate: &Candidate, accepted: f64) -> Misses {
    let mesh = &candidate.relaxed.domain.mesh;
    let far = certify::missed(input, mesh, accepted);
    let of_sharp_edges = sharp.map(|sharp| sharp.missed(mesh, 1.0 - MISSING * (1.0 - ACCEPTED_SHARP_COVER)));
    let mut faces = [far.faces, of_sharp_edges.unwrap_or_default(), certify::new_cuts(input, mesh)].concat();
    faces.sort_unstable();
    faces.dedup();
    Misses { faces, greatest: far.greatest / accepted }
}
