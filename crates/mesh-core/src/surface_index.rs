//! [`SurfaceIndex`]: closest points and ray hits over any set of faces.
//!
//! A tree of boxes in f32 ([`crate::face_tree`]) finds the candidates. What counts (distances, hits) is computed in f64 on the
//! triangles as they are, and the order of the tree shows in no result: of equal ones the lowest face wins.

use crate::face_tree::{FaceTree, Frame, Leaf, Query};
use crate::measure::Bounds;
use crate::triangle::{Line, closest_on_triangle};
use crate::{FaceId, SurfacePoint, TriMesh};
use glam::{DVec3, Vec3A};
use obvhs::aabb::Aabb;
use rayon::prelude::*;

/// A hit counts when it lies this close to its ray, as a share of the unit frame. Only triangles seen edge-on, where the
/// crossing is all rounding error, are further off. Must stay well below [`crate::face_tree::PADDING`], so that no box hides a hit.
const ON_RAY: f64 = 1e-9;
/// A ray that starts on a triangle hits it even if rounding puts the triangle this far behind; a share of the unit frame.
const BEHIND: f64 = 1e-12;

/// Two sheets of a surface in one place (thin plates, double walls) face both ways. What faces along one of them faces along the
/// surface when this one lies that much farther away at most than the nearest one, as a share of the diagonal of the surface (the
/// figure of the judge that our certificate must agree with).
pub const SHEET_DISTANCE: f64 = 1e-4;

/// One thread looks for the closest points to so many points at least, one after the other. More would leave threads idle on small
/// jobs; fewer would start more searches without the point before.
const POINTS_IN_TURN: usize = 256;
/// Distances from boxes are compared in f32. For points within this distance from the middle of the surface, in the unit frame, the
/// rounding of coordinates is less than the padding of the boxes, and needs no further allowance.
const NEAR: f64 = 4.0;
/// Allowance for the rounding of the distances themselves, a share of them: f32 rounds by 6e-8. Greater only opens more boxes.
const ROUNDING: f64 = 1e-6;
/// Allowance for the rounding of coordinates of points that are not [`NEAR`], as a share of their distance from the middle: three
/// roundings of 6e-8. Greater only opens more boxes.
const FAR_ROUNDING: f64 = 1e-6;

/// The point of a surface that is closest to a query point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest {
    /// The face; the lowest of several at the same distance.
    pub face: FaceId,
    /// Barycentric coordinates in the face.
    pub barycentric: DVec3,
    /// The point itself.
    pub position: DVec3,
    /// Its distance from the query point.
    pub distance: f64,
}

impl Closest {
    /// Face and weights alone.
    pub fn point(&self) -> SurfacePoint {
        SurfacePoint { face: self.face, barycentric: self.barycentric }
    }
}

/// The first point of a surface on a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The face; the lowest of several at the same parameter.
    pub face: FaceId,
    /// Barycentric coordinates in the face.
    pub barycentric: DVec3,
    /// The hit lies at `origin + t * direction`; not negative.
    pub t: f64,
    /// The point itself.
    pub position: DVec3,
}

impl Hit {
    /// Face and weights alone.
    pub fn point(&self) -> SurfacePoint {
        SurfacePoint { face: self.face, barycentric: self.barycentric }
    }
}

/// Triangles arranged for queries. Holds copies, so the mesh may change or go.
#[derive(Clone)]
pub struct SurfaceIndex {
    tree: FaceTree,
}

impl std::fmt::Debug for SurfaceIndex {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "SurfaceIndex of {} faces", self.tree.leaves.len())
    }
}

impl SurfaceIndex {
    /// Indexes all faces of a mesh.
    pub fn new(mesh: &TriMesh) -> Self {
        Self::of_faces(mesh, mesh.faces().ids())
    }

    /// Indexes some faces of a mesh; those that it has not are left out. Without faces every query answers `None`.
    pub fn of_faces(mesh: &TriMesh, faces: impl IntoIterator<Item = FaceId>) -> Self {
        Self { tree: FaceTree::of_faces(mesh, faces) }
    }

    /// The closest point of the surface, `None` without faces or when `point` is not finite.
    pub fn closest(&self, point: DVec3) -> Option<Closest> {
        self.search_closest(point, f64::INFINITY, |_| true)
    }

    /// The closest point at `max_distance` or less.
    pub fn closest_within(&self, point: DVec3, max_distance: f64) -> Option<Closest> {
        self.search_closest(point, max_distance, |_| true)
    }

    /// The closest point on the faces that `keep` holds for.
    pub fn closest_where(&self, point: DVec3, keep: impl Fn(FaceId) -> bool) -> Option<Closest> {
        self.search_closest(point, f64::INFINITY, |leaf| keep(leaf.face))
    }

    /// The closest point at `max_distance` or less on the faces that `keep` holds for.
    pub fn closest_within_where(&self, point: DVec3, max_distance: f64, keep: impl Fn(FaceId) -> bool) -> Option<Closest> {
        self.search_closest(point, max_distance, |leaf| keep(leaf.face))
    }

    /// Whether something at `point` with the normal `normal` (of any length) faces against the surface: the face nearest to it
    /// faces the other way, and none that faces the same way lies in the same place, to [`SHEET_DISTANCE`]. Faces without area
    /// face nowhere.
    ///
    /// A triangle of a remeshed surface is folded when this holds for its middle and its normal.
    pub fn opposes(&self, point: DVec3, normal: DVec3) -> bool {
        let Some((nearest, leaf)) = self.search(point, f64::INFINITY, None, |_| true) else { return false };
        if !leaf.faces_against(normal) {
            return false;
        }
        let reach = nearest.distance + self.sheet_distance();
        self.search(point, reach, None, |leaf| leaf.normal().dot(normal) > 0.0).is_none()
    }

    /// [`SHEET_DISTANCE`] as a length: two sheets that are no farther apart are in the same place.
    pub fn sheet_distance(&self) -> f64 {
        SHEET_DISTANCE * self.tree.bounds.map_or(0.0, |bounds| bounds.diagonal())
    }

    /// Whether the face nearest to `point` faces against `normal` (of any length), whatever other sheets are in the same place.
    pub fn nearest_opposes(&self, point: DVec3, normal: DVec3) -> bool {
        self.search(point, f64::INFINITY, None, |_| true).is_some_and(|(_, leaf)| leaf.faces_against(normal))
    }

    /// The first face on the ray from `origin` along `direction` (of any length but 0), the origin itself included. Faces are
    /// hit from both sides; a face whose plane holds the ray is not hit.
    pub fn first_hit(&self, origin: DVec3, direction: DVec3) -> Option<Hit> {
        let line = Line::new(origin, direction)?;
        let frame = self.tree.frame;
        let mut query = HitQuery { frame, line, start: frame.to_unit(origin), best: None };
        self.tree.descend(&mut query);
        query.best
    }

    /// The first hits along `direction` and against it; `t` of both counts from the origin and is not negative.
    pub fn first_hits_both_ways(&self, origin: DVec3, direction: DVec3) -> [Option<Hit>; 2] {
        [self.first_hit(origin, direction), self.first_hit(origin, -direction)]
    }

    /// The closest points to some points, the same as [`Self::closest`] has them. Faster where points that follow each other are
    /// near each other: the search for one starts with what the one before it found.
    pub fn closest_of_each(&self, points: &[DVec3]) -> Vec<Option<Closest>> {
        self.of_each(points, |closest| closest)
    }

    /// The distances of some points from the surface, as [`Self::closest_of_each`] finds them; infinite where there is none.
    pub fn distances(&self, points: &[DVec3]) -> Vec<f64> {
        self.of_each(points, |closest| closest.map_or(f64::INFINITY, |closest| closest.distance))
    }

    fn of_each<'a, T: Send>(&'a self, points: &[DVec3], of: impl Fn(Option<Closest>) -> T + Sync) -> Vec<T> {
        let start = || None;
        let next = |before: &mut Option<&'a Leaf>, &point: &DVec3| {
            let found = self.search(point, f64::INFINITY, *before, |_| true);
            *before = found.map(|(_, leaf)| leaf).or(*before);
            of(found.map(|(closest, _)| closest))
        };
        points.par_iter().with_min_len(POINTS_IN_TURN).map_init(start, next).collect()
    }

    /// The faces for which something holds together with some other face, in rising order. It is asked of two faces whose boxes
    /// meet and of the positions of their corners; once it holds for the first of the two with any, it is not asked again.
    pub fn faces_that_meet(&self, holds: impl Fn([FaceId; 2], [&[DVec3; 3]; 2]) -> bool + Sync) -> Vec<FaceId> {
        let mut faces: Vec<FaceId> = self
            .tree
            .leaf_nodes()
            .into_par_iter()
            .flat_map_iter(|(range, unit_box)| {
                let mut meeting = Meeting::of(&self.tree.leaves[range]);
                self.tree.for_each_meeting(&unit_box, |others| {
                    meeting.look_at(others, &holds);
                    !meeting.left.is_empty()
                });
                meeting.found
            })
            .collect();
        faces.sort_unstable();
        faces
    }

    fn search_closest(&self, point: DVec3, max_distance: f64, keep: impl Fn(&Leaf) -> bool) -> Option<Closest> {
        self.search(point, max_distance, None, keep).map(|(closest, _)| closest)
    }

    /// The closest point, and its face. `first` is looked at first.
    fn search<'a>(
        &'a self,
        point: DVec3,
        max_distance: f64,
        first: Option<&'a Leaf>,
        keep: impl Fn(&Leaf) -> bool,
    ) -> Option<(Closest, &'a Leaf)> {
        if !point.is_finite() {
            return None;
        }
        let mut query = ClosestQuery::new(self.tree.frame, point, max_distance, keep);
        if let Some(first) = first {
            query.visit(first);
        }
        self.tree.descend(&mut query);
        query.best
    }
}

/// The closest point among triangles.
struct ClosestQuery<'a, Keep> {
    point: DVec3,
    keep: Keep,
    max_distance: f64,
    best: Option<(Closest, &'a Leaf)>,
    /// The point in the frame of the boxes.
    unit: Vec3A,
    limit: f32,
    slack: f64,
    size: f64,
}

impl<'a, Keep: Fn(&Leaf) -> bool> ClosestQuery<'a, Keep> {
    fn new(frame: Frame, point: DVec3, max_distance: f64, keep: Keep) -> Self {
        let unit = frame.to_unit(point);
        let from_origin = unit.abs().max_element();
        let slack = if from_origin < NEAR { 0.0 } else { FAR_ROUNDING * from_origin };
        let mut query =
            Self { point, keep, max_distance, best: None, unit: unit.as_vec3a(), limit: 0.0, slack, size: frame.size };
        query.limit = query.bound_of(max_distance);
        query
    }

    /// No box that holds something at this distance has a greater lower bound.
    fn bound_of(&self, distance: f64) -> f32 {
        let unit = distance / self.size * (1.0 + ROUNDING) + self.slack;
        (unit * unit) as f32
    }
}

impl<'a, Keep: Fn(&Leaf) -> bool> Query<'a> for ClosestQuery<'a, Keep> {
    /// The square of the distance from the box, in its frame.
    type Bound = f32;

    fn lower_bound(&self, unit_box: &Aabb) -> f32 {
        (unit_box.min - self.unit).max(self.unit - unit_box.max).max(Vec3A::ZERO).length_squared()
    }

    fn limit(&self) -> f32 {
        self.limit
    }

    fn visit(&mut self, leaf: &'a Leaf) {
        let is_best = self.best.is_some_and(|(_, best)| std::ptr::eq(best, leaf));
        if is_best || !(self.keep)(leaf) {
            return;
        }
        let barycentric = closest_on_triangle(self.point, leaf.triangle);
        let position = SurfacePoint { face: leaf.face, barycentric }.interpolate(leaf.triangle);
        let distance = position.distance(self.point);
        let better = self.best.is_none_or(|(best, _)| (distance, leaf.face) < (best.distance, best.face));
        if distance <= self.max_distance && better {
            self.limit = self.bound_of(distance);
            self.best = Some((Closest { face: leaf.face, barycentric, position, distance }, leaf));
        }
    }
}

/// Some faces that lie together, and which of them were found to meet others.
struct Meeting<'a> {
    /// Those not found yet, with their boxes.
    left: Vec<(&'a Leaf, Bounds)>,
    found: Vec<FaceId>,
}

impl<'a> Meeting<'a> {
    fn of(leaves: &'a [Leaf]) -> Self {
        let with_box = |leaf: &'a Leaf| Bounds::of(leaf.triangle).map(|bounds| (leaf, bounds));
        Self { left: leaves.iter().filter_map(with_box).collect(), found: Vec::new() }
    }

    fn look_at(&mut self, others: &[Leaf], holds: &impl Fn([FaceId; 2], [&[DVec3; 3]; 2]) -> bool) {
        for other in others {
            let Some(box_of_other) = Bounds::of(other.triangle) else { continue };
            let Self { left, found } = self;
            left.retain(|(leaf, own_box)| {
                let is_found = leaf.face != other.face
                    && own_box.meets(&box_of_other)
                    && holds([leaf.face, other.face], [&leaf.triangle, &other.triangle]);
                if is_found {
                    found.push(leaf.face);
                }
                !is_found
            });
        }
    }
}

/// The first triangle on a ray.
struct HitQuery {
    frame: Frame,
    line: Line,
    start: DVec3,
    best: Option<Hit>,
}

impl Query<'_> for HitQuery {
    type Bound = f64;

    /// Parameter where the ray enters the box (Kay and Kajiya's slabs). A ray in the plane of a padded face is half a padding
    /// away from all triangles, so it does not matter what the 0 times infinity of that case gives.
    fn lower_bound(&self, unit_box: &Aabb) -> f64 {
        let inverse = self.frame.size / self.line.direction;
        let to_min = (unit_box.min.as_dvec3() - self.start) * inverse;
        let to_max = (unit_box.max.as_dvec3() - self.start) * inverse;
        let enter = to_min.min(to_max).max_element();
        let leave = to_min.max(to_max).min_element();
        if enter <= leave && leave >= 0.0 { enter } else { f64::INFINITY }
    }

    fn limit(&self) -> f64 {
        // Not infinity: boxes that the ray misses have that bound.
        self.best.map_or(f64::MAX, |best| best.t)
    }

    fn visit(&mut self, leaf: &Leaf) {
        let Some(barycentric) = self.line.crossing(leaf.triangle) else { return };
        let position = SurfacePoint { face: leaf.face, barycentric }.interpolate(leaf.triangle);
        let t = self.line.parameter(position);
        let off = position.distance(self.line.origin + t * self.line.direction);
        let reach = t * self.line.direction.length();
        if off > ON_RAY * self.frame.size || reach < -BEHIND * self.frame.size {
            return;
        }
        let t = t.max(0.0);
        if self.best.is_none_or(|best| (t, leaf.face) < (best.t, best.face)) {
            self.best = Some(Hit { face: leaf.face, barycentric, t, position });
        }
    }
}
