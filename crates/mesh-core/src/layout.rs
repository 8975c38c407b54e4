//! A face laid out in the plane, for walks over it.

use glam::{DVec2, DVec3};

/// Faces are laid out with at least this height, as a share of their longest edge, so that ones without area can be crossed
/// like all others (as in Sharp and Crane, *A Laplacian for Nonmanifold Triangle Meshes*, 2020, 4.5).
const LEAST_HEIGHT: f64 = 1e-12;
/// A point this close to an edge or a vertex, as a share of the edges' lengths, is taken to be on it. Above [`LEAST_HEIGHT`], so
/// that every point of a face without area is on an edge.
pub(crate) const TOUCH: f64 = 1e-11;
/// Edges shorter than this are laid out with this length, so that areas of faces that are one point do not underflow.
const LEAST_LENGTH: f64 = 1e-100;

/// A triangle in the plane: (0, 0), (`length`, 0), `apex`, with `length` and `apex.y` positive.
pub(crate) struct Layout {
    length: f64,
    apex: DVec2,
}

impl Layout {
    pub(crate) fn new([a, b, c]: [DVec3; 3]) -> Self {
        let (ab, ac) = (b - a, c - a);
        let length = ab.length();
        // One root for all three: the greatest length is the root of the greatest square.
        let longest = ab.length_squared().max(ac.length_squared()).max(c.distance_squared(b)).sqrt().max(LEAST_LENGTH);
        let least = LEAST_HEIGHT * longest;
        if length <= least {
            return Self { length: least, apex: DVec2::new(0.0, longest) };
        }
        Self { length, apex: DVec2::new(ab.dot(ac) / length, (ab.cross(ac).length() / length).max(least)) }
    }

    /// Corner at the start of side `side`.
    fn corner(&self, side: usize) -> DVec2 {
        match side {
            0 => DVec2::ZERO,
            1 => DVec2::new(self.length, 0.0),
            _ => self.apex,
        }
    }

    fn side(&self, side: usize) -> DVec2 {
        self.corner((side + 1) % 3) - self.corner(side)
    }

    pub(crate) fn point(&self, weights: [f64; 3]) -> DVec2 {
        weights[1] * self.corner(1) + weights[2] * self.apex
    }

    fn double_area(&self) -> f64 {
        self.length * self.apex.y
    }

    /// Speed of a way over each side: negative when it leads out there. Exactly 0 over the first side for a way along it.
    fn inward(&self, way: DVec2) -> [f64; 3] {
        [self.length * way.y, self.side(1).perp_dot(way), self.side(2).perp_dot(way)]
    }

    /// The side by which a way leaves the triangle, and after which share of it; `None` when it ends inside.
    pub(crate) fn exit(&self, weights: [f64; 3], way: DVec2) -> Option<(usize, f64)> {
        let inward = self.inward(way);
        let mut first = None;
        for side in 0..3 {
            if inward[side] < 0.0 {
                let share = weights[(side + 2) % 3] * self.double_area() / -inward[side];
                if first.map_or(share < 1.0, |(_, least)| share < least) {
                    first = Some((side, share));
                }
            }
        }
        first
    }

    pub(crate) fn moved(&self, weights: [f64; 3], way: DVec2) -> [f64; 3] {
        let inward = self.inward(way);
        [0, 1, 2].map(|c| (weights[c] + inward[(c + 1) % 3] / self.double_area()).max(0.0))
    }

    /// Where on a side a point next to it lies: 0 at its start, 1 at its end.
    pub(crate) fn along(&self, side: usize, point: DVec2) -> f64 {
        let edge = self.side(side);
        ((point - self.corner(side)).dot(edge) / edge.length_squared()).clamp(0.0, 1.0)
    }

    /// A vector in the frame that has a side along x.
    pub(crate) fn in_frame_of(&self, side: usize, way: DVec2) -> DVec2 {
        let edge = self.side(side);
        DVec2::new(edge.dot(way), self.inward(way)[side]) / edge.length()
    }

    /// Angle at the first corner.
    pub(crate) fn angle(&self) -> f64 {
        self.apex.y.atan2(self.apex.x)
    }

    /// True when a point is on a side.
    pub(crate) fn touches(&self, side: usize, weights: [f64; 3]) -> bool {
        let size = self.length * self.length + self.side(1).length_squared() + self.side(2).length_squared();
        if weights[(side + 2) % 3] * self.double_area() > TOUCH * size {
            return false;
        }
        // Beside the side, in a face without area: on its line, but not between its ends.
        let point = self.point(weights);
        let foot = self.corner(side) + self.along(side, point) * self.side(side);
        foot.distance_squared(point) <= TOUCH * TOUCH * size
    }

    /// True when a point is on no side and at no corner.
    pub(crate) fn is_inside(&self, weights: [f64; 3]) -> bool {
        corner_at(weights).is_none() && (0..3).all(|side| !self.touches(side, weights))
    }

    /// True when a way from a point does not leave by a side that the point is on.
    pub(crate) fn leads_in(&self, weights: [f64; 3], way: DVec2) -> bool {
        let inward = self.inward(way);
        way != DVec2::ZERO && (0..3).all(|side| inward[side] >= 0.0 || !self.touches(side, weights))
    }
}

/// The corner of a face that these weights are at.
pub(crate) fn corner_at(weights: [f64; 3]) -> Option<usize> {
    (0..3).find(|&c| weights[c] >= 1.0 - TOUCH)
}
