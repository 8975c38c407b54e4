//! Single places with faulty triangles: relaxed once more on their own, and on a base mesh with a few more vertices under them.

use crate::attempt::{EdgeChoice, Remedy};
use crate::base::{Base, BaseCounts};
use crate::candidate::Candidate;
use crate::run::Run;
use crate::{Error, Options};
use certify::{Faults, Reference, faulty_faces};
use mesh_core::{FaceId, Id as _, Topology, VertexId};
use region_map::BaseMesh;
use relax::{Relaxed, relax_around};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
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
/// How far around a new base vertex is relaxed, in base edges.
const REACH_OF_BISECTION: f64 = 1.0;
/// Where a greater share of the triangles is faulty the base mesh is wrong, not a few of its faces.
const MOST_FAULTY: f64 = 2e-3;
/// The base mesh grows by this share at most: more would be another base mesh than the one asked for.
const MOST_GROWTH: f64 = 0.03;
/// Or by so many vertices, if that is more.
const LEAST_GROWTH: usize = 8;

/// Mends the places of a candidate that the certificate would refuse. Vertices far from them stay where they are. The candidate comes back as
/// it was where there are none, or so many that the base mesh is wrong.
///
/// First the triangles around are relaxed by themselves: among hundreds of thousands a few have little say. Then the base faces under them
/// are bisected. No vertex of the finest level is lost by that, new ones come in the middle of edges, and so the relaxed places are the
/// start of the next try.
pub(crate) fn mended(input: &Reference, start: Candidate, options: &Options, run: &mut Run) -> Result<Candidate, Error> {
    if start.n_faults() as f64 > MOST_FAULTY * start.n_triangles() as f64 {
        return Ok(start);
    }
    let n = start.base.mesh().n_vertices();
    let most_vertices = n + LEAST_GROWTH.max((MOST_GROWTH * n as f64) as usize);
    let mender = Mender { input, options, most_vertices };
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
        let Some(now) = mender.tried(remedy, &best, faces)? else { continue };
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

/// What the tries have in common.
struct Mender<'a> {
    input: &'a Reference,
    options: &'a Options,
    /// The base mesh must not grow beyond this.
    most_vertices: usize,
}

impl Mender<'_> {
    /// The candidate after a try to free some of its triangles; `None` where there is nothing to try, or too much.
    fn tried(&self, remedy: Remedy, before: &Candidate, faces: &[FaceId]) -> Result<Option<Candidate>, Error> {
        match remedy {
            Remedy::RelaxPlaces(reach) => self.relaxed(before, faces, reach).map(Some),
            Remedy::BisectBase(choice) => {
                let edges = edges_under(before, faces, self.options.levels, choice);
                if before.base.mesh().n_vertices() + edges.len() > self.most_vertices {
                    return Ok(None);
                }
                let Some(bisected) = self.bisected(before, &edges)? else { return Ok(None) };
                self.relaxed(&bisected.candidate, &bisected.new_faces, REACH_OF_BISECTION).map(Some)
            }
            _ => Ok(None),
        }
    }

    /// The surroundings of some triangles relaxed, as far as so many base edges.
    fn relaxed(&self, before: &Candidate, faces: &[FaceId], reach: f64) -> Result<Candidate, Error> {
        let edges = (reach * f64::from(1 << self.options.levels)).max(1.0) as usize;
        let relaxed = relax_around(&before.surface, &before.relaxed.domain, faces, edges, &self.options.relax.shape)?;
        let faults = faulty_faces(self.input, &relaxed.domain.mesh);
        Ok(Candidate { relaxed, faults, ..before.clone() })
    }

    /// The candidate with some edges of its base mesh bisected. `None` where the base mesh has no map, or a new vertex finds no place.
    fn bisected(&self, before: &Candidate, edges: &[[VertexId; 2]]) -> Result<Option<BisectedCandidate>, Error> {
        let Some(base) = before.base.mapped() else { return Ok(None) };
        let bisected: BaseMesh = basemesh::bisect(&before.base_surface, base.clone(), edges)?;
        let finest = &before.relaxed.domain;
        let Some(carried) = subdiv::carried_over(&before.surface, finest, base.mesh(), &bisected.domain, edges)? else {
            return Ok(None);
        };
        let BaseCounts { asked, needed, .. } = before.counts;
        let made = bisected.mesh().n_vertices();
        let why = if made > asked {
            format!("asked {asked}, took {made}: with fewer a few triangles stay folded")
        } else {
            before.counts.reason.clone()
        };
        let candidate = Candidate {
            base: Arc::new(Base::Mapped(bisected)),
            counts: BaseCounts { asked, needed, made, reason: why },
            relaxed: Relaxed { domain: carried.domain, ..before.relaxed.clone() },
            ..before.clone()
        };
        Ok(Some(BisectedCandidate { candidate, new_faces: carried.new_faces }))
    }
}

/// A candidate on a bisected base mesh, and its triangles at new vertices.
struct BisectedCandidate {
    candidate: Candidate,
    new_faces: Vec<FaceId>,
}

/// An edge of the base face under each of some triangles, ends rising, in order.
fn edges_under(now: &Candidate, faulty: &[FaceId], levels: u32, choice: EdgeChoice) -> Vec<[VertexId; 2]> {
    // The children of base face f are 4f to 4f + 3, and so on from level to level. Base vertices come first at all levels.
    let base = now.base.mesh();
    let finest = &now.relaxed.domain;
    let mut faces: BTreeMap<FaceId, Option<VertexId>> = BTreeMap::new();
    for &f in faulty {
        let tip = finest.topology.face(f).into_iter().find(|v| v.index() < base.n_vertices());
        let known = faces.entry(FaceId(f.0 >> (2 * levels))).or_insert(tip);
        *known = known.or(tip);
    }
    let chosen = |(f, tip): (FaceId, Option<VertexId>)| {
        let [a, b, c] = base.faces()[f];
        let length = |&[a, b]: &[VertexId; 2]| finest.mesh.distance(a, b);
        let is_at_tip = |edge: &[VertexId; 2]| choice != EdgeChoice::AtTip || tip.is_none_or(|tip| edge.contains(&tip));
        let edges = [[a, b], [b, c], [c, a]].into_iter().filter(is_at_tip);
        let by_length = |e: &[VertexId; 2], g: &[VertexId; 2]| length(e).total_cmp(&length(g));
        if choice == EdgeChoice::Shortest { edges.min_by(by_length) } else { edges.max_by(by_length) }
    };
    let edges: BTreeSet<_> = faces.into_iter().filter_map(chosen).map(|[a, b]| [a.min(b), a.max(b)]).collect();
    edges.into_iter().collect()
}
