//! Exact signs (Shewchuk, *Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates*, 1997; crate
//! `robust`). Use these where a decision hangs on a sign.

use glam::{DVec2, DVec3};
use robust::{Coord, Coord3D};

/// Positive when `a`, `b`, `c` turn counter-clockwise, negative when clockwise, 0 exactly when they lie on a line.
/// The magnitude is about twice the triangle's area. Exact unless products of coordinates under- or overflow.
pub fn orient2d(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    robust::orient2d(coord(a), coord(b), coord(c))
}

/// Positive when `d` lies below the plane of `a`, `b`, `c` (seen from below, they turn clockwise), negative above, 0 exactly
/// in the plane. The magnitude is about six times the tetrahedron's volume. Exact unless products of coordinates under- or
/// overflow.
pub fn orient3d(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> f64 {
    let coord = |p: DVec3| Coord3D { x: p.x, y: p.y, z: p.z };
    robust::orient3d(coord(a), coord(b), coord(c), coord(d))
}

/// True exactly when three points lie on one line: their shadows on the three coordinate planes do.
pub fn collinear(a: DVec3, b: DVec3, c: DVec3) -> bool {
    let shadow = |f: fn(DVec3) -> DVec2| orient2d(f(a), f(b), f(c)) == 0.0;
    shadow(|p| DVec2::new(p.x, p.y)) && shadow(|p| DVec2::new(p.y, p.z)) && shadow(|p| DVec2::new(p.z, p.x))
}

fn coord(p: DVec2) -> Coord<f64> {
    Coord { x: p.x, y: p.y }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_of_simple_cases() {
        assert!(orient2d(DVec2::ZERO, DVec2::X, DVec2::Y) > 0.0);
        assert!(orient2d(DVec2::ZERO, DVec2::Y, DVec2::X) < 0.0);
        assert!(orient3d(DVec3::ZERO, DVec3::X, DVec3::Y, -DVec3::Z) > 0.0);
        assert!(orient3d(DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z) < 0.0);
        assert_eq!(orient3d(DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(0.1, 0.7, 0.0)), 0.0);
    }

    #[test]
    fn one_unit_in_the_last_place_off_a_line_is_seen() {
        // In plain arithmetic these determinants round to 0.
        let (a, b) = (DVec2::splat(12.0), DVec2::splat(24.0));
        assert_eq!(orient2d(a, b, DVec2::splat(0.1)), 0.0);
        assert!(orient2d(a, b, DVec2::new(0.1, 0.1f64.next_up())) > 0.0);
        assert!(orient2d(a, b, DVec2::new(0.1f64.next_up(), 0.1)) < 0.0);
        assert!(collinear(DVec3::ZERO, DVec3::splat(12.0), DVec3::splat(0.1)));
        assert!(!collinear(DVec3::ZERO, DVec3::splat(12.0), DVec3::new(0.1, 0.1, 0.1f64.next_down())));
    }
}
