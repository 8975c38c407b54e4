//! The relaxed domain hung on bends and minor creases, as far as its triangles bear it.

use super::levels::again;
use crate::Error;
use crate::attempt::Remedy;
use crate::candidate::Candidate;
use crate::report::SnapCounts;
use crate::rescue::on_touching_arcs;
use crate::run::Run;
use certify::Reference;
use mesh_core::{FaceId, HalfedgeId};
use relax::RelaxOptions;
use snap::{LetGo, SnapOptions, Snapped};
use std::time::Instant;

/// Newton steps after snapping: it moves few vertices, and from a relaxed start. More cost time in each round.
const STEPS: usize = 4;
/// The same while triangles are folded.
const UNTANGLING_STEPS: usize = 8;
/// Vertices up to so many edges away from what was snapped make way. More gives better triangles there, and takes longer.
const REACH: usize = 6;
/// With fewer triangles all vertices make way: that takes little time, and the shape of the whole still gains (spot, 12,500 triangles: mean AR
/// .944 to .950).
const SMALL: usize = 20_000;
/// So often the domain is snapped, each time without what came out poor before. A few poor triangles of the last time are borne: they are
/// not worth all creases.
const ROUNDS: usize = 4;
/// So often while there are more triangles that the certificate refuses than before snapping: each further time creases are let go in twice as many
/// rings of triangles around these. Measured, CesiumMilkTruck: with four rounds it lost all of its bends and minor creases.
const MOST_ROUNDS: usize = 6;

/// Snaps a candidate to bends and minor creases and relaxes it again. It comes back as it was where there are none, where the certificate
/// would refuse more triangles than before, or where snapping fails; of the last two it tells.
pub(super) fn snapped(input: &Reference, before: Candidate, options: &RelaxOptions, run: &mut Run) -> Candidate {
    let unsnapped = match rounds(input, &before, options, run) {
        Ok(Some(snapped)) if snapped.n_faults() <= before.n_faults() => return snapped,
        Ok(None) => return before,
        Ok(Some(_)) => "some triangles did not bear them".to_string(),
        Err(e) => e.to_string(),
    };
    Candidate { unsnapped: Some(unsnapped), ..before }
}

/// The round of snapping with the fewest triangles that the certificate would refuse; `None` where there is nothing to snap to.
fn rounds(input: &Reference, before: &Candidate, options: &RelaxOptions, run: &mut Run) -> Result<Option<Candidate>, Error> {
    let mut few_steps = again(options);
    (few_steps.shape.steps, few_steps.shape.untangling_steps) = (STEPS, UNTANGLING_STEPS);
    let snap_options = SnapOptions::default();
    let start = &before.relaxed.domain;
    let (mut let_go, mut best) = (LetGo { bends: on_touching_arcs(&before.surface), ..LetGo::default() }, None);
    for round in 1..=MOST_ROUNDS {
        let begun = Instant::now();
        let snapped = snap::snap(&before.surface, start, &let_go, &snap_options)?;
        if snapped.is_unchanged() {
            break;
        }
        let now = relaxed_again(input, before, &snapped, &few_steps)?;
        run.record(if round == 1 { Remedy::Snap } else { Remedy::LetGoCreases }, None, now.verdict(), begun);
        let is_borne = now.n_faults() <= before.n_faults();
        let refused = if is_borne { Vec::new() } else { now.faults.faces() };
        let refused = start.topology.widened(&refused, rings(round));
        let poor = snapped.poor([&start.mesh, &now.relaxed.domain.mesh], &refused, &snap_options)?;
        // Of rounds with as many refused triangles the last one has the fewest poor ones.
        if best.as_ref().is_none_or(|best: &Candidate| now.n_faults() <= best.n_faults()) {
            best = Some(now);
        }
        if poor == LetGo::default() || (round >= ROUNDS && is_borne) {
            break;
        }
        let_go.bends.extend(poor.bends);
        let_go.minor.extend(poor.minor);
    }
    Ok(best)
}

/// The rings of triangles around the refused ones in which creases are let go after a round, from 1: none at first, later ever more.
fn rings(round: usize) -> usize {
    round.checked_sub(3).map_or(0, |doublings| 1 << doublings)
}

/// A snapped domain, relaxed and judged.
fn relaxed_again(input: &Reference, before: &Candidate, snapped: &Snapped, options: &RelaxOptions) -> Result<Candidate, Error> {
    let relaxed = if snapped.domain.mesh.n_faces() < SMALL {
        relax::relax(&snapped.surface, &snapped.domain, options)?
    } else {
        relax::relax_around(&snapped.surface, &snapped.domain, &faces_at(snapped), REACH, &options.shape)?
    };
    let relaxed = relaxed.after(before.relaxed.report);
    let snapped_to = SnapCounts { bends: snapped.bends.len(), minor_creases: snapped.tracks.len() };
    Ok(Candidate { snapped: snapped_to, ..before.clone() }.with(input, snapped.surface.clone(), relaxed))
}

/// The triangles at the vertices that were snapped.
fn faces_at(snapped: &Snapped) -> Vec<FaceId> {
    let on_paths = snapped.tracks.iter().flat_map(|track| track.path.iter().copied());
    let vertices = snapped.bends.iter().map(|bend| bend.vertex).chain(on_paths);
    vertices.flat_map(|v| snapped.domain.topology.fan(v).map(HalfedgeId::face)).collect()
}
