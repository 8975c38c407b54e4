//! [`Mender`]: places of a candidate relaxed by themselves, and its base mesh refined under them.

use crate::attempt::EdgeChoice;
use crate::base::{Base, BaseCounts};
use crate::candidate::Candidate;
use crate::{Error, Options};
use certify::Reference;
use mesh_core::{FaceId, Id as _, VertexId};
use region_map::BaseMesh;
use relax::{Relaxed, relax_around};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// How far around a new base vertex is relaxed, in base edges.
const REACH_OF_BISECTION: f64 = 1.0;
/// A base mesh may grow by so many vertices, whatever share of it that is.
const LEAST_GROWTH: usize = 8;

/// Mends places of a candidate, each with all that is far from it held.
pub(super) struct Mender<'a> {
    input: &'a Reference,
    options: &'a Options,
    /// The base mesh must not grow beyond this.
    most_vertices: usize,
    /// What is wrong with fewer base vertices.
    with_fewer: &'a str,
}

impl<'a> Mender<'a> {
    /// A mender of a candidate whose base mesh grows by a share `most_growth` at most, as with fewer vertices something is wrong.
    pub(super) fn new(
        input: &'a Reference,
        options: &'a Options,
        start: &Candidate,
        most_growth: f64,
        with_fewer: &'a str,
    ) -> Self {
        let n = start.base.mesh().n_vertices();
        Self { input, options, most_vertices: n + LEAST_GROWTH.max((most_growth * n as f64) as usize), with_fewer }
    }

    /// The surroundings of some triangles relaxed, as far as so many base edges.
    pub(super) fn relaxed(&self, before: &Candidate, faces: &[FaceId], reach: f64) -> Result<Candidate, Error> {
        let edges = (reach * f64::from(1 << self.options.levels())).max(1.0) as usize;
        let relaxed = relax_around(&before.surface, &before.relaxed.domain, faces, edges, &[], &self.options.relax.shape)?;
        Ok(before.clone().with(self.input, before.surface.clone(), relaxed.after(before.relaxed.report)))
    }

    /// The base mesh bisected under some triangles, and what is around the new vertices relaxed. `None` where it would grow too much, it has
    /// no map, or a new vertex finds no place.
    pub(super) fn refined(&self, before: &Candidate, faces: &[FaceId], choice: EdgeChoice) -> Result<Option<Candidate>, Error> {
        self.bisected_at(before, &edges_under(before, faces, self.options.levels(), choice))
    }

    /// Some edges of the base mesh bisected, and what is around the new vertices relaxed. `None` as above.
    pub(super) fn bisected_at(&self, before: &Candidate, edges: &[[VertexId; 2]]) -> Result<Option<Candidate>, Error> {
        if before.base.mesh().n_vertices() + edges.len() > self.most_vertices {
            return Ok(None);
        }
        let Some(bisected) = self.bisected(before, edges)? else { return Ok(None) };
        self.relaxed(&bisected.candidate, &bisected.new_faces, REACH_OF_BISECTION).map(Some)
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
        let why = if made > asked { format!("with fewer {}", self.with_fewer) } else { before.counts.reason.clone() };
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
fn edges_under(now: &Candidate, triangles: &[FaceId], levels: u32, choice: EdgeChoice) -> Vec<[VertexId; 2]> {
    // The children of base face f are 4f to 4f + 3, and so on from level to level. Base vertices come first at all levels.
    let base = now.base.mesh();
    let finest = &now.relaxed.domain;
    let mut faces: BTreeMap<FaceId, Option<VertexId>> = BTreeMap::new();
    for &f in triangles {
        let tip = finest.topology.face(f).into_iter().find(|v| v.index() < base.n_vertices());
        let known = faces.entry(FaceId(f.0 >> (2 * levels))).or_insert(tip);
        *known = known.or(tip);
    }
    let chosen = |(f, tip): (FaceId, Option<VertexId>)| {
        let [a, b, c] = base.faces()[f];
        let length = |&[a, b]: &[VertexId; 2]| finest.mesh.distance(a, b);
        let sides = [[a, b], [b, c], [c, a]];
        let is_on_arc = |&[a, b]: &[VertexId; 2]| now.base.domain().region.span(a, b).is_some();
        let may_be = |edge: &[VertexId; 2]| match choice {
            EdgeChoice::AtTip => tip.is_none_or(|tip| edge.contains(&tip)),
            EdgeChoice::OnArc => is_on_arc(edge) || !sides.iter().any(is_on_arc),
            EdgeChoice::Longest | EdgeChoice::Shortest => true,
        };
        let edges = sides.into_iter().filter(may_be);
        let by_length = |e: &[VertexId; 2], g: &[VertexId; 2]| length(e).total_cmp(&length(g));
        if choice == EdgeChoice::Shortest { edges.min_by(by_length) } else { edges.max_by(by_length) }
    };
    let edges: BTreeSet<_> = faces.into_iter().filter_map(chosen).map(|[a, b]| [a.min(b), a.max(b)]).collect();
    edges.into_iter().collect()
}
