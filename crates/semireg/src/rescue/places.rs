//! Single places with faulty triangles: relaxed once more on their own, and on a base mesh with a few more vertices under them.

use super::mender::Mender;
use crate::attempt::{EdgeChoice, Remedy};
use crate::candidate::Candidate;
use crate::run::Run;
use crate::{Error, Options};
use certify::{Faults, Reference};
use mesh_core::{FaceId, Topology};
use std::time::Instant;

/// What is tried at most. Most places come free at the first or second try, without a new vertex.
const MOST_TRIES: usize = 30;
/// What is tried in turn, each time from the best there was, until fewer triangles are faulty. Another reach often frees what the first did
/// not, at no cost in base vertices. At a tip another edge leaves more triangles in the same angle.
const IN_TURN: [Remedy; 6] = [
    Remedy::RelaxPlaces(1.0),
    Remedy::RelaxPlaces(0.5),
    Remedy::RelaxPlaces(2.0),
    Remedy::BisectBase(EdgeChoice::Longest),
    Remedy::BisectBase(EdgeChoice::AtTip),
    Remedy::BisectBase(EdgeChoice::Shortest),
];
/// Where a greater share of the triangles is faulty the base mesh is wrong, not a few of its faces.
const MOST_FAULTY: f64 = 2e-3;
/// The base mesh grows by this share at most: more would be another base mesh than the one asked for.
const MOST_GROWTH: f64 = 0.03;

/// Mends the places of a candidate that the certificate would refuse. Vertices far from them stay where they are. The candidate comes back as
/// it was where there are none, or so many that the base mesh is wrong; and on a base mesh from elsewhere, which stays as it is.
///
/// First the triangles around are relaxed by themselves: among hundreds of thousands a few have little say. Then the base faces under them
/// are bisected. No vertex of the finest level is lost by that, new ones come in the middle of edges, and so the relaxed places are the
/// start of the next try.
pub(crate) fn mended(input: &Reference, start: Candidate, options: &Options, run: &mut Run) -> Result<Candidate, Error> {
    if options.base_mesh.is_some() || start.n_faults() as f64 > MOST_FAULTY * start.n_triangles() as f64 {
        return Ok(start);
    }
    let mender = Mender::new(input, options, &start, MOST_GROWTH, "a few triangles stay folded");
    let (mut best, mut hopeless, mut tried) = (start, 0, 0);
    for _ in 0..MOST_TRIES {
        // Groups that all tries have failed on come first.
        let groups = groups(&best.faults, &best.relaxed.domain.topology);
        let Some(faces) = groups.get(hopeless) else { break };
        let Some(&remedy) = IN_TURN.get(tried) else {
            (hopeless, tried) = (hopeless + 1, 0);
            continue;
        };
        tried += 1;
        let begun = Instant::now();
        let tried_now = match remedy {
            Remedy::RelaxPlaces(reach) => mender.relaxed(&best, faces, reach).map(Some),
            Remedy::BisectBase(choice) => mender.refined(&best, faces, choice),
            _ => Ok(None),
        };
        let Some(now) = tried_now? else { continue };
        run.record(remedy, None, now.verdict(), begun);
        if now.n_faults() < best.n_faults() {
            tried = 0;
        }
        if now.n_faults() <= best.n_faults() {
            best = now;
        }
    }
    Ok(best)
}

/// What is mended at once: first all, then every cluster by itself, as what frees one may spoil another.
fn groups(faults: &Faults, topology: &Topology) -> Vec<Vec<FaceId>> {
    let faces = faults.faces();
    let clusters = topology.clusters(&faces);
    if clusters.len() < 2 { clusters } else { [vec![faces], clusters].concat() }
}
