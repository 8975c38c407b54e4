//! The sum of squared distances from some planes (Garland and Heckbert, *Surface simplification using quadric error metrics*, 1997).

use glam::{DMat3, DVec3};

/// Squared distances from some planes, weighted: `p A p + 2 b p + c`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quadric {
    a: DMat3,
    b: DVec3,
    c: f64,
    weight: f64,
}

impl Quadric {
    /// That of no plane.
    pub(crate) const NONE: Self = Self { a: DMat3::ZERO, b: DVec3::ZERO, c: 0.0, weight: 0.0 };

    /// The plane through a point with this unit normal.
    pub(crate) fn of_plane(point: DVec3, normal: DVec3, weight: f64) -> Self {
        let d = -normal.dot(point);
        let a = DMat3::from_cols(normal * normal.x, normal * normal.y, normal * normal.z);
        Self { a: a * weight, b: normal * (d * weight), c: d * d * weight, weight }
    }

    /// Both together.
    pub(crate) fn and(&self, other: &Self) -> Self {
        Self { a: self.a + other.a, b: self.b + other.b, c: self.c + other.c, weight: self.weight + other.weight }
    }

    /// The weighted mean of the squared distances of a point; 0 without planes.
    pub(crate) fn mean_at(&self, p: DVec3) -> f64 {
        let sum = p.dot(self.a * p) + 2.0 * self.b.dot(p) + self.c;
        if self.weight > 0.0 { (sum / self.weight).max(0.0) } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_from_two_planes() {
        let floor = Quadric::of_plane(DVec3::new(5.0, 1.0, 2.0), DVec3::Z, 1.0);
        let wall = Quadric::of_plane(DVec3::new(3.0, 7.0, -4.0), DVec3::X, 3.0);
        let p = DVec3::new(4.0, 9.0, 5.0);
        assert!((floor.mean_at(p) - 9.0).abs() < 1e-12);
        assert!((floor.and(&wall).mean_at(p) - (9.0 + 3.0 * 1.0) / 4.0).abs() < 1e-12);
        assert_eq!(Quadric::NONE.mean_at(p), 0.0);
        assert_eq!(Quadric::NONE.and(&floor).mean_at(p), floor.mean_at(p));
    }
}
