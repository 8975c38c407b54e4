//! The last folds: relaxed once more on their own, and on a base mesh with a few more vertices under them.

use crate::failing::Failing;
use crate::{Error, Options};
use mesh_core::{FaceId, Id as _, Topology, VertexId, walk};
use region_map::{ArcSpan, Attachment, BaseCounts, BaseMesh, RegionMap, Surface};
use relax::{Relaxed, relax_around};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use subdiv::{Bisected, Faces, SubdivDomain};

/// What is tried at most. Most places come free at the first or second try, without a new vertex.
const MOST_TRIES: usize = 30;
/// What is tried in turn, each time from the best there was, until fewer triangles fail. Reaches are in edges of the base mesh: another one
/// often frees what the first did not, at no cost in base vertices. At a tip another edge leaves more triangles in the same angle.
const TRIES: [Try; 6] = [
    Try::Relax(1.0),
    Try::Relax(0.5),
    Try::Relax(2.0),
    Try::Bisect(Choice::Longest),
    Try::Bisect(Choice::AtTip),
    Try::Bisect(Choice::Shortest),
];
/// Where a greater share of the triangles fails the base mesh is wrong, not a few of its faces.
const MOST_FAILING: f64 = 2e-3;
/// The base mesh grows by this share at most, and by [`LEAST_GROWTH`] vertices if that is more.
const MOST_GROWTH: f64 = 0.03;
const LEAST_GROWTH: usize = 8;

/// What may free failing triangles.
#[derive(Clone, Copy)]
enum Try {
    /// Relaxing all that is so far around.
    Relax(f64),
    /// Bisecting edges of the base faces under them, and relaxing what is one edge around.
    Bisect(Choice),
}

/// Which edge of the base face under a failing triangle is bisected.
#[derive(Clone, Copy, PartialEq)]
enum Choice {
    Longest,
    /// The longest of those that end at the base vertex of the triangle, if it has one.
    AtTip,
    Shortest,
}

/// A relaxed domain with its base mesh.
#[derive(Clone)]
pub(crate) struct OnBase<'a> {
    pub(crate) base: Cow<'a, BaseMesh>,
    pub(crate) topology: Topology,
    pub(crate) relaxed: Relaxed,
}

/// Mends a relaxed domain with a few triangles that the certificate would refuse, and tells which are left. Vertices far from them stay where
/// they are. The domain as it was where there are none, or so many that the base mesh is wrong. Fails where some are left that face against
/// the input.
///
/// First the triangles around are relaxed by themselves: among hundreds of thousands a few have little say. Then the base faces under the
/// folds are bisected. No vertex of the finest level is lost by that, new ones come in the middle of edges, and so the relaxed places are
/// the start of the next try.
pub(crate) fn repaired<'a>(
    surface: &Surface,
    input: &certify::Surface,
    start: OnBase<'a>,
    options: &Options,
) -> Result<(OnBase<'a>, Failing), Error> {
    let mut failing = Failing::of(&start.relaxed.mesh, input);
    if failing.faces.len() as f64 > MOST_FAILING * start.relaxed.mesh.n_faces() as f64 {
        return Ok((start, failing));
    }
    let n = start.base.mesh.n_vertices();
    let most_vertices = n + LEAST_GROWTH.max((MOST_GROWTH * n as f64) as usize);
    let (mut best, mut hopeless, mut tried) = (start, 0, 0);
    for _ in 0..MOST_TRIES {
        // Groups that all tries have failed on come first.
        let groups = groups(&failing, &best.topology);
        let Some(faces) = groups.get(hopeless) else { break };
        let Some(&attempt) = TRIES.get(tried) else {
            (hopeless, tried) = (hopeless + 1, 0);
            continue;
        };
        tried += 1;
        let Some(now) = attempt.on(surface, &best, faces, most_vertices, options)? else { continue };
        let found = Failing::of(&now.relaxed.mesh, input);
        if found.faces.len() < failing.faces.len() {
            tried = 0;
        }
        if found.faces.len() <= failing.faces.len() {
            (best, failing) = (now, found);
        }
    }
    // What has no area may still come free when it is snapped.
    match failing.flipped {
        0 => Ok((best, failing)),
        flipped => Err(Error::Folded { inverted: flipped, faces: best.relaxed.mesh.n_faces() }),
    }
}

impl Try {
    /// The domain after a try to free some of its triangles; `None` where there is nothing to bisect, or too much.
    fn on<'a>(
        self,
        surface: &Surface,
        before: &OnBase<'a>,
        faces: &[FaceId],
        most_vertices: usize,
        options: &Options,
    ) -> Result<Option<OnBase<'a>>, Error> {
        let edges = |reach: f64| (reach * f64::from(1 << options.levels)).max(1.0) as usize;
        let (mut now, around, edges) = match self {
            Self::Relax(reach) => (before.clone(), faces.to_vec(), edges(reach)),
            Self::Bisect(choice) => {
                let under = edges_under(before, faces, options.levels, choice);
                if before.base.mesh.n_vertices() + under.len() > most_vertices {
                    return Ok(None);
                }
                let Some((next, new)) = bisected(surface, before, &under, options.levels)? else { return Ok(None) };
                (next, new, edges(1.0))
            }
        };
        let OnBase { topology, relaxed, .. } = &now;
        now.relaxed = relax_around(surface, &relaxed.mesh, topology, &relaxed.map, (&around, edges), &options.relax.shape)?;
        Ok(Some(now))
    }
}

/// What is mended at once: first all, then every cluster by itself, as what frees one may spoil another.
fn groups(failing: &Failing, topology: &Topology) -> Vec<Vec<FaceId>> {
    let clusters = topology.clusters(&failing.faces);
    if clusters.len() < 2 { clusters } else { [vec![failing.faces.clone()], clusters].concat() }
}

/// The domain with some edges of its base mesh bisected, and its faces at new vertices. `None` where one of these finds no place.
fn bisected(
    surface: &Surface,
    now: &OnBase<'_>,
    edges: &[[VertexId; 2]],
    levels: u32,
) -> Result<Option<(OnBase<'static>, Vec<FaceId>)>, Error> {
    let n = now.base.mesh.n_vertices();
    let mut base = basemesh::bisect(surface, now.base.clone().into_owned(), edges)?;
    let BaseCounts { asked, made, .. } = base.counts;
    if made > asked {
        base.counts.reason = format!("asked {asked}, took {made}: with fewer a few triangles stay folded");
    }
    let bisections: Vec<_> = edges.iter().enumerate().map(|(i, &[a, b])| [a, b, VertexId::new(n + i)]).collect();
    let domain = subdiv::subdivide(&base.mesh, &base.region, levels)?;
    let before = Faces { base: now.base.mesh.faces(), finest: now.relaxed.mesh.faces() };
    let after = Faces { base: base.mesh.faces(), finest: domain.mesh.faces() };
    let Some(bisected) = subdiv::bisected(before, &bisections, after, levels) else { return Ok(None) };
    let Some(map) = inherited(surface, &now.relaxed.map, &domain, &bisected) else { return Ok(None) };
    let topology = Topology::new(domain.mesh.faces(), domain.mesh.n_vertices())?;
    let n_before = now.relaxed.mesh.n_vertices() as u32;
    let is_new = |v: VertexId| bisected.numbers[v] >= n_before;
    let new = topology.faces().ids().filter(|&f| topology.face(f).into_iter().any(is_new)).collect();
    let relaxed = Relaxed { mesh: domain.mesh, map, ..now.relaxed.clone() };
    Ok(Some((OnBase { base: Cow::Owned(base), topology, relaxed }, new)))
}

/// An edge of the base face under each of some triangles, ends rising, in order.
fn edges_under(now: &OnBase<'_>, folded: &[FaceId], levels: u32, choice: Choice) -> Vec<[VertexId; 2]> {
    // The children of base face f are 4f to 4f + 3, and so on from level to level. Base vertices come first at all levels.
    let mut faces: BTreeMap<FaceId, Option<VertexId>> = BTreeMap::new();
    for &f in folded {
        let tip = now.topology.face(f).into_iter().find(|v| v.index() < now.base.mesh.n_vertices());
        let known = faces.entry(FaceId(f.0 >> (2 * levels))).or_insert(tip);
        *known = known.or(tip);
    }
    let chosen = |(f, tip): (FaceId, Option<VertexId>)| {
        let [a, b, c] = now.base.mesh.faces()[f];
        let length = |&[a, b]: &[VertexId; 2]| now.relaxed.mesh.distance(a, b);
        let is_at_tip = |edge: &[VertexId; 2]| choice != Choice::AtTip || tip.is_none_or(|tip| edge.contains(&tip));
        let edges = [[a, b], [b, c], [c, a]].into_iter().filter(is_at_tip);
        let by_length = |e: &[VertexId; 2], g: &[VertexId; 2]| length(e).total_cmp(&length(g));
        if choice == Choice::Shortest { edges.min_by(by_length) } else { edges.max_by(by_length) }
    };
    let edges: BTreeSet<_> = faces.into_iter().filter_map(chosen).map(|[a, b]| [a.min(b), a.max(b)]).collect();
    edges.into_iter().collect()
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
