//! Straight walks over faces.
//!
//! A walk is a geodesic traced on the unfolded faces (Polthier and Schmies, *Straightest Geodesics on Polyhedral Surfaces*,
//! 1998): only lengths inside faces are used, so turning about an edge is a change of frame and no angle is ever computed but
//! at vertices. Every face is laid out in the plane with the halfedge in hand along the x axis and the face above it.

use crate::layout::{Layout, TOUCH, corner_at};
use crate::{EdgeId, HalfedgeId, Id, SurfacePoint, Topology, TriMesh};
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// A point with no lesser weight than this is inside its face, beside no edge.
const INSIDE: f64 = 1e-9;
/// A walk that only slides at less than this share of its speed stops: cosine of the angle to the barrier.
const LEAST_SLIDE: f64 = 1e-9;
/// A start on an edge leaves its own face at once for one whose plane keeps this share of the way: between the two sides of an
/// edge sharper than 60 degrees the way is turned instead, as it is anywhere else.
const LEAST_INWARD: f64 = 0.5;
/// A walk ends after this many steps from face to face. Between needles that meet in one vertex it can go on for as long as it likes
/// (crank_cse: minutes for one relaxation, when this grew with the mesh).
const MOST_STEPS: usize = 4096;
/// Turning around a vertex stops after this many rounds: less than 360 / 16 degrees of surface are a spike.
const MOST_ROUNDS: usize = 16;

/// Where a walk ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Walked {
    /// The end, in a face that is connected with the start's across edges that may be crossed.
    pub end: SurfacePoint,
    /// Unit direction of travel at the end, in the plane of the end's face; 0 where the walk came to rest at a barrier or did
    /// not move.
    pub direction: DVec3,
    /// True when a border or an edge that may not be crossed took something of the way, or the cap on steps did.
    pub stopped: bool,
}

/// Walks straight on from `start`: along `displacement` projected into the plane of the start's face, as far as the projection
/// is long. A start on an edge or at a vertex belongs to all faces around it that can be reached across edges that may be
/// crossed; the way starts in the one in which the displacement leads inwards and is longest.
///
/// At an edge that may not be crossed (a border edge never may) the walk goes on along it with the component that it has in this
/// direction. `may_cross` is asked for inner edges only.
///
/// A start in a face that is not there stays where it is, and so does every start where `topology` has other vertices than `mesh`.
pub fn walk(
    mesh: &TriMesh,
    topology: &Topology,
    start: SurfacePoint,
    displacement: DVec3,
    may_cross: impl Fn(EdgeId) -> bool,
) -> Walked {
    let Some(surface) = Faces::new(mesh, topology, start, may_cross) else {
        return Walked { end: start, direction: DVec3::ZERO, stopped: true };
    };
    let (walker, stopped) = surface.last(start, displacement);
    let [x, y] = axes(surface.corners(walker.halfedge));
    let direction = (walker.way.x * x + walker.way.y * y).normalize_or_zero();
    let end = surface.end_in_face(start, displacement).unwrap_or_else(|| walker.point());
    Walked { end, direction, stopped }
}

/// Where a [`walk`] ends, in less time: nothing else is worked out.
pub fn walk_end(
    mesh: &TriMesh,
    topology: &Topology,
    start: SurfacePoint,
    displacement: DVec3,
    may_cross: impl Fn(EdgeId) -> bool,
) -> SurfacePoint {
    let Some(surface) = Faces::new(mesh, topology, start, may_cross) else { return start };
    surface.end_in_face(start, displacement).unwrap_or_else(|| surface.last(start, displacement).0.point())
}

/// A point in the face of `halfedge`, with weights that start at the halfedge's corner, and the way still to go, in the layout
/// with the halfedge along x.
#[derive(Clone, Copy)]
struct Walker {
    halfedge: HalfedgeId,
    weights: [f64; 3],
    way: DVec2,
}

impl Walker {
    /// On its way along a displacement, projected into the plane of a face with these corners.
    fn heading(halfedge: HalfedgeId, corners: [DVec3; 3], weights: [f64; 3], displacement: DVec3) -> Self {
        let [x, y] = axes(corners);
        Self { halfedge, weights, way: DVec2::new(displacement.dot(x), displacement.dot(y)) }
    }

    /// Where it is.
    fn point(&self) -> SurfacePoint {
        let [a, b, c] = self.weights;
        let barycentric = match self.halfedge.corner() {
            0 => DVec3::new(a, b, c),
            1 => DVec3::new(c, a, b),
            _ => DVec3::new(b, c, a),
        };
        SurfacePoint::new(self.halfedge.face(), barycentric)
    }
}

enum Step {
    /// All the way is gone.
    Arrived(Walker),
    /// Into a neighbouring face.
    On(Walker),
    /// Along a barrier.
    Slid(Walker),
}

/// What a walk goes over.
struct Faces<'a, F> {
    mesh: &'a TriMesh,
    topology: &'a Topology,
    may_cross: F,
}

impl<'a, F: Fn(EdgeId) -> bool> Faces<'a, F> {
    /// `None` where the start is in no face, or the topology has other vertices than the mesh.
    fn new(mesh: &'a TriMesh, topology: &'a Topology, start: SurfacePoint, may_cross: F) -> Option<Self> {
        let fits = start.face.index() < topology.n_faces() && topology.n_vertices() <= mesh.n_vertices();
        fits.then_some(Self { mesh, topology, may_cross })
    }

    /// The end of a way that begins inside the face of `start` and does not leave it: no layout is needed there.
    fn end_in_face(&self, start: SurfacePoint, displacement: DVec3) -> Option<SurfacePoint> {
        let [a, b, c] = self.corners(HalfedgeId::of(start.face, 0));
        let (ab, ac) = (b - a, c - a);
        let normal = ab.cross(ac);
        let per_area = normal / normal.length_squared();
        let (to_b, to_c) = (displacement.cross(ac).dot(per_area), ab.cross(displacement).dot(per_area));
        let end = start.barycentric + DVec3::new(-to_b - to_c, to_b, to_c);
        // Not so in a face without area, where the end is not a number.
        (start.barycentric.min_element() >= INSIDE && end.min_element() >= INSIDE).then(|| SurfacePoint::new(start.face, end))
    }

    /// The walker at the end of its way, and whether something stopped it.
    fn last(&self, start: SurfacePoint, displacement: DVec3) -> (Walker, bool) {
        let displacement = if displacement.is_finite() { displacement } else { DVec3::ZERO };
        let first = HalfedgeId::of(start.face, 0);
        let weights = SurfacePoint::new(start.face, start.barycentric).barycentric.to_array();
        let corners = self.corners(first);
        let mut layout = Layout::new(corners);
        let mut walker = Walker::heading(first, corners, weights, displacement);
        // Inside a face there is no other to set off in.
        if !layout.is_inside(weights) {
            walker = self.set_off(walker, &layout, displacement);
            layout = self.layout(walker.halfedge);
        }
        let mut stopped = false;
        for _ in 0..MOST_STEPS {
            match self.step(&walker, &layout) {
                Step::Arrived(end) => return (end, stopped),
                Step::On(next) => walker = next,
                Step::Slid(next) => (walker, stopped) = (next, true),
            }
            layout = self.layout(walker.halfedge);
        }
        (walker, true)
    }

    fn layout(&self, h: HalfedgeId) -> Layout {
        Layout::new(self.corners(h))
    }

    fn corners(&self, h: HalfedgeId) -> [DVec3; 3] {
        [self.topology.from(h), self.topology.to(h), self.topology.opposite(h)].map(|v| self.mesh.position(v))
    }

    /// The halfedge across, when there is one and it may be crossed.
    fn across(&self, h: HalfedgeId) -> Option<HalfedgeId> {
        self.topology.twin(h).filter(|_| (self.may_cross)(self.topology.edge(h)))
    }

    /// Walks to the border of the face, or to the end.
    fn step(&self, walker: &Walker, layout: &Layout) -> Step {
        let Walker { halfedge, weights, way } = *walker;
        let Some((side, share)) = layout.exit(weights, way) else {
            let weights = layout.moved(weights, way);
            return Step::Arrived(Walker { weights, ..*walker });
        };
        let along = layout.along(side, layout.point(weights) + share * way);
        let rest = (1.0 - share) * layout.in_frame_of(side, way);
        let edge = turned(halfedge, side);
        if along <= TOUCH {
            return self.round_vertex(edge, rest);
        }
        if along >= 1.0 - TOUCH {
            let rest = (1.0 - share) * layout.in_frame_of((side + 1) % 3, way);
            return self.round_vertex(edge.next(), rest);
        }
        match self.across(edge) {
            Some(twin) => Step::On(Walker { halfedge: twin, weights: [along, 1.0 - along, 0.0], way: -rest }),
            None => {
                let weights = [1.0 - along, along, 0.0];
                Step::Slid(Walker { halfedge: edge, weights, way: DVec2::new(rest.x, 0.0) })
            }
        }
    }

    /// Goes on from the vertex that `h` starts at. `way` is in the frame of `h` and may point anywhere.
    fn round_vertex(&self, h: HalfedgeId, way: DVec2) -> Step {
        let length = way.length();
        let left = way.y.atan2(way.x).rem_euclid(TAU);
        let sweeps = if left <= PI { [(true, left), (false, TAU - left)] } else { [(false, TAU - left), (true, left)] };
        let mut best = (LEAST_SLIDE, Walker { halfedge: h, weights: [1.0, 0.0, 0.0], way: DVec2::ZERO });
        for (counter_clockwise, angle) in sweeps {
            let swept = if counter_clockwise { self.sweep_left(h, angle) } else { self.sweep_right(h, angle) };
            let (halfedge, rest) = match swept {
                Sweep::Inside(halfedge, angle) => {
                    let way = length * DVec2::from_angle(angle);
                    return Step::On(Walker { halfedge, weights: [1.0, 0.0, 0.0], way });
                }
                Sweep::Blocked(halfedge, rest) => (halfedge, rest),
            };
            if rest.cos() > best.0 {
                let (weights, sign) = if counter_clockwise { ([0.0, 1.0, 0.0], -1.0) } else { ([1.0, 0.0, 0.0], 1.0) };
                let way = DVec2::new(sign * rest.cos() * length, 0.0);
                best = (rest.cos(), Walker { halfedge, weights, way });
            }
        }
        Step::Slid(best.1)
    }

    /// Turns counter-clockwise about the start of `h` by `angle`.
    fn sweep_left(&self, h: HalfedgeId, mut angle: f64) -> Sweep {
        let (mut at, mut rounds) = (h, 0);
        loop {
            let corner = self.layout(at).angle();
            if angle <= corner {
                return Sweep::Inside(at, angle);
            }
            angle -= corner;
            match self.across(at.prev()) {
                Some(next) if rounds < MOST_ROUNDS => at = next,
                _ => return Sweep::Blocked(at.prev(), angle),
            }
            rounds += usize::from(at == h);
        }
    }

    /// Turns clockwise about the start of `h` by `angle`.
    fn sweep_right(&self, h: HalfedgeId, mut angle: f64) -> Sweep {
        let (mut at, mut rounds) = (h, 0);
        loop {
            match self.across(at) {
                Some(twin) if rounds < MOST_ROUNDS => at = twin.next(),
                _ => return Sweep::Blocked(at, angle),
            }
            let corner = self.layout(at).angle();
            if angle <= corner {
                return Sweep::Inside(at, corner - angle);
            }
            angle -= corner;
            rounds += usize::from(at == h);
        }
    }

    /// The first walker: in the face around the start in which the inward displacement is longest, or else in the start's own
    /// face, with a way that leads out of it and will be turned over an edge. `own` is in the start's own face, which has this layout.
    fn set_off(&self, own: Walker, layout: &Layout, displacement: DVec3) -> Walker {
        let Walker { halfedge: first, weights, .. } = own;
        let mut best: Option<Walker> = None;
        let mut consider = |walker: Walker, layout: &Layout| {
            let longer = best.is_none_or(|b| walker.way.length_squared() > b.way.length_squared());
            if longer && layout.leads_in(walker.weights, walker.way) {
                best = Some(walker);
            }
        };
        consider(own, layout);
        let mut consider_at = |h: HalfedgeId, weights: [f64; 3]| {
            let corners = self.corners(h);
            consider(Walker::heading(h, corners, weights, displacement), &Layout::new(corners));
        };
        if let Some(corner) = corner_at(weights) {
            self.around(turned(first, corner), |h| consider_at(h, [1.0, 0.0, 0.0]));
        } else if let Some(side) = (0..3).find(|&side| layout.touches(side, weights))
            && let Some(twin) = self.across(turned(first, side))
        {
            let along = layout.along(side, layout.point(weights));
            consider_at(twin, [along, 1.0 - along, 0.0]);
        }
        best.filter(|b| b.way.length() >= LEAST_INWARD * own.way.length()).unwrap_or(own)
    }

    /// Visits the halfedges that start at the same vertex as `h` and can be reached from it: to the left, then to the right.
    fn around(&self, h: HalfedgeId, mut visit: impl FnMut(HalfedgeId)) {
        let mut at = h;
        visit(at);
        while let Some(next) = self.across(at.prev()) {
            if next == h {
                return;
            }
            at = next;
            visit(at);
        }
        at = h;
        while let Some(twin) = self.across(at) {
            at = twin.next();
            visit(at);
        }
    }
}

enum Sweep {
    /// The way leads into the face of this halfedge, at this angle from it.
    Inside(HalfedgeId, f64),
    /// This halfedge may not be crossed, and so much of the angle is left.
    Blocked(HalfedgeId, f64),
}

/// The halfedge `side` steps after `h` in its face.
fn turned(h: HalfedgeId, side: usize) -> HalfedgeId {
    HalfedgeId::of(h.face(), (h.corner() + side) % 3)
}

/// Unit vectors along the first edge of a triangle and, in its plane, to its third corner; any normal pair where it has none.
fn axes([a, b, c]: [DVec3; 3]) -> [DVec3; 2] {
    let up = |x: DVec3| (c - a).reject_from_normalized(x).try_normalize();
    match (b - a).try_normalize() {
        Some(x) => [x, up(x).unwrap_or_else(|| x.any_orthonormal_vector())],
        None => {
            let y = (c - a).try_normalize().unwrap_or(DVec3::Y);
            [y.any_orthonormal_vector(), y]
        }
    }
}
