//! What touches along a line keeps together: the arcs in one place get the same vertices.

use super::mender::Mender;
use crate::candidate::Candidate;
use crate::{Error, Options};
use certify::Reference;
use glam::DVec3;
use mesh_core::{FaceId, IdVec, Place, VertexId, place};
use region_map::{ArcId, ArcSpan, Attachment, CornerId, Domain, RegionMap, Surface};
use relax::{RelaxError, Relaxed, ShapeOptions, relax_around};
use std::collections::{BTreeMap, BTreeSet};

/// Rounds of bisection. Each may double the vertices of an arc, and arcs in one place seldom differ by half.
const ROUNDS: usize = 4;
/// The base mesh grows by this share at most.
const MOST_GROWTH: f64 = 0.5;
/// Vertices up to so many edges away from those that move on their arcs make way. More gives better triangles there, and takes longer.
const REACH: usize = 6;

/// An arc in the place of others.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Side {
    arc: ArcId,
    /// Whether it runs the other way than the first one of its group.
    runs_back: bool,
}

/// The arcs of a surface that lie in one place, group by group.
fn groups(surface: &Surface) -> Vec<Vec<Side>> {
    let mut by_place: BTreeMap<Vec<Place>, Vec<Side>> = BTreeMap::new();
    for (arc, a) in surface.network().arcs.enumerate().filter(|(_, a)| !a.is_loop()) {
        let forth: Vec<Place> = a.vertices.iter().map(|&v| place(surface.mesh().position(v))).collect();
        let back: Vec<_> = forth.iter().rev().copied().collect();
        let runs_back = back < forth;
        by_place.entry(if runs_back { back } else { forth }).or_default().push(Side { arc, runs_back });
    }
    let mut groups: Vec<_> = by_place.into_values().filter(|sides| sides.len() > 1).collect();
    for sides in &mut groups {
        let first = sides[0].runs_back;
        sides.iter_mut().for_each(|side| side.runs_back ^= first);
    }
    groups
}

/// The vertices of a surface on arcs that lie in one place. An arc that follows a bend there would be in two, and those beside it might not.
pub(crate) fn on_touching_arcs(surface: &Surface) -> BTreeSet<VertexId> {
    let arcs = &surface.network().arcs;
    groups(surface).into_iter().flatten().flat_map(|side| arcs[side.arc].vertices.iter().copied()).collect()
}

/// Bisects base edges on arcs that have fewer than the others in their place. Where the base mesh has no map, or would grow too much, it stays
/// as it is.
pub(crate) fn matched(input: &Reference, start: Candidate, options: &Options) -> Result<Candidate, Error> {
    let groups = groups(&start.surface);
    let mender = Mender::new(input, options, &start, MOST_GROWTH, "what touches would come apart");
    let mut now = start;
    for _ in 0..ROUNDS {
        let edges = lacking(&groups, &now.base.domain().region);
        if edges.is_empty() {
            break;
        }
        let Some(bisected) = mender.bisected_at(&now, &edges)? else { break };
        now = bisected;
    }
    Ok(now)
}

/// Base edges to bisect: the longest on each arc that has fewer than another one in its place, as many as it lacks.
fn lacking(groups: &[Vec<Side>], region: &RegionMap) -> Vec<[VertexId; 2]> {
    let mut on_arc: BTreeMap<ArcId, Vec<(f64, [VertexId; 2])>> = BTreeMap::new();
    for (&edge, span) in &region.spans {
        on_arc.entry(span.arc).or_default().push(((span.to - span.from).abs(), edge));
    }
    on_arc.values_mut().for_each(|edges| edges.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1))));
    let edges_of = |side: &Side| on_arc.get(&side.arc).map_or(&[][..], Vec::as_slice);
    let mut lacking = Vec::new();
    for sides in groups {
        let most = sides.iter().map(|side| edges_of(side).len()).max().unwrap_or(0);
        for edges in sides.iter().map(edges_of) {
            lacking.extend(edges.iter().take(most - edges.len()).map(|(_, edge)| *edge));
        }
    }
    lacking.sort_unstable();
    lacking
}

/// Moves the vertices on arcs to where the first arc in their place has its own, if there are as many, and relaxes what is around. The candidate comes
/// back as it was where the certificate would refuse more triangles then.
pub(crate) fn joined(input: &Reference, before: Candidate, options: &ShapeOptions) -> Result<Candidate, Error> {
    let groups = groups(&before.surface);
    if groups.is_empty() {
        return Ok(before);
    }
    let Domain { mesh, topology, region } = &before.relaxed.domain;
    let (mut region, mut positions, mut held) = (region.clone(), mesh.positions().clone(), Vec::new());
    let attached = Attached::new(&region);
    for sides in &groups {
        let chains: Vec<_> = sides.iter().map(|side| attached.chain(&before.surface, side)).collect();
        for (side, chain) in sides.iter().zip(&chains).filter(|(_, chain)| chain.len() == chains[0].len()) {
            follow(&before.surface, side, chain, &chains[0], &mut region, &mut positions);
            held.extend(chain.iter().map(|(_, v)| *v));
        }
    }
    let places = positions.clone();
    let has_moved = |v: &VertexId| places[*v] != mesh.position(*v);
    let at_moved: Vec<FaceId> = held.iter().filter(|v| has_moved(v)).flat_map(|&v| topology.faces_at(v)).collect();
    let moved =
        Domain { mesh: mesh.with_positions(positions.into_vec()).map_err(RelaxError::from)?, topology: topology.clone(), region };
    let relaxed = relax_around(&before.surface, &moved, &at_moved, REACH, &held, options)?;
    // To the last bit in the same place: rounding along another arc would part them.
    let mut positions = relaxed.domain.mesh.positions().clone();
    held.iter().for_each(|&v| positions[v] = places[v]);
    let mesh = relaxed.domain.mesh.with_positions(positions.into_vec()).map_err(RelaxError::from)?;
    let domain = Domain { mesh, ..relaxed.domain };
    let relaxed = Relaxed { domain, ..relaxed }.after(before.relaxed.report);
    let joined = before.clone().with(input, before.surface.clone(), relaxed);
    Ok(if joined.n_faults() > before.n_faults() { before } else { joined })
}

/// The domain vertices at corners and on arcs.
struct Attached {
    at_corner: BTreeMap<CornerId, VertexId>,
    /// With their arc lengths, in the order of the vertices.
    on_arc: BTreeMap<ArcId, Vec<(f64, VertexId)>>,
}

impl Attached {
    fn new(region: &RegionMap) -> Self {
        let mut attached = Self { at_corner: BTreeMap::new(), on_arc: BTreeMap::new() };
        for (v, attachment) in region.attachments.enumerate() {
            match *attachment {
                Attachment::Corner(c) => drop(attached.at_corner.insert(c, v)),
                Attachment::Arc { arc, t } => attached.on_arc.entry(arc).or_default().push((t, v)),
                Attachment::Sheet(_) => {}
            }
        }
        attached
    }

    /// The vertices along an arc with their arc lengths from where the first one of its group begins, both ends with them.
    fn chain(&self, surface: &Surface, side: &Side) -> Vec<(f64, VertexId)> {
        let arc = &surface.network().arcs[side.arc];
        let ends = arc.corners.into_iter().flatten().zip([0.0, arc.length()]);
        let mut chain: Vec<_> = ends.filter_map(|(c, t)| Some((t, *self.at_corner.get(&c)?))).collect();
        chain.extend(self.on_arc.get(&side.arc).into_iter().flatten());
        if side.runs_back {
            chain.iter_mut().for_each(|(t, _)| *t = arc.length() - *t);
        }
        chain.sort_by(|a, b| a.0.total_cmp(&b.0));
        chain
    }
}

/// Puts the inner vertices of a chain where the first one of its group has its own.
fn follow(
    surface: &Surface,
    side: &Side,
    chain: &[(f64, VertexId)],
    first: &[(f64, VertexId)],
    region: &mut RegionMap,
    positions: &mut IdVec<VertexId, DVec3>,
) {
    let arc = &surface.network().arcs[side.arc];
    let along = |t: f64| arc.normalise(if side.runs_back { arc.length() - t } else { t });
    for (&(_, v), &(t, w)) in chain.iter().zip(first) {
        positions[v] = positions[w];
        if let Attachment::Arc { .. } = region.attachments[v] {
            region.attachments[v] = Attachment::Arc { arc: side.arc, t: along(t) };
            region.points[v] = arc.point(surface.topology(), along(t));
        }
    }
    for (pair, ts) in chain.windows(2).zip(first.windows(2)) {
        let span = ArcSpan { arc: side.arc, from: along(ts[0].0), to: along(ts[1].0) };
        region.insert_span(pair[0].1, pair[1].1, span);
    }
}

#[cfg(test)]
mod tests {
    use crate::{Options, remesh};
    use mesh_core::Soup;
    use std::f64::consts::TAU;

    /// A wall on a floor of `n` by `n` squares, in a wave across its middle: three sheets meet in a line.
    fn wall_on_floor(n: u32) -> Soup {
        let step = 1.0 / f64::from(n);
        let bend = |x: f64| 0.1 * (TAU * x).sin();
        let at = |i: u32, j: u32| {
            let [x, y] = [i, j].map(|k| f64::from(k) * step);
            // Rows of the floor follow the wall in the middle.
            [x, y + bend(x) * (1.0 - (2.0 * y - 1.0).abs()), 0.0]
        };
        let mut positions: Vec<[f64; 3]> = (0..=n).flat_map(|j| (0..=n).map(move |i| at(i, j))).collect();
        let rise = |k: u32, i: u32| [at(i, n / 2)[0], at(i, n / 2)[1], f64::from(k) * step];
        positions.extend((1..=n / 2).flat_map(|k| (0..=n).map(move |i| rise(k, i))));
        let floor = |i: u32, j: u32| j * (n + 1) + i;
        let wall = |i: u32, k: u32| if k == 0 { floor(i, n / 2) } else { (n + k) * (n + 1) + i };
        let quads =
            (0..n).flat_map(|j| (0..n).map(move |i| [floor(i, j), floor(i + 1, j), floor(i + 1, j + 1), floor(i, j + 1)]));
        let walls =
            (0..n / 2).flat_map(|k| (0..n).map(move |i| [wall(i, k), wall(i + 1, k), wall(i + 1, k + 1), wall(i, k + 1)]));
        let triangles = quads.chain(walls).flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        Soup { positions: positions.into_iter().map(Into::into).collect(), triangles }
    }

    /// The wall stands on the floor in the result, too: welded, it has the topology of the input, and nothing cuts anything.
    #[test]
    fn three_sheets_meet_in_one_line() {
        let options = Options { base_vertices: Some(80), levels: Some(2), ..Options::default() };
        let measures = remesh(&wall_on_floor(12), &options).unwrap().report.certificate.measures;
        assert_eq!(measures.remeshed_self_intersecting, 0);
        let [result, input] = [measures.remeshed_topology.welded, measures.original_topology.welded];
        assert_eq!((result.components, result.euler), (input.components, input.euler));
        assert!(result.nonmanifold_edges > 0, "{result:?}");
    }
}
