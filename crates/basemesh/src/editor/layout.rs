//! Flat layouts of a few base faces, in which they are triangulated anew.
//!
//! A layout needs no more than to be flat, unfolded and the same before and after; how near it is to the shape in space decides
//! only the distortion. So every layout tries true lengths and angles first, and falls back to points on a circle, which cannot fail.

use glam::{DVec2, DVec3};
use mesh_core::exact::orient2d;
use region_map::flat_barycentric;
use std::f64::consts::{PI, TAU};

/// Two triangles `a b c` and `b a d` laid flat: places of `a`, `b`, `c`, `d` with the quadrilateral `a d b c` strictly convex.
pub(crate) fn quad([a, b, c, d]: [DVec3; 4]) -> [DVec2; 4] {
    let base = b - a;
    let length = base.length();
    let place = |p: DVec3, side: f64| {
        let along = (p - a).dot(base) / (length * length);
        DVec2::new(along, side * (p - a).cross(base).length() / (length * length))
    };
    let unfolded = [DVec2::ZERO, DVec2::X, place(c, 1.0), place(d, -1.0)];
    let [a, b, c, d] = unfolded;
    // Well inside: the new diagonal must pass the ends of the old one at a distance that later edits survive.
    let convex = (b - d).perp_dot(c - d) > 1e-3 && (c - d).perp_dot(a - d) > 1e-3 && c.y > 1e-3 && d.y < -1e-3;
    if convex { unfolded } else { [-DVec2::X, DVec2::X, DVec2::Y, -DVec2::Y] }
}

/// The one-ring of an inner vertex at the origin: places of its neighbours, counter-clockwise, by lengths and on a circle.
pub(crate) fn full_star(centre: DVec3, ring: &[DVec3]) -> [Vec<DVec2>; 2] {
    let angles = share_out(centre, ring, true, TAU);
    let mean = ring.iter().map(|r| r.distance(centre)).sum::<f64>() / ring.len() as f64;
    let place = |radius: fn(f64) -> f64| -> Vec<DVec2> {
        ring.iter().zip(&angles).map(|(r, &a)| radius(r.distance(centre) / mean) * DVec2::from_angle(a)).collect()
    };
    [place(|r| r.clamp(0.1, 10.0)), place(|_| 1.0)]
}

/// One side of a vertex on an arc: the vertex at the origin, the first of the ring `ahead` on the axis, the last one `behind` on
/// the other side, the rest above, by lengths and on a circle.
pub(crate) fn half_star(centre: DVec3, ring: &[DVec3], ahead: f64, behind: f64) -> [Vec<DVec2>; 2] {
    let angles = share_out(centre, ring, false, PI);
    let last = ring.len() - 1;
    let scale = 1.0 / (ahead + behind);
    let (first, end) = (DVec2::X * ahead * scale, -DVec2::X * behind * scale);
    let with_ends = |inner: &dyn Fn(usize) -> DVec2| -> Vec<DVec2> {
        (0..=last)
            .map(|i| {
                if i == 0 {
                    first
                } else if i == last {
                    end
                } else {
                    inner(i)
                }
            })
            .collect()
    };
    let lengths = with_ends(&|i| (ring[i].distance(centre) * scale).clamp(0.02, 50.0) * DVec2::from_angle(angles[i]));
    let middle = first.midpoint(end);
    [lengths, with_ends(&|i| middle + 0.5 * DVec2::from_angle(PI * i as f64 / last as f64))]
}

/// Directions of the ring around `centre`, their angles scaled to `total`. Even steps where an angle would be too flat to lay out.
fn share_out(centre: DVec3, ring: &[DVec3], closed: bool, total: f64) -> Vec<f64> {
    let n = ring.len();
    let gaps = if closed { n } else { n - 1 };
    let mut angles: Vec<f64> = (0..gaps).map(|i| (ring[i] - centre).angle_between(ring[(i + 1) % n] - centre)).collect();
    let sum: f64 = angles.iter().sum();
    let too_flat = |a: &f64| !(1e-3..0.9 * PI).contains(&(a * total / sum));
    if !sum.is_finite() || angles.iter().any(too_flat) {
        angles = vec![1.0; gaps];
    }
    let scale = total / angles.iter().sum::<f64>();
    let mut at = 0.0;
    (0..n)
        .map(|i| {
            let here = at;
            at += angles.get(i).map_or(0.0, |a| a * scale);
            here
        })
        .collect()
}

/// The flat triangle that holds a point, or comes nearest to: its place in the list, and the point's barycentric coordinates.
pub(crate) fn deepest<'t>(triangles: impl IntoIterator<Item = &'t [DVec2; 3]>, p: DVec2) -> Option<(usize, DVec3)> {
    let depths = triangles.into_iter().map(|t| flat_barycentric(t, p)).enumerate();
    depths.max_by(|a, b| a.1.min_element().total_cmp(&b.1.min_element()))
}

/// Twice the least area among flat triangles, relative to the square of `scale`: positive when none is folded.
pub(crate) fn are_unfolded(triangles: &[[DVec2; 3]]) -> bool {
    // Slivers in a layout would be slivers of the map for ever.
    triangles.iter().all(|[a, b, c]| orient2d(*a, *b, *c) > 1e-3 * longest([*a, *b, *c]))
}

fn longest([a, b, c]: [DVec2; 3]) -> f64 {
    a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a))
}
