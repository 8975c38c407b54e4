//! [`Frame`]: the axes that the displacement of a vertex is measured along.

use glam::DVec3;

/// Three orthogonal unit vectors at an edge: the normal there, the direction of the edge, and the one across both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The mean normal of the one or two faces at the edge, weighted by their areas.
    pub normal: DVec3,
    /// The direction of the edge from its end of the lower number to the other one, made orthogonal to the normal.
    pub along: DVec3,
    /// The cross product of the normal and the direction.
    pub across: DVec3,
}

impl Frame {
    /// The frame of an edge from `a` to `b` where the sum of the vector areas of its faces is `area`.
    ///
    /// Where that sum has no direction, any vector orthogonal to the edge is the normal, and the z axis where the edge has no length. Where the
    /// edge has no direction beside the normal, any vector orthogonal to the normal is its direction. What "any" is depends on the edge alone,
    /// so encoding and decoding agree.
    pub fn new([a, b]: [DVec3; 2], area: DVec3) -> Self {
        let edge = b - a;
        let orthogonal = || edge.try_normalize().map_or(DVec3::Z, |direction| direction.any_orthonormal_vector());
        let normal = area.try_normalize().unwrap_or_else(orthogonal);
        let along = rejected(edge, normal).unwrap_or_else(|| normal.any_orthonormal_vector());
        Self { normal, along, across: normal.cross(along) }
    }

    /// A vector in this frame: its part along the normal, and its two parts orthogonal to that.
    pub fn coordinates(&self, vector: DVec3) -> (f64, [f64; 2]) {
        (vector.dot(self.normal), [vector.dot(self.along), vector.dot(self.across)])
    }

    /// The vector with these coordinates.
    pub fn vector(&self, scalar: f64, [along, across]: [f64; 2]) -> DVec3 {
        scalar * self.normal + along * self.along + across * self.across
    }
}

/// The direction of what is left of a vector when its part along a unit vector is taken away.
fn rejected(vector: DVec3, unit: DVec3) -> Option<DVec3> {
    let once = |vector: DVec3| (vector - vector.dot(unit) * unit).try_normalize();
    // Once more: where hardly anything is left, the first time leaves an error of rounding that is not small beside it.
    once(vector).and_then(once)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(frame: Frame) {
        let Frame { normal, along, across } = frame;
        for (a, b, dot) in [
            (normal, normal, 1.0),
            (along, along, 1.0),
            (across, across, 1.0),
            (normal, along, 0.0),
            (along, across, 0.0),
            (across, normal, 0.0),
        ] {
            assert!((a.dot(b) - dot).abs() < 1e-15, "{frame:?}");
        }
        let vector = DVec3::new(0.3, -2.0, 5.0);
        let (scalar, residual) = frame.coordinates(vector);
        assert!(frame.vector(scalar, residual).distance(vector) < 1e-14);
    }

    #[test]
    fn a_flat_edge_has_the_normal_of_its_plane() {
        let frame = Frame::new([DVec3::ZERO, 2.0 * DVec3::X], 7.0 * DVec3::Z);
        assert_eq!(frame, Frame { normal: DVec3::Z, along: DVec3::X, across: DVec3::Y });
    }

    #[test]
    fn every_edge_has_a_frame() {
        let lengths = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1e-9, 0.0), DVec3::splat(1e-200), DVec3::splat(1e300)];
        let areas = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, -3.0, 1e-5), DVec3::splat(1e-320), DVec3::splat(f64::INFINITY)];
        for edge in lengths {
            areas.iter().for_each(|&area| check(Frame::new([DVec3::ZERO, edge], area)));
        }
    }
}
