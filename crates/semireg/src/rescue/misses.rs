//! Places where a result misses the input by more than a person accepts: the base mesh gets vertices there, and nowhere else.

use super::mender::Mender;
use crate::attempt::{EdgeChoice, Remedy};
use crate::candidate::Candidate;
use crate::run::Run;
use crate::{Error, Options};
use certify::{Missed, Reference};
use mesh_core::{TriMesh, equilateral_edge_length};
use std::time::Instant;

/// A distance of this share of the diagonal is accepted anywhere: hardly anybody sees it. More leaves more chords across rims and holes.
const UNSEEN: f64 = 2.4e-3;
/// And so is this share of a mean edge of the finest level: edges of that length don't follow what is smaller.
const OF_EDGE: f64 = 0.24;
/// Rounds of bisection at most. Each halves the edges under what is missed, and so the distance or better.
const ROUNDS: usize = 6;
/// The base mesh grows by this share at most: where more is missed, the whole result is too coarse for the shape.
const MOST_GROWTH: f64 = 0.1;

/// Finishes a candidate by `finish`, and refines its base mesh where the result misses the input, as long as that helps. The result that misses
/// least is kept.
///
/// Only where no number of base vertices is asked for: else that number holds.
pub(crate) fn followed(
    input: &Reference,
    start: Candidate,
    options: &Options,
    run: &mut Run,
    mut finish: impl FnMut(Candidate, &mut Run) -> Candidate,
) -> Result<Candidate, Error> {
    if options.base_vertices.is_some() || options.base_mesh.is_some() {
        return Ok(finish(start, run));
    }
    let mut best = finish(start.clone(), run);
    let mender = Mender::new(input, options, &start, MOST_GROWTH, "it misses the input somewhere");
    let (n_faults, mut now) = (best.n_faults(), start);
    let mut last = missed(input, &best.relaxed.domain.mesh);
    let mut least = last.greatest;
    for _ in 0..ROUNDS {
        if last.faces.is_empty() {
            break;
        }
        let begun = Instant::now();
        // The triangles of the finished candidate are those of the one before, in other places.
        let Some(refined) = mender.refined(&now, &last.faces, EdgeChoice::OnArc)? else { break };
        let finished = finish(refined.clone(), run);
        let missed = missed(input, &finished.relaxed.domain.mesh);
        run.record(Remedy::BisectBase(EdgeChoice::OnArc), None, finished.verdict(), begun);
        let helps = missed.greatest < last.greatest || missed.faces.len() < last.faces.len();
        if finished.n_faults() > n_faults || !helps {
            break;
        }
        if missed.greatest < least {
            (best, least) = (finished, missed.greatest);
        }
        (now, last) = (refined, missed);
    }
    Ok(best)
}

/// Where a mesh misses the input by more than is accepted.
fn missed(input: &Reference, mesh: &TriMesh) -> Missed {
    let edge = equilateral_edge_length(mesh.total_area(), mesh.n_faces() / 2);
    certify::missed(input, mesh, (UNSEEN * input.diagonal()).max(OF_EDGE * edge))
}
