//! A vertex in its place on the surface, and the ways from there: over its sheet by walking, along its arc by sliding.

use crate::freedom::OnArc;
use crate::movable_domain::MovableDomain;
use glam::DVec3;
use mesh_core::{HalfedgeId, SurfacePoint, walk_end};

/// The place of a vertex on the surface.
#[derive(Clone, Copy, Debug)]
pub struct PlacedVertex {
    pub(crate) point: SurfacePoint,
    /// Arc length on the arc, not wrapped around on a loop; 0 off the arcs.
    pub(crate) t: f64,
    pub(crate) position: DVec3,
    /// The surface's unit normals left and right of the arc; twice the same off the arcs.
    pub(crate) normals: [DVec3; 2],
}

impl PlacedVertex {
    /// The point of the working mesh.
    pub fn point(&self) -> SurfacePoint {
        self.point
    }

    /// Position in space.
    pub fn position(&self) -> DVec3 {
        self.position
    }

    /// The arc length on the arc, not wrapped around on a loop: it may be below 0 or beyond the loop's length. 0 off the arcs.
    pub fn arc_length(&self) -> f64 {
        self.t
    }

    /// The unit normals of the surface left and right of the arc; twice the same one off the arcs.
    pub fn normals(&self) -> [DVec3; 2] {
        self.normals
    }
}

impl MovableDomain<'_> {
    /// Unit direction of an arc at arc length `t`.
    pub(crate) fn arc_direction(&self, on_arc: &OnArc, t: f64) -> DVec3 {
        let arc = &self.surface.network().arcs[on_arc.arc];
        let (i, _) = arc.segment(t);
        let [a, b] = [i, i + 1].map(|i| self.surface.mesh().position(arc.vertices[i]));
        (b - a).normalize_or_zero()
    }

    pub(crate) fn placed_on_sheet(&self, point: SurfacePoint) -> PlacedVertex {
        let normal = self.surface.normals().at(point);
        PlacedVertex { point, t: 0.0, position: point.position(self.surface.mesh()), normals: [normal; 2] }
    }

    pub(crate) fn placed_on_arc(&self, on_arc: &OnArc, t: f64) -> PlacedVertex {
        let arc = &self.surface.network().arcs[on_arc.arc];
        let point = arc.point(self.surface.topology(), t);
        let (_, s) = arc.segment(t);
        let [left, right] = arc.sides(self.surface.topology(), t);
        let normal = |h: Option<HalfedgeId>, s| h.map_or(DVec3::ZERO, |h| self.surface.normals().along(h, s));
        PlacedVertex {
            point,
            t,
            position: point.position(self.surface.mesh()),
            normals: [normal(left, s), normal(right, 1.0 - s)],
        }
    }

    /// The place after a walk over its sheet. One of another surface, where this has no such face, stays.
    pub(crate) fn walked(&self, placed: &PlacedVertex, displacement: DVec3) -> PlacedVertex {
        let Self { surface, longest_move, .. } = self;
        if surface.mesh().faces().get(placed.point.face).is_none() {
            return *placed;
        }
        let displacement = displacement.clamp_length_max(*longest_move);
        let may_cross = |e| !surface.network().is_barrier(e);
        self.placed_on_sheet(walk_end(surface.mesh(), surface.topology(), placed.point, displacement, may_cross))
    }
}
