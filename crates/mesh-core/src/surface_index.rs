//! [`SurfaceIndex`]: closest points and ray hits over any set of faces.
//!
//! A bounding volume hierarchy from `obvhs` finds the candidates; it is f32, so the boxes live in a frame of unit size, are
//! rounded outwards and padded. What counts (distances, hits) is computed in f64 on the triangles as they are, and the order of
//! the hierarchy shows in no result: of equal ones the lowest face wins.

use crate::measure::{Bounds, normal};
use crate::triangle::{Line, closest_on_triangle};
use crate::{FaceId, SurfacePoint, TriMesh};
use glam::{DVec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use obvhs::bvh2::node::Bvh2Node;
use std::time::Duration;

/// Boxes are grown by this share of the unit frame: f32 rounds 16 times finer, and a ray exactly in the unpadded face of a box
/// was measured to miss it (258 of 8450 rays along the borders of flat patches).
const PADDING: f64 = 1e-6;
/// Where boxes are equal the builder joins one pair at a time (measured: 12 s for 20 000 equal triangles, 0.05 s with spread
/// paddings). The multiples of this spread evenly over a cube (Roberts's sequence R3).
const SPREAD: DVec3 = DVec3::new(0.819_172_513_396_164, 0.671_043_606_703_789, 0.549_700_477_901_970);
/// A hit counts when it lies this close to its ray, as a share of the unit frame. Only triangles seen edge-on, where the
/// crossing is all rounding error, are further off. Must stay well below [`PADDING`], so that no box hides a hit.
const ON_RAY: f64 = 1e-9;
/// A ray that starts on a triangle hits it even if rounding puts the triangle this far behind; a share of the unit frame.
const BEHIND: f64 = 1e-12;

/// Two sheets of a surface in one place (thin plates, double walls) face both ways. What faces along one of them faces along the
/// surface when this one lies that much farther away at most than the nearest one, as a share of the diagonal of the surface (the
/// figure of the judge that our certificate must agree with).
pub const SHEET_DISTANCE: f64 = 1e-4;

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
    tree: Bvh2,
    leaves: Vec<Leaf>,
    frame: Frame,
    /// Of the box of the faces, in the units of the mesh.
    diagonal: f64,
}

impl std::fmt::Debug for SurfaceIndex {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "SurfaceIndex of {} faces", self.leaves.len())
    }
}

#[derive(Clone, Copy)]
struct Leaf {
    face: FaceId,
    triangle: [DVec3; 3],
}

impl Leaf {
    /// Unit normal, 0 without area.
    fn normal(&self) -> DVec3 {
        normal(self.triangle)
    }

    fn faces_against(&self, other: DVec3) -> bool {
        self.normal().dot(other) < 0.0
    }
}

impl SurfaceIndex {
    /// Indexes all faces of a mesh.
    pub fn new(mesh: &TriMesh) -> Self {
        Self::of_faces(mesh, mesh.faces().ids())
    }

    /// Indexes some faces of a mesh. Without faces every query answers `None`.
    pub fn of_faces(mesh: &TriMesh, faces: impl IntoIterator<Item = FaceId>) -> Self {
        let leaves: Vec<_> = faces.into_iter().map(|face| Leaf { face, triangle: mesh.triangle(face) }).collect();
        let bounds = Bounds::of(leaves.iter().flat_map(|leaf| leaf.triangle));
        let frame = Frame::of(bounds);
        let boxes: Vec<_> = leaves.iter().enumerate().map(|(i, leaf)| frame.padded_box(leaf.triangle, i)).collect();
        let tree = build_bvh2(&boxes, BvhBuildParams::medium_build(), &mut Duration::default());
        let leaves = tree.primitive_indices.iter().map(|&i| leaves[i as usize]).collect();
        Self { tree, leaves, frame, diagonal: bounds.map_or(0.0, |bounds| bounds.diagonal()) }
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

    /// Whether something at `point` with the normal `normal` (of any length) faces against the surface: the face nearest to it
    /// faces the other way, and none that faces the same way lies in the same place, to [`SHEET_DISTANCE`]. Faces without area
    /// face nowhere.
    ///
    /// A triangle of a remeshed surface is folded when this holds for its middle and its normal.
    pub fn opposes(&self, point: DVec3, normal: DVec3) -> bool {
        let Some((nearest, leaf)) = self.search(point, f64::INFINITY, |_| true) else { return false };
        if !leaf.faces_against(normal) {
            return false;
        }
        let reach = nearest.distance + SHEET_DISTANCE * self.diagonal;
        let other_sheet = self.search_closest(point, f64::INFINITY, |leaf| leaf.normal().dot(normal) > 0.0);
        other_sheet.is_none_or(|sheet| sheet.distance > reach)
    }

    /// Whether the face nearest to `point` faces against `normal` (of any length), whatever other sheets are in the same place.
    pub fn nearest_opposes(&self, point: DVec3, normal: DVec3) -> bool {
        self.search(point, f64::INFINITY, |_| true).is_some_and(|(_, leaf)| leaf.faces_against(normal))
    }

    /// The first face on the ray from `origin` along `direction` (of any length but 0), the origin itself included. Faces are
    /// hit from both sides; a face whose plane holds the ray is not hit.
    pub fn first_hit(&self, origin: DVec3, direction: DVec3) -> Option<Hit> {
        let line = Line::new(origin, direction)?;
        let mut query = HitQuery { frame: &self.frame, line, start: self.frame.to_unit(origin), best: None };
        self.descend(&mut query);
        query.best
    }

    /// The first hits along `direction` and against it; `t` of both counts from the origin and is not negative.
    pub fn first_hits_both_ways(&self, origin: DVec3, direction: DVec3) -> [Option<Hit>; 2] {
        [self.first_hit(origin, direction), self.first_hit(origin, -direction)]
    }

    /// Whether something holds for one of the faces whose own box meets `bounds`, or misses it by a little. Looks no further once it
    /// does.
    pub fn any_in_box(&self, bounds: &Bounds, holds: impl FnMut(FaceId) -> bool) -> bool {
        let unit_box = self.frame.padded_box([bounds.min, bounds.max, bounds.max], 0);
        let mut query = BoxQuery { unit_box, holds, found: false };
        self.descend(&mut query);
        query.found
    }

    fn search_closest(&self, point: DVec3, max_distance: f64, keep: impl Fn(&Leaf) -> bool) -> Option<Closest> {
        self.search(point, max_distance, keep).map(|(closest, _)| closest)
    }

    fn search(&self, point: DVec3, max_distance: f64, keep: impl Fn(&Leaf) -> bool) -> Option<(Closest, &Leaf)> {
        if !point.is_finite() {
            return None;
        }
        let unit = self.frame.to_unit(point);
        let mut query = ClosestQuery { frame: &self.frame, point, unit, max_distance, keep, best: None };
        self.descend(&mut query);
        query.best
    }

    fn descend<'a>(&'a self, query: &mut impl Query<'a>) {
        if let Some(root) = self.tree.nodes.first() {
            self.descend_into(root, query);
        }
    }

    fn descend_into<'a>(&'a self, node: &Bvh2Node, query: &mut impl Query<'a>) {
        let first = node.first_index as usize;
        if node.is_leaf() {
            for leaf in &self.leaves[first..first + node.prim_count as usize] {
                query.visit(leaf);
            }
            return;
        }
        let children = [&self.tree.nodes[first], &self.tree.nodes[first + 1]];
        let bounds = children.map(|child| query.lower_bound(child.aabb()));
        let near = usize::from(bounds[1] < bounds[0]);
        for i in [near, 1 - near] {
            if bounds[i] <= query.limit() {
                self.descend_into(children[i], query);
            }
        }
    }
}

/// A search for the face with the least value of something.
trait Query<'a> {
    /// No face in the box has a lower value. Infinite where none counts.
    fn lower_bound(&self, unit_box: &Aabb) -> f64;
    /// Values above this are of no interest any more.
    fn limit(&self) -> f64;
    /// Looks at one face.
    fn visit(&mut self, leaf: &'a Leaf);
}

struct ClosestQuery<'a, Keep> {
    frame: &'a Frame,
    point: DVec3,
    unit: DVec3,
    max_distance: f64,
    keep: Keep,
    best: Option<(Closest, &'a Leaf)>,
}

impl<'a, Keep: Fn(&Leaf) -> bool> Query<'a> for ClosestQuery<'a, Keep> {
    fn lower_bound(&self, unit_box: &Aabb) -> f64 {
        let outside = (unit_box.min.as_dvec3() - self.unit).max(self.unit - unit_box.max.as_dvec3()).max(DVec3::ZERO);
        outside.length() * self.frame.size
    }

    fn limit(&self) -> f64 {
        self.best.map_or(self.max_distance, |(best, _)| best.distance)
    }

    fn visit(&mut self, leaf: &'a Leaf) {
        if !(self.keep)(leaf) {
            return;
        }
        let barycentric = closest_on_triangle(self.point, leaf.triangle);
        let position = SurfacePoint { face: leaf.face, barycentric }.interpolate(leaf.triangle);
        let distance = position.distance(self.point);
        let better = self.best.is_none_or(|(best, _)| (distance, leaf.face) < (best.distance, best.face));
        if distance <= self.max_distance && better {
            self.best = Some((Closest { face: leaf.face, barycentric, position, distance }, leaf));
        }
    }
}

struct BoxQuery<Holds> {
    unit_box: Aabb,
    holds: Holds,
    found: bool,
}

impl<Holds: FnMut(FaceId) -> bool> Query<'_> for BoxQuery<Holds> {
    fn lower_bound(&self, unit_box: &Aabb) -> f64 {
        if self.unit_box.intersect_aabb(unit_box) { 0.0 } else { f64::INFINITY }
    }

    fn limit(&self) -> f64 {
        if self.found { f64::NEG_INFINITY } else { f64::MAX }
    }

    fn visit(&mut self, leaf: &Leaf) {
        self.found = self.found || (self.holds)(leaf.face);
    }
}

struct HitQuery<'a> {
    frame: &'a Frame,
    line: Line,
    start: DVec3,
    best: Option<Hit>,
}

impl Query<'_> for HitQuery<'_> {
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

/// The frame in which the indexed triangles fit a box of size 1 around the origin.
#[derive(Clone, Copy)]
struct Frame {
    centre: DVec3,
    size: f64,
}

impl Frame {
    fn of(bounds: Option<Bounds>) -> Self {
        let Some(bounds) = bounds else {
            return Self { centre: DVec3::ZERO, size: 1.0 };
        };
        let size = (bounds.max - bounds.min).max_element();
        Self { centre: bounds.centre(), size: if size > 0.0 { size } else { 1.0 } }
    }

    fn to_unit(self, p: DVec3) -> DVec3 {
        (p - self.centre) / self.size
    }

    /// The box of a triangle, with one to two paddings on each side: no two boxes are quite equal, even of equal triangles.
    fn padded_box(self, triangle: [DVec3; 3], index: usize) -> Aabb {
        let [a, b, c] = triangle.map(|p| self.to_unit(p));
        let spread = (index as f64 * SPREAD).fract();
        let min = (a.min(b).min(c) - PADDING * (1.0 + spread)).to_array().map(|x| (x as f32).next_down());
        let max = (a.max(b).max(c) + PADDING * (2.0 - spread)).to_array().map(|x| (x as f32).next_up());
        Aabb::new(Vec3A::from_array(min), Vec3A::from_array(max))
    }
}
