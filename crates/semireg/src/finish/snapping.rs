//! The relaxed domain hung on bends and minor creases, as far as its triangles bear it.

use super::levels::again;
use crate::Error;
use crate::attempt::Remedy;
use crate::candidate::Candidate;
use crate::report::SnapCounts;
use crate::rescue::on_touching_arcs;
use crate::run::Run;
use certify::{Reference, SharpEdges};
use mesh_core::{EdgeId, FaceId, TriMesh};
use region_map::Surface;
use relax::RelaxOptions;
use snap::{LetGo, SnapOptions, Snapped};
use std::collections::BTreeSet;
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
const ROUNDS: usize = 5;
/// So often while there are more triangles that the certificate refuses than before snapping: each further time creases are let go in twice as many
/// rings of triangles around these. Measured, CesiumMilkTruck: with four rounds it lost all of its bends and minor creases.
const MOST_ROUNDS: usize = 7;
/// Where there is nothing to let go of beside these, it is looked for in so many rings of triangles around them at most.
const MOST_RINGS: usize = 8;

/// Snaps a candidate to bends and minor creases and relaxes it again. It comes back as it was where there are none, where the certificate
/// would refuse more triangles than before, or where snapping fails; of the last two it tells.
///
/// `seen` are the edges of minor creases that a person sees as sharp.
pub(super) fn snapped(
    input: &Reference,
    before: Candidate,
    seen: &BTreeSet<EdgeId>,
    options: &RelaxOptions,
    run: &mut Run,
) -> Candidate {
    let unsnapped = match rounds(input, &before, seen, options, run) {
        Ok(Some(snapped)) if snapped.n_faults() <= before.n_faults() => return snapped,
        Ok(None) => return before,
        Ok(Some(_)) => "some triangles did not bear them".to_string(),
        Err(e) => e.to_string(),
    };
    Candidate { unsnapped: Some(unsnapped), ..before }
}

/// The round of snapping with the fewest triangles that the certificate would refuse; `None` where there is nothing to snap to.
fn rounds(
    input: &Reference,
    before: &Candidate,
    seen: &BTreeSet<EdgeId>,
    options: &RelaxOptions,
    run: &mut Run,
) -> Result<Option<Candidate>, Error> {
    let mut few_steps = again(options);
    (few_steps.shape.steps, few_steps.shape.untangling_steps) = (STEPS, UNTANGLING_STEPS);
    let snap_options = SnapOptions::default();
    let start = &before.relaxed.domain;
    let (mut let_go, mut best) = (LetGo { bends: on_touching_arcs(&before.surface), ..LetGo::default() }, None);
    for round in 1..=MOST_ROUNDS {
        let begun = Instant::now();
        let snapped = snap::snap(&before.surface, start, seen, &let_go, &snap_options)?;
        if snapped.is_unchanged() {
            break;
        }
        let now = relaxed_again(input, before, &snapped, &few_steps)?;
        run.record(if round == 1 { Remedy::Snap } else { Remedy::LetGoCreases }, None, now.verdict(), begun);
        let is_borne = now.n_faults() <= before.n_faults();
        let refused = if is_borne { Vec::new() } else { now.faults.faces() };
        let poor = poor(&snapped, [&start.mesh, &now.relaxed.domain.mesh], &refused, rings(round), &snap_options)?;
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

/// The edges of minor creases of a surface that are parts of sharp edges.
pub(super) fn seen(surface: &Surface, sharp: &SharpEdges) -> BTreeSet<EdgeId> {
    let (mesh, topology) = (surface.mesh(), surface.topology());
    let ends = surface.network().minor.iter().flat_map(|chain| chain.windows(2).map(|ends| [ends[0], ends[1]]));
    let edges: Vec<EdgeId> = ends.filter_map(|[a, b]| topology.find_edge(a, b)).collect();
    let segments: Vec<_> = edges.iter().map(|&e| topology.ends(e).map(|v| mesh.position(v))).collect();
    edges.into_iter().zip(sharp.hold(&segments)).filter_map(|(edge, is_seen)| is_seen.then_some(edge)).collect()
}

/// The rings of triangles around the refused ones in which creases are let go after a round, from 1: none at first, later ever more.
fn rings(round: usize) -> usize {
    round.checked_sub(ROUNDS - 1).map_or(0, |doublings| 1 << doublings)
}

/// What came out poor, or is within so many rings of triangles around the refused ones: more rings where that is nothing.
fn poor(
    snapped: &Snapped,
    before_and_after: [&TriMesh; 2],
    refused: &[FaceId],
    mut rings: usize,
    options: &SnapOptions,
) -> Result<LetGo, Error> {
    loop {
        let poor = snapped.poor(before_and_after, &snapped.domain.topology.widened(refused, rings), options)?;
        if poor != LetGo::default() || refused.is_empty() || rings >= MOST_RINGS {
            return Ok(poor);
        }
        rings = (2 * rings).max(1);
    }
}

/// A snapped domain, relaxed and judged.
fn relaxed_again(input: &Reference, before: &Candidate, snapped: &Snapped, options: &RelaxOptions) -> Result<Candidate, Error> {
    let relaxed = if snapped.domain.mesh.n_faces() < SMALL {
        relax::relax(&snapped.surface, &snapped.domain, options)?
    } else {
        relax::relax_around(&snapped.surface, &snapped.domain, &faces_at(snapped), REACH, &[], &options.shape)?
    };
    let relaxed = relaxed.after(before.relaxed.report);
    let snapped_to = SnapCounts { bends: snapped.bends.len(), minor_creases: snapped.tracks.len() };
    Ok(Candidate { snapped: snapped_to, ..before.clone() }.with(input, snapped.surface.clone(), relaxed))
}

/// The triangles at the vertices that were snapped.
fn faces_at(snapped: &Snapped) -> Vec<FaceId> {
    let on_paths = snapped.tracks.iter().flat_map(|track| track.path.iter().copied());
    let vertices = snapped.bends.iter().map(|bend| bend.vertex).chain(on_paths);
    vertices.flat_map(|v| snapped.domain.topology.faces_at(v)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use mesh_core::VertexId;
    use region_map::{Domain, Network};

    /// A crease on a square of 12 x 12 cells makes no triangle poor. Where one is refused three cells away from it, it is let go of.
    #[test]
    fn what_is_let_go_of_is_looked_for_farther_away_where_nothing_is_near() {
        let positions = (0..169).map(|i| [f64::from(i % 13), f64::from(i / 13), 0.0].into()).collect();
        let cells = (0..144).map(|i| i / 12 * 13 + i % 12);
        let faces = cells.flat_map(|a| [[a, a + 1, a + 14], [a, a + 14, a + 13]]).collect();
        let smooth = Surface::smooth(TriMesh::new(positions, faces).unwrap()).unwrap();
        let row: Vec<VertexId> = (80..89).map(VertexId).collect();
        let surface = smooth.with_network(Network { minor: vec![row], ..smooth.network().clone() }).unwrap();
        let options = SnapOptions { least_depth: 0.0, ..SnapOptions::default() };
        let snapped = snap::snap(&surface, &Domain::identity(&surface), &BTreeSet::new(), &LetGo::default(), &options).unwrap();
        let mesh = &snapped.domain.mesh;
        let n_let_go = |refused: &[FaceId]| poor(&snapped, [mesh, mesh], refused, 0, &options).unwrap().minor.len();
        // A face of the ninth row of cells, three rows above the crease.
        assert_eq!(n_let_go(&[]), 0);
        assert!(n_let_go(&[FaceId(2 * (9 * 12 + 6))]) > 0);
    }
}
