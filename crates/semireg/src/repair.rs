//! The last folds: relaxed once more on their own, and on a base mesh with a few more vertices under them.

use crate::{Error, Options};
use certify::{DEGENERATE_ASPECT_RATIO, flipped};
use mesh_core::{FaceId, Id as _, Topology, TriMesh, VertexId, walk};
use region_map::{ArcSpan, Attachment, BaseMesh, RegionMap, Surface};
use relax::{Relaxed, relax_around};
use std::borrow::Cow;
use subdiv::{Bisected, Faces, SubdivDomain};

/// Rounds of bisections.
const ROUNDS: usize = 10;
/// Where a greater share of the triangles is folded the base mesh is wrong, not a few of its faces.
const MOST_FOLDED: f64 = 2e-3;
/// The base mesh grows by this share at most, and by [`LEAST_GROWTH`] vertices if that is more.
const MOST_GROWTH: f64 = 0.03;
const LEAST_GROWTH: usize = 8;

/// A relaxed domain with its base mesh.
pub(crate) struct OnBase<'a> {
    pub(crate) base: Cow<'a, BaseMesh>,
    pub(crate) topology: Topology,
    pub(crate) relaxed: Relaxed,
}

/// Mends a relaxed domain with a few triangles that face against the surface, as the certificate sees it. Vertices far from them stay
/// where they are. `None` where there are none, too many, or where some are left.
///
/// First the triangles around are relaxed by themselves: among hundreds of thousands a few have little say. Then the base faces under the
/// folds are bisected at their longest edges. No vertex of the finest level is lost by that, new ones come in the middle of edges, and so
/// the relaxed places are the start of the next round.
pub(crate) fn repaired<'a>(
    surface: &Surface,
    cleaned: &TriMesh,
    base: &'a BaseMesh,
    (topology, relaxed): (&Topology, &Relaxed),
    options: &Options,
) -> Result<Option<OnBase<'a>>, Error> {
    let Ok(input) = certify::Surface::new(cleaned) else { return Ok(None) };
    let folds = |relaxed: &Relaxed| failing(&input, &relaxed.mesh);
    let mut folded = folds(relaxed);
    let n_faces = relaxed.mesh.n_faces() as f64;
    let most_vertices = base.mesh.n_vertices() + LEAST_GROWTH.max((MOST_GROWTH * base.mesh.n_vertices() as f64) as usize);
    if folded.is_empty() || folded.len() as f64 > MOST_FOLDED * n_faces {
        return Ok(None);
    }
    let reach = 1 << options.levels;
    let again = |now: &OnBase, around: &[FaceId]| {
        relax_around(surface, &now.relaxed.mesh, &now.topology, &now.relaxed.map, (around, reach), &options.relax.shape)
    };
    let mut now = OnBase { base: Cow::Borrowed(base), topology: topology.clone(), relaxed: relaxed.clone() };
    for _ in 0..ROUNDS {
        now.relaxed = again(&now, &folded)?;
        folded = folds(&now.relaxed);
        if folded.is_empty() {
            return Ok(Some(now));
        }
        let edges = edges_under(&now, &folded, options.levels);
        if now.base.mesh.n_vertices() + edges.len() > most_vertices {
            return Ok(None);
        }
        let Some((next, new_vertices)) = bisected(surface, &now, &edges, options.levels)? else { return Ok(None) };
        now = next;
        let has_new = |f: &FaceId| now.topology.face(*f).into_iter().any(|v| new_vertices[v.index()]);
        folded = now.topology.faces().ids().filter(has_new).collect();
    }
    Ok(None)
}

/// The triangles for which the certificate would refuse a mesh: those that face against the input, and those of next to no area.
fn failing(input: &certify::Surface, mesh: &TriMesh) -> Vec<FaceId> {
    let is_degenerate = |f: &FaceId| mesh_core::aspect_ratio(mesh.triangle(*f)) < DEGENERATE_ASPECT_RATIO;
    let mut failing = certify::Surface::new(mesh).map_or_else(|_| Vec::new(), |mesh| flipped(input, &mesh));
    failing.extend(mesh.faces().ids().filter(is_degenerate));
    failing.sort_unstable();
    failing.dedup();
    failing
}

/// The domain with the base faces under some of its triangles bisected, and which of its vertices are new.
fn bisected(
    surface: &Surface,
    now: &OnBase<'_>,
    edges: &[[VertexId; 2]],
    levels: u32,
) -> Result<Option<(OnBase<'static>, Vec<bool>)>, Error> {
    let n = now.base.mesh.n_vertices();
    let base = basemesh::bisect(surface, now.base.clone().into_owned(), edges)?;
    let bisections: Vec<_> = edges.iter().enumerate().map(|(i, &[a, b])| [a, b, VertexId::new(n + i)]).collect();
    let domain = subdiv::subdivide(&base.mesh, &base.region, levels)?;
    let before = Faces { base: now.base.mesh.faces(), finest: now.relaxed.mesh.faces() };
    let after = Faces { base: base.mesh.faces(), finest: domain.mesh.faces() };
    let Some(bisected) = subdiv::bisected(before, &bisections, after, levels) else { return Ok(None) };
    let Some(map) = inherited(surface, &now.relaxed.map, &domain, &bisected) else { return Ok(None) };
    let topology = Topology::new(domain.mesh.faces(), domain.mesh.n_vertices())?;
    let n_before = now.relaxed.mesh.n_vertices() as u32;
    let new_vertices = bisected.numbers.iter().map(|&number| number >= n_before).collect();
    let relaxed = Relaxed { mesh: domain.mesh, map, ..now.relaxed.clone() };
    Ok(Some((OnBase { base: Cow::Owned(base), topology, relaxed }, new_vertices)))
}

/// The longest edges of the base faces under some triangles, ends rising, as the base vertices are now.
fn edges_under(now: &OnBase<'_>, folded: &[FaceId], levels: u32) -> Vec<[VertexId; 2]> {
    // The children of base face f are 4f to 4f + 3, and so on from level to level. Base vertices come first at all levels.
    let mut faces: Vec<FaceId> = folded.iter().map(|f| FaceId(f.0 >> (2 * levels))).collect();
    faces.dedup();
    let longest = |f: FaceId| {
        let [a, b, c] = now.base.mesh.faces()[f];
        let length = |&[a, b]: &[VertexId; 2]| now.relaxed.mesh.distance(a, b);
        [[a, b], [b, c], [c, a]].into_iter().max_by(|e, g| length(e).total_cmp(&length(g)))
    };
    let mut edges: Vec<_> = faces.into_iter().filter_map(longest).map(|[a, b]| [a.min(b), a.max(b)]).collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// The map of a bisected domain: vertices that were there before stay, new ones are put in the middle of their edges. `None` where one
/// has no neighbour to come from inside its sheet.
fn inherited(surface: &Surface, before: &RegionMap, domain: &SubdivDomain, bisected: &Bisected) -> Option<RegionMap> {
    let mut map = before.clone();
    let mut classes = vec![None; before.points.len() + bisected.middles.len()];
    for (v, &number) in bisected.numbers.enumerate() {
        *classes.get_mut(number as usize)? = Some(domain.region.attachments[v]);
    }
    for middle in &bisected.middles {
        let [a, b] = middle.ends.map(VertexId);
        let m = VertexId::new(map.points.len());
        let (attachment, point) = match classes[m.index()]? {
            Attachment::Sheet(sheet) => {
                let places = middle.ends.into_iter().chain(middle.beside.into_iter().flatten()).map(VertexId);
                let start = places.into_iter().find(|&v| map.attachments[v] == Attachment::Sheet(sheet))?;
                let position = |v: VertexId| map.points[v].position(surface.mesh);
                let way = position(a).midpoint(position(b)) - position(start);
                let may_cross = |e| !surface.network.is_barrier(e);
                let end = walk(surface.mesh, surface.topology, map.points[start], way, may_cross).end;
                (Attachment::Sheet(sheet), end)
            }
            _ => {
                let span = map.span(a, b)?;
                let (arc, t) = (&surface.network.arcs[span.arc], 0.5 * (span.from + span.to));
                map.insert_span(a, m, ArcSpan { to: t, ..span });
                map.insert_span(m, b, ArcSpan { from: t, ..span });
                let t = arc.normalise(t);
                (Attachment::Arc { arc: span.arc, t }, arc.point(surface.topology, t))
            }
        };
        map.attachments.push(attachment);
        map.points.push(point);
    }
    let number = |v: VertexId| VertexId(bisected.numbers[v]);
    let vertices = || domain.mesh.positions().ids();
    let mut inherited = RegionMap {
        attachments: vertices().map(|v| map.attachments[number(v)]).collect(),
        points: vertices().map(|v| map.points[number(v)]).collect(),
        sheet_of_face: domain.region.sheet_of_face.clone(),
        spans: Default::default(),
    };
    for &[a, b] in domain.region.spans.keys() {
        inherited.insert_span(a, b, map.span(number(a), number(b))?);
    }
    Some(inherited)
}
