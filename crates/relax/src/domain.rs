//! The domain as the relaxation sees it: what each vertex is free to do, and which side of its arc each face lies on.

use crate::RelaxError;
use glam::DVec3;
use mesh_core::{FaceId, HalfedgeId, IdVec, Topology, VertexId};
use rayon::prelude::*;
use region_map::{Arc, ArcId, ArcSpan, Attachment, CornerId, RegionMap, Surface};

/// What never changes while the vertices move.
pub(crate) struct Domain<'a> {
    pub(crate) surface: &'a Surface<'a>,
    pub(crate) topology: &'a Topology,
    /// What every vertex is free to do.
    pub(crate) freedoms: IdVec<VertexId, Freedom>,
    /// Which normal each face takes at each of its corners.
    pub(crate) normals: IdVec<HalfedgeId, CornerNormal>,
    /// No vertex inside a sheet moves farther in a step.
    pub(crate) longest_move: f64,
}

/// What a vertex is free to do.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Freedom {
    /// Nothing: it is at a corner.
    Fixed,
    /// Slide along its arc between two neighbours.
    Rail(Rail),
    /// Move over its sheet.
    Sheet,
}

/// The place of a vertex on its arc.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rail {
    pub(crate) arc: ArcId,
    pub(crate) behind: RailEnd,
    pub(crate) ahead: RailEnd,
    /// The gap to a neighbour does not get longer than this: a chord across a hole would be cheap for its triangles, and far from
    /// the arc.
    pub(crate) longest_gap: f64,
    /// Nor shorter than this: vertices that fall into one never come apart again.
    pub(crate) shortest_gap: f64,
}

/// A neighbour on an arc: in the arc lengths of the vertex between, it is at its own arc length plus `shift`.
///
/// The shift is a multiple of the length on a loop, and else 0. A corner has the arc length 0 and its place as shift.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RailEnd {
    pub(crate) vertex: VertexId,
    pub(crate) shift: f64,
}

/// Which normal a face takes at a corner.
#[derive(Clone, Copy, Debug)]
pub(crate) enum CornerNormal {
    /// The vertex' own (inside a sheet), or the one on the left side of its arc.
    Left,
    /// The one on the right side of its arc.
    Right,
    /// That of a sector at a corner of the network, which counts only where the face has no other.
    Sector(DVec3),
}

impl<'a> Domain<'a> {
    /// Checks the map and works out what the vertices may do.
    pub(crate) fn new(surface: &'a Surface<'a>, topology: &'a Topology, map: &RegionMap) -> Result<Self, RelaxError> {
        map.check(topology, surface.network)?;
        let mut freedoms = IdVec::filled(Freedom::Fixed, topology.n_vertices());
        for (v, attachment) in map.attachments.enumerate() {
            freedoms[v] = match *attachment {
                Attachment::Corner(_) => Freedom::Fixed,
                Attachment::Arc { arc, t } => Freedom::Rail(rail(surface, topology, map, v, arc, t)?),
                Attachment::Sheet(sheet) if surface.network.sheet_of_face.get(map.points[v].face) == Some(&sheet) => {
                    Freedom::Sheet
                }
                Attachment::Sheet(_) => return Err(RelaxError::OtherSheet(v)),
            };
        }
        let mut normals = IdVec::filled(CornerNormal::Left, 3 * topology.n_faces());
        for (v, freedom) in freedoms.enumerate() {
            match (freedom, map.attachments[v]) {
                (Freedom::Rail(rail), _) => mark_right_side(topology, v, rail, &mut normals),
                (_, Attachment::Corner(c)) => mark_sectors(surface, topology, map, v, c, &mut normals),
                _ => {}
            }
        }
        let mean_edge = (surface.mesh.total_area() / topology.n_faces().max(1) as f64 * 4.0 / 3f64.sqrt()).sqrt();
        Ok(Self { surface, topology, freedoms, normals, longest_move: LONGEST_MOVE * mean_edge })
    }

    /// Something of every face, in order.
    pub(crate) fn of_faces<T: Send>(&self, value: impl Fn(FaceId) -> T + Sync + Send) -> Vec<T> {
        let faces: Vec<FaceId> = self.topology.faces().ids().collect();
        faces.into_par_iter().map(value).collect()
    }

    /// Holds some vertices inside sheets where they are.
    pub(crate) fn hold(&mut self, held: &[VertexId]) {
        for &v in held {
            if matches!(self.freedoms[v], Freedom::Sheet) {
                self.freedoms[v] = Freedom::Fixed;
            }
        }
    }

    /// The unit reference normal of a face: the mean of the surface's normals at its corners, each seen from the face's side of
    /// the arcs. `normals` gives both sides at a vertex.
    pub(crate) fn reference_normal(&self, f: FaceId, normals: impl Fn(VertexId) -> [DVec3; 2]) -> DVec3 {
        let (mut free, mut sectors) = (DVec3::ZERO, DVec3::ZERO);
        for (c, v) in self.topology.face(f).into_iter().enumerate() {
            match self.normals[HalfedgeId::of(f, c)] {
                CornerNormal::Left => free += normals(v)[0],
                CornerNormal::Right => free += normals(v)[1],
                CornerNormal::Sector(n) => sectors += n,
            }
        }
        free.try_normalize().unwrap_or_else(|| sectors.normalize_or_zero())
    }
}

/// A vertex inside a sheet moves this many mean edges in a step at most. While triangles are inverted, steps of thousands of diagonals
/// come up, and a walk that long goes round and round (crank_cse: minutes).
const LONGEST_MOVE: f64 = 4.0;
/// Gaps between neighbours on an arc get longer than at the start by at most this factor.
const STRETCH: f64 = 3.0;
/// But by no more than what lets the arc turn by so much (degrees) within a gap, or by [`LEAST_STRETCH`]. Measured: without this rule, rims of
/// holes lost up to a third of their circle to one edge (Brun_joint missed the input by 27e-3 of the diagonal at a mean AR of .889, with it by
/// 3.4e-3 at .887). With 30 degrees camelhead has .004 more of mean AR, casting .973 to .975 of its creases instead of .980.
const MOST_TURN: f64 = 45.0;
const LEAST_STRETCH: f64 = 1.5;
/// The turn is that of so many gaps on both sides.
const WINDOW: f64 = 2.0;
/// Gaps get no shorter than this share of the longer one at the start, so that they don't shrink again with each relaxation. Measured: on
/// pyvi_footbones some went down to 1e-13 of the diagonal; with .01 casting loses .002 of its creases.
const SHRINK: f64 = 0.001;

/// The neighbours of `v`, at arc length `t`, on its arc.
fn rail(surface: &Surface, topology: &Topology, map: &RegionMap, v: VertexId, arc: ArcId, t: f64) -> Result<Rail, RelaxError> {
    let mut ends: Vec<(f64, RailEnd)> = Vec::new();
    for vertex in topology.one_ring(v) {
        if let Some(span) = map.span(v, vertex).filter(|span| span.arc == arc) {
            let own = match map.attachments[vertex] {
                Attachment::Arc { t, .. } => t,
                _ => 0.0,
            };
            let gap = span.to - span.from;
            ends.push((gap, RailEnd { vertex, shift: t + gap - own }));
        }
    }
    let longest = ends.iter().map(|end| end.0.abs()).fold(0.0, f64::max);
    let longest_gap = longest * stretch(surface, &surface.network.arcs[arc], t, longest);
    let shortest_gap = SHRINK * longest;
    match ends[..] {
        [(a, behind), (b, ahead)] | [(b, ahead), (a, behind)] if a <= 0.0 && b >= 0.0 && a < b => {
            Ok(Rail { arc, behind, ahead, longest_gap, shortest_gap })
        }
        _ => Err(RelaxError::ArcOrder(v)),
    }
}

/// The factor by which a gap on an arc may grow about arc length `t`: the more the arc turns there, the less.
fn stretch(surface: &Surface, arc: &Arc, t: f64, gap: f64) -> f64 {
    let window = if arc.is_loop() { (WINDOW * gap).min(0.5 * arc.length()) } else { WINDOW * gap };
    let [behind, here, ahead] = [t - window, t, t + window].map(|t| arc.position(surface.mesh, t));
    // On a circle the angle between two chords is that which either spans. Zigzags don't count.
    let turn = (here - behind).angle_between(ahead - here);
    // Next to the end of an arc one chord has no length.
    let turn_of_gap = if turn > 0.0 { turn * gap / window } else { 0.0 };
    (MOST_TURN.to_radians() / turn_of_gap).clamp(LEAST_STRETCH, STRETCH)
}

/// Marks the corners at `v` that lie to the right of its arc: those from the neighbour behind counter-clockwise to the one ahead.
fn mark_right_side(topology: &Topology, v: VertexId, rail: &Rail, normals: &mut IdVec<HalfedgeId, CornerNormal>) {
    let fan: Vec<_> = topology.fan(v).collect();
    let start = fan.iter().position(|&h| topology.to(h) == rail.behind.vertex);
    let Some(start) = start else { return };
    for &h in fan[start..].iter().chain(&fan[..start]) {
        if topology.to(h) == rail.ahead.vertex {
            return;
        }
        normals[h] = CornerNormal::Right;
    }
}

/// Gives the corners at `v`, which sits at corner `c` of the network, the normals of their sectors between arcs.
fn mark_sectors(
    surface: &Surface,
    topology: &Topology,
    map: &RegionMap,
    v: VertexId,
    c: CornerId,
    normals: &mut IdVec<HalfedgeId, CornerNormal>,
) {
    let fan: Vec<_> = topology.fan(v).collect();
    let span_of = |h: HalfedgeId| map.span(v, topology.to(h));
    let start = fan.iter().position(|&h| span_of(h).is_some()).unwrap_or(0);
    let mut normal = DVec3::ZERO;
    for &h in fan[start..].iter().chain(&fan[..start]) {
        if let Some(span) = span_of(h) {
            normal = sector_normal(surface, c, span);
        }
        normals[h] = CornerNormal::Sector(normal);
    }
}

/// The normal of the sector counter-clockwise of a span that leaves corner `c`.
fn sector_normal(surface: &Surface, c: CornerId, span: ArcSpan) -> DVec3 {
    let arc = &surface.network.arcs[span.arc];
    let with_arc = span.from < span.to;
    debug_assert!(arc.corners.is_some_and(|ends| ends[usize::from(!with_arc)] == c));
    let leaving = arc.sides(surface.topology, span.from)[usize::from(!with_arc)];
    leaving.map_or(DVec3::ZERO, |h| surface.normals.at_corner(h))
}

#[cfg(test)]
mod tests {
    use super::*;
    use region_map::{ArcKind, ArcSpan, Network, SheetNormals};

    /// On the rim of a cylinder a gap grows to 45 degrees, or by a half; on its other arcs, which are straight, to three times itself.
    #[test]
    fn gaps_on_a_circle_grow_less_than_on_a_line() {
        let stretches = |mesh: &mesh_core::TriMesh, gap: f64| {
            let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
            let network = Network::trace(mesh, &topology, &ArcKind::by_angle(mesh, &topology, 40.0), |_| false, vec![]);
            let normals = SheetNormals::new(mesh, &topology, &network);
            let surface = Surface { mesh, topology: &topology, network: &network, normals: &normals };
            network.arcs.iter().map(|arc| stretch(&surface, arc, 0.5 * arc.length(), gap)).collect::<Vec<f64>>()
        };
        let cylinder = fixtures::cylinder(1.0, 1.0, 360);
        for (degrees, expected) in [(5.0f64, 3.0), (15.0, 3.0), (20.0, 2.25), (60.0, 1.5), (120.0, 1.5)] {
            let found = stretches(&cylinder, degrees.to_radians());
            assert!(found.len() == 2 && found.iter().all(|s| (s - expected).abs() < 0.02), "{degrees}: {found:?}");
        }
        assert!(stretches(&fixtures::cuboid(DVec3::ONE, 4), 0.1).into_iter().all(|s| s == STRETCH));
    }

    /// A vertex that has come next to its neighbour is kept from it as if it were half-way: it comes no nearer when relaxed again.
    #[test]
    fn gaps_do_not_shrink_with_each_relaxation() {
        let mesh = fixtures::cuboid(DVec3::ONE, 4);
        let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
        let network = Network::trace(&mesh, &topology, &ArcKind::by_angle(&mesh, &topology, 40.0), |_| false, vec![]);
        let normals = SheetNormals::new(&mesh, &topology, &network);
        let surface = Surface { mesh: &mesh, topology: &topology, network: &network, normals: &normals };
        let mut map = RegionMap::identity(&topology, &network);
        let on_arc = |v: VertexId| matches!(map.attachments[v], Attachment::Arc { .. });
        let v = map.vertices().find(|&v| on_arc(v) && topology.one_ring(v).filter(|&w| on_arc(w)).count() == 2).unwrap();
        let Attachment::Arc { arc, t } = map.attachments[v] else { unreachable!() };
        for w in topology.one_ring(v).collect::<Vec<_>>() {
            let Some(span) = map.span(w, v) else { continue };
            // 1e-6 short of the end of its way from the neighbour ahead.
            let near = if span.from > t { span.from - 1e-6 } else { continue };
            map.attachments[v] = Attachment::Arc { arc, t: near };
            map.insert_span(w, v, ArcSpan { to: near, ..span });
            let behind = topology.one_ring(v).find(|&u| u != w && map.span(u, v).is_some()).unwrap();
            let span = map.span(behind, v).unwrap();
            map.insert_span(behind, v, ArcSpan { to: near, ..span });
        }
        let Attachment::Arc { t: near, .. } = map.attachments[v] else { unreachable!() };
        assert!(near > t + 0.2);
        let rail = rail(&surface, &topology, &map, v, arc, near).unwrap();
        assert!((rail.shortest_gap - SHRINK * 0.5).abs() < 1e-5, "{}", rail.shortest_gap);
    }
}
