//! [`Mender`]: places of a candidate relaxed by themselves, and its base mesh refined under them.

use crate::attempt::EdgeChoice;
use crate::base::{Base, BaseCounts};
use crate::candidate::Candidate;
use crate::{Error, Options};
use certify::Reference;
use mesh_core::{FaceId, Id as _, VertexId};
use region_map::{ArcId, ArcKind, Attachment, BaseMesh, Domain, Surface};
use relax::{Relaxed, relax_around};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// How far around a new base vertex is relaxed, in base edges.
const REACH_OF_BISECTION: f64 = 1.0;
/// How far around triangles whose creases were let go of is relaxed, in base edges.
const REACH_OF_RELEASE: f64 = 1.0;
/// Creases up to so many rings of triangles away from a faulty one may be what folds it.
const RINGS_TO_CREASES: usize = 1;
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
        self.relaxed_on(before, &before.surface, &before.relaxed.domain, faces, reach)
    }

    /// The creases beside some triangles let go of, and their surroundings relaxed without. `None` where there is no crease.
    pub(super) fn released(&self, before: &Candidate, faces: &[FaceId]) -> Result<Option<Candidate>, Error> {
        let (network, domain) = (before.surface.network(), &before.relaxed.domain);
        let beside = domain.topology.widened(faces, RINGS_TO_CREASES);
        let at_vertex = |v: VertexId| match domain.region.attachments[v] {
            Attachment::Arc { arc, .. } => Some(arc),
            _ => None,
        };
        let arcs = beside.into_iter().flat_map(|f| domain.topology.face(f)).filter_map(at_vertex);
        let creases: BTreeSet<ArcId> = arcs.filter(|&a| network.arcs[a].kind == ArcKind::Sharp).collect();
        if creases.is_empty() {
            return Ok(None);
        }
        let (surface, domain) = snap::release(&before.surface, domain, &creases)?;
        let relaxed = self.relaxed_on(before, &surface, &domain, faces, REACH_OF_RELEASE)?;
        Ok(Some(Candidate { is_released: true, ..relaxed }))
    }

    /// A domain in the place of a candidate's, relaxed around some triangles as far as so many base edges.
    fn relaxed_on(
        &self,
        before: &Candidate,
        surface: &Surface,
        domain: &Domain,
        faces: &[FaceId],
        reach: f64,
    ) -> Result<Candidate, Error> {
        let edges = (reach * f64::from(1 << self.options.levels())).max(1.0) as usize;
        let relaxed = relax_around(surface, domain, faces, edges, &[], &self.options.relax.shape)?;
        Ok(before.clone().with(self.input, surface.clone(), relaxed.after(before.relaxed.report)))
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

    /// The candidate with some edges of its base mesh bisected. `None` where that has no map or creases that were let go of, or a new
    /// vertex finds no place.
    fn bisected(&self, before: &Candidate, edges: &[[VertexId; 2]]) -> Result<Option<BisectedCandidate>, Error> {
        let Some(base) = before.base.mapped().filter(|_| !before.is_released) else { return Ok(None) };
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::finish::first_candidate;
    use crate::progress::Watch;
    use crate::run::Run;

    /// The rims of a cylinder are creases. Without the one beside a triangle its side and its end are one sheet, and the base mesh stays as it is.
    #[test]
    fn a_crease_beside_a_triangle_is_let_go_of() {
        let options = Options { base_vertices: Some(60), levels: Some(2), ..Options::default() };
        let (input, start) = first_candidate(&fixtures::cylinder(0.5, 1.5, 48), &options, &mut Run::new(Watch::default()));
        let mender = Mender::new(&input.reference, &options, &start, 0.5, "");
        let touches_arc = |f: &FaceId| {
            let corners = start.relaxed.domain.topology.face(*f);
            corners.iter().any(|&v| matches!(start.relaxed.domain.region.attachments[v], Attachment::Arc { .. }))
        };
        let faces = || start.relaxed.domain.mesh.faces().ids();
        let [beside, far] = [true, false].map(|is_beside| {
            let ring = |f: &FaceId| start.relaxed.domain.topology.widened(&[*f], RINGS_TO_CREASES);
            faces().find(|f| ring(f).iter().any(touches_arc) == is_beside).unwrap()
        });
        assert!(mender.released(&start, &[far]).unwrap().is_none());
        let released = mender.released(&start, &[beside]).unwrap().unwrap();
        let counts = |candidate: &Candidate| (candidate.surface.network().arcs.len(), candidate.surface.network().n_sheets);
        assert_eq!([counts(&start), counts(&released)], [(2, 3), (1, 2)]);
        assert_eq!((released.n_faults(), released.surface.network().minor.len()), (0, 1));
        let refined = |candidate: &Candidate| mender.refined(candidate, &[beside], EdgeChoice::Longest).unwrap();
        assert!(refined(&start).is_some() && refined(&released).is_none());
    }
}
