//! Places with faulty triangles: relaxed once more on their own, and on a base mesh with more vertices under them.

use super::mender::Mender;
use crate::attempt::{EdgeChoice, Remedy};
use crate::candidate::Candidate;
use crate::run::Run;
use crate::{Error, Options};
use certify::{Faults, Reference};
use mesh_core::{FaceId, Topology};
use std::time::Instant;

/// What is tried at most, where few triangles are faulty. Most places come free at the first or second try, without a new vertex.
const MOST_TRIES: usize = 30;
/// So many faulty triangles more make a try take as long as two.
const FAULTS_OF_A_TRY: usize = 25;
/// What is tried in turn, each time from the best there was, until fewer triangles are faulty. Another reach often frees what the first did
/// not, at no cost in base vertices.
const RELAXATIONS: [Remedy; 3] = [Remedy::RelaxPlaces(1.0), Remedy::RelaxPlaces(0.5), Remedy::RelaxPlaces(2.0)];
/// What is tried then. At a tip another edge leaves more triangles in the same angle.
const BISECTIONS: [Remedy; 3] =
    [Remedy::BisectBase(EdgeChoice::Longest), Remedy::BisectBase(EdgeChoice::AtTip), Remedy::BisectBase(EdgeChoice::Shortest)];
/// A greater share of faulty triangles is too much for one place after the other.
const FEW: f64 = 2e-3;
/// With a greater share the base mesh is too coarse everywhere. Measured: .004 to .027 of five results went to a tenth or less by one bisection under all of
/// them; .035 of an assembly's stayed, after half a minute.
const MANY: f64 = 0.03;
/// Bisections under all faulty triangles go on while this share of these is left at most. A triangle is half as long in all directions after two.
const LEFT: f64 = 0.8;
/// The base mesh grows by this share at most.
const MOST_GROWTH: f64 = 0.5;
/// The same where the number of its vertices was asked for: more would be another base mesh than that one.
const MOST_GROWTH_OF_ASKED: f64 = 0.25;

/// Mends the places of a candidate that the certificate would refuse. Vertices far from them stay where they are. The candidate comes back as
/// it was where there are none, and on a base mesh from elsewhere, which stays as it is.
///
/// Where there are many, the base mesh is bisected under all of them at once. Where there are few, the triangles around are relaxed by themselves first: among
/// hundreds of thousands they have little say. Then the base faces under them are bisected. No vertex of the finest level is lost by that, new ones come
/// in the middle of edges, and so the relaxed places are the start of the next try.
///
/// What none of this frees is nudged in the end, and so are vertices that would be welded, which are no faulty triangles. Not before: a bisection also
/// brings the triangles nearer to the surface.
pub(crate) fn mended(input: &Reference, start: Candidate, options: &Options, run: &mut Run) -> Result<Candidate, Error> {
    if options.base_mesh.is_some() {
        return Ok(start);
    }
    let mended = if start.n_faults() == 0 { start } else { relaxed_and_refined(input, start, options, run)? };
    let begun = Instant::now();
    let Some(nudged) = mended.nudged(input) else { return Ok(mended) };
    run.record(Remedy::Nudge, None, nudged.verdict(), begun);
    Ok(nudged)
}

/// Relaxes faulty places, and refines the base mesh under them.
fn relaxed_and_refined(input: &Reference, start: Candidate, options: &Options, run: &mut Run) -> Result<Candidate, Error> {
    let growth = if options.base_vertices.is_some() { MOST_GROWTH_OF_ASKED } else { MOST_GROWTH };
    let mender = Mender::new(input, options, &start, growth, "some triangles stay folded");
    let refined = refined_under_all(&mender, start, run)?;
    if !has_at_most(FEW, &refined) {
        return Ok(refined);
    }
    let mended = mended_one_by_one(&mender, refined.clone(), run)?;
    if mended.n_faults() == 0 {
        return Ok(mended);
    }
    let released = without_creases(&mender, &refined, run)?;
    Ok(released.filter(|released| released.n_faults() < mended.n_faults()).unwrap_or(mended))
}

/// Lets go of the creases beside faulty triangles: a crease of noise goes to and fro over a fin, and no triangle beside it faces as the surface does. It
/// starts from what nothing was tried on, as tries squeeze what they cannot unfold. `None` where there are no creases.
fn without_creases(mender: &Mender<'_>, start: &Candidate, run: &mut Run) -> Result<Option<Candidate>, Error> {
    let begun = Instant::now();
    let released = mender.released(start, &start.faults.faces())?;
    if let Some(now) = &released {
        run.record(Remedy::ReleaseCreases, None, now.verdict(), begun);
    }
    Ok(released)
}

/// Whether at most a share of the triangles is faulty.
fn has_at_most(share: f64, candidate: &Candidate) -> bool {
    candidate.n_faults() as f64 <= share * candidate.n_triangles() as f64
}

/// Bisects the base mesh under all faulty triangles, until they are few or hardly get fewer.
///
/// Most of them must be no folds, but large against the gap between two sheets: another sheet lies nearer to their middle than their own. Finer ones
/// lie nearer to their own sheet. Where most are folds the base mesh is wrong.
fn refined_under_all(mender: &Mender<'_>, start: Candidate, run: &mut Run) -> Result<Candidate, Error> {
    let mut now = start;
    while !has_at_most(FEW, &now) && has_at_most(MANY, &now) && !is_mostly_tangled(&now) {
        let (begun, choice) = (Instant::now(), EdgeChoice::Longest);
        let Some(next) = mender.refined(&now, &now.faults.faces(), choice)? else { break };
        run.record(Remedy::BisectBase(choice), None, next.verdict(), begun);
        if next.n_faults() as f64 > LEFT * now.n_faults() as f64 {
            break;
        }
        now = next;
    }
    Ok(now)
}

/// Mends a few places in turn, each by all that is to be tried.
fn mended_one_by_one(mender: &Mender<'_>, start: Candidate, run: &mut Run) -> Result<Candidate, Error> {
    let (mut best, mut hopeless, mut tried, mut spent) = (start, 0, 0, 0);
    while spent < MOST_TRIES {
        // Groups that all tries have failed on come first.
        let groups = groups(&best.faults, &best.relaxed.domain.topology);
        let Some(faces) = groups.get(hopeless) else { break };
        let relaxations = if faces.iter().any(|f| is_tangled(&best, f)) { &RELAXATIONS[..] } else { &[] };
        let Some(&remedy) = relaxations.iter().chain(&BISECTIONS).nth(tried) else {
            (hopeless, tried) = (hopeless + 1, 0);
            continue;
        };
        tried += 1;
        spent += 1 + faces.len() / FAULTS_OF_A_TRY;
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

/// Whether more than half of the faulty triangles are tangled.
fn is_mostly_tangled(candidate: &Candidate) -> bool {
    let faces = candidate.faults.faces();
    2 * faces.iter().filter(|f| is_tangled(candidate, f)).count() > faces.len()
}

/// Whether a triangle faces against its own sheet, or has no area. All other faulty ones are refused for a sheet beside their own: these a relaxation
/// seldom frees.
fn is_tangled(candidate: &Candidate, face: &FaceId) -> bool {
    candidate.relaxed.inverted.contains(face) || candidate.faults.degenerate.contains(face)
}

/// What is mended at once: first all, then every cluster by itself, as what frees one may spoil another.
fn groups(faults: &Faults, topology: &Topology) -> Vec<Vec<FaceId>> {
    let faces = faults.faces();
    let clusters = topology.clusters(&faces);
    if clusters.len() < 2 { clusters } else { [vec![faces], clusters].concat() }
}
