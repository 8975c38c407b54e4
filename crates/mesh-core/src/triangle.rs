//! Closest point on a triangle and ray against triangle, in f64.

use glam::{DMat3, DVec2, DVec3};

/// Barycentric coordinates of the point of a triangle that is closest to `point`.
///
/// Inside where the foot of the perpendicular falls (by cross products, which stay accurate on needles where the dot products
/// of Ericson, *Real-Time Collision Detection*, 5.1.5, cancel), else on the nearest edge. Triangles without area are their edges.
pub fn closest_on_triangle(point: DVec3, [a, b, c]: [DVec3; 3]) -> DVec3 {
    let n = (b - a).cross(c - a);
    let inner = DVec3::new(n.dot((c - b).cross(point - b)), n.dot((a - c).cross(point - c)), n.dot((b - a).cross(point - a)));
    if inner.min_element() > 0.0 {
        return inner / inner.element_sum();
    }
    let on_ab = closest_on_segment(point, a, b);
    let on_bc = closest_on_segment(point, b, c);
    let on_ca = closest_on_segment(point, c, a);
    let mut best = (DVec3::new(1.0 - on_ab, on_ab, 0.0), a.lerp(b, on_ab).distance_squared(point));
    for (weights, position) in
        [(DVec3::new(0.0, 1.0 - on_bc, on_bc), b.lerp(c, on_bc)), (DVec3::new(on_ca, 0.0, 1.0 - on_ca), c.lerp(a, on_ca))]
    {
        let distance = position.distance_squared(point);
        if distance < best.1 {
            best = (weights, distance);
        }
    }
    best.0
}

/// Barycentric coordinates of a point in the plane of a triangle, also beside the triangle: their sum is 1. Of a triangle without area those
/// of its nearest point.
pub fn barycentric(point: DVec3, [a, b, c]: [DVec3; 3]) -> DVec3 {
    let (ab, ac) = (b - a, c - a);
    let inverse = DMat3::from_cols(ab, ac, ab.cross(ac).normalize_or_zero()).inverse();
    if !inverse.is_finite() {
        return closest_on_triangle(point, [a, b, c]);
    }
    let mut weights = inverse * (point - a);
    // Once more with what rounding left over: then also long and flat triangles give the point back.
    weights += inverse * (point - a - weights.x * ab - weights.y * ac);
    DVec3::new(1.0 - weights.x - weights.y, weights.x, weights.y)
}

/// Where on the segment from `a` (0) to `b` (1) the point closest to `point` lies; 0 on a segment without length.
pub fn closest_on_segment(point: DVec3, a: DVec3, b: DVec3) -> f64 {
    let ab = b - a;
    let length_squared = ab.length_squared();
    if length_squared > 0.0 { (ab.dot(point - a) / length_squared).clamp(0.0, 1.0) } else { 0.0 }
}

/// The distance of a point from the segment from `a` to `b`.
pub fn distance_to_segment(point: DVec3, a: DVec3, b: DVec3) -> f64 {
    point.distance(a.lerp(b, closest_on_segment(point, a, b)))
}

/// A line through space, prepared for many triangles.
///
/// Woop, Benthin, Wald, *Watertight Ray/Triangle Intersection*, JCGT 2013: triangles are sheared so that the line becomes the
/// z axis. The sign of a shared edge is then the same number in both triangles, so no line slips between them.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// A point of the line.
    pub origin: DVec3,
    /// Its direction, of any length but 0.
    pub direction: DVec3,
    axes: [usize; 3],
    shear: DVec2,
}

impl Line {
    /// The line through `origin` along `direction`; `None` when the direction is 0 or anything is not finite.
    pub fn new(origin: DVec3, direction: DVec3) -> Option<Self> {
        let z = direction.abs().max_position();
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let shear = DVec2::new(direction[axes[0]], direction[axes[1]]) / direction[z];
        (shear.is_finite() && origin.is_finite()).then_some(Self { origin, direction, axes, shear })
    }

    /// Barycentric coordinates of the point where the line passes through the triangle, edges and corners included; `None`
    /// beside it, and where the line lies in its plane.
    pub fn crossing(&self, triangle: [DVec3; 3]) -> Option<DVec3> {
        let [a, b, c] = triangle.map(|p| self.sheared(p - self.origin));
        let weights = DVec3::new(b.perp_dot(c), c.perp_dot(a), a.perp_dot(b));
        let sum = weights.element_sum();
        let beside = weights.min_element() < 0.0 && weights.max_element() > 0.0;
        (!beside && sum != 0.0).then(|| weights / sum)
    }

    /// The parameter of the point of the line that is closest to `point`: it is `origin + t * direction`.
    pub fn parameter(&self, point: DVec3) -> f64 {
        (point - self.origin).dot(self.direction) / self.direction.length_squared()
    }

    fn sheared(&self, p: DVec3) -> DVec2 {
        let [x, y, z] = self.axes;
        DVec2::new(p[x], p[y]) - self.shear * p[z]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FaceId;
    use crate::SurfacePoint;

    const FLAT: [DVec3; 3] = [DVec3::ZERO, DVec3::X, DVec3::Y];

    fn closest(point: DVec3, triangle: [DVec3; 3]) -> DVec3 {
        let barycentric = closest_on_triangle(point, triangle);
        assert!(barycentric.min_element() >= 0.0 && (barycentric.element_sum() - 1.0).abs() < 1e-15);
        SurfacePoint { face: FaceId(0), barycentric }.interpolate(triangle)
    }

    /// A triangle a million times as long as high, far from the origin, gives every point of its plane back to rounding.
    #[test]
    fn flat_triangles_give_their_points_back() {
        let triangle @ [a, b, c] = [[3.0, 2.0, 1.0], [4.0, 2.5, 1.25], [3.5, 2.25, 1.125 + 2e-6]].map(DVec3::from);
        for [x, y] in [[0.2, 0.3], [1.5, -0.4], [-200.0, 100.0]] {
            let q = a + x * (b - a) + y * (c - a);
            let weights = barycentric(q, triangle);
            let back = weights.x * a + weights.y * b + weights.z * c;
            assert!(back.distance(q) < 1e-15 * (1.0 + q.length()) * (1.0 + weights.abs().max_element()), "{weights}");
        }
        assert_eq!(barycentric(b, [a, b, b]), closest_on_triangle(b, [a, b, b]));
    }

    #[test]
    fn all_regions_of_a_triangle() {
        let cases = [
            ([0.25, 0.25, 3.0], [0.25, 0.25, 0.0]),
            ([-1.0, -1.0, 1.0], [0.0, 0.0, 0.0]),
            ([2.0, 0.0, -1.0], [1.0, 0.0, 0.0]),
            ([-0.1, 5.0, 0.0], [0.0, 1.0, 0.0]),
            ([0.5, -1.0, 0.0], [0.5, 0.0, 0.0]),
            ([-1.0, 0.25, 0.0], [0.0, 0.25, 0.0]),
            ([1.0, 1.0, 1.0], [0.5, 0.5, 0.0]),
        ];
        for (point, expected) in cases {
            assert!(closest(point.into(), FLAT).distance(expected.into()) < 1e-15, "{point:?}");
        }
    }

    #[test]
    fn triangles_without_area_are_segments_or_points() {
        let p = DVec3::new(0.7, 1.0, 0.0);
        let foot = DVec3::new(0.7, 0.0, 0.0);
        for cap in [[DVec3::ZERO, DVec3::X, 0.5 * DVec3::X], [DVec3::ZERO, DVec3::X, DVec3::X]] {
            for k in 0..3 {
                let turned = [cap[k], cap[(k + 1) % 3], cap[(k + 2) % 3]];
                assert!(closest(p, turned).distance(foot) < 1e-15);
            }
        }
        assert_eq!(closest(p, [DVec3::Z; 3]), DVec3::Z);
    }

    #[test]
    fn a_line_through_an_edge_meets_both_sides() {
        let quad = [DVec3::ZERO, DVec3::X, DVec3::ONE, DVec3::Y];
        for i in 1..1000 {
            let p = DVec3::ZERO.lerp(DVec3::ONE, f64::from(i) / 1000.0);
            let line = Line::new(p + DVec3::new(0.3, -0.2, 5.0), DVec3::new(-0.3, 0.2, -5.0)).unwrap();
            let lower = line.crossing([quad[0], quad[1], quad[2]]).is_some();
            let upper = line.crossing([quad[0], quad[2], quad[3]]).is_some();
            assert!(lower || upper, "{i}");
        }
        assert!(Line::new(DVec3::ZERO, DVec3::ZERO).is_none());
        assert!(Line::new(DVec3::NAN, DVec3::X).is_none());
        let in_plane = Line::new(DVec3::ZERO, DVec3::X).unwrap();
        assert!(in_plane.crossing(FLAT).is_none());
    }
}
