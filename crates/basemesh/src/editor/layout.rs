//! Flat layouts of a few base faces, in which they are triangulated anew.
//!
//! An edit lays the faces that it replaces into the plane, and its new faces into the same polygon: that is what the base map records.
//! Any layout without a fold will do; how near it is to the shape in space decides only how much the map distorts. So each layout tries
//! true lengths and angles first, and falls back to points on a circle, which cannot fold.

use glam::{DVec2, DVec3};
use mesh_core::exact::orient2d;
use region_map::flat_barycentric;
use std::f64::consts::{PI, TAU};

/// Corners of a quadrilateral that is to be flipped turn at least so much, and lie so far off its diagonal, both over the square of the
/// diagonal's length: later edits would lose a triangle that is thinner.
const LEAST_TURN: f64 = 1e-3;
/// Lengths of the edges of a star, over their mean: beyond these they are cut off, or a neighbour would make slivers of its triangles.
const STAR_LENGTHS: [f64; 2] = [0.1, 10.0];
/// The same for one side of an arc, over the length along the arc from the one neighbour there to the other.
const SIDE_LENGTHS: [f64; 2] = [0.02, 50.0];
/// An angle between two edges of a star that is smaller, or larger than [`GREATEST_ANGLE`], makes a sliver; then all angles are made equal.
const LEAST_ANGLE: f64 = 1e-3;
/// See [`LEAST_ANGLE`].
const GREATEST_ANGLE: f64 = 0.9 * PI;
/// Least area of a triangle in a layout, twice, over the square of its longest edge: a sliver in a layout is one of the map for ever.
const LEAST_AREA: f64 = 1e-3;

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
    let turns = [(b - d).perp_dot(c - d), (c - d).perp_dot(a - d), c.y, -d.y];
    let convex = turns.iter().all(|&turn| turn > LEAST_TURN);
    if convex { unfolded } else { [-DVec2::X, DVec2::X, DVec2::Y, -DVec2::Y] }
}

/// The one-ring of an inner vertex at the origin: places of its neighbours, counter-clockwise, by lengths and on a circle.
pub(crate) fn full_star(centre: DVec3, ring: &[DVec3]) -> [Vec<DVec2>; 2] {
    let angles = share_out(centre, ring, true, TAU);
    let mean = ring.iter().map(|r| r.distance(centre)).sum::<f64>() / ring.len() as f64;
    let place = |radius: fn(f64) -> f64| -> Vec<DVec2> {
        ring.iter().zip(&angles).map(|(r, &a)| radius(r.distance(centre) / mean) * DVec2::from_angle(a)).collect()
    };
    [place(|r| r.clamp(STAR_LENGTHS[0], STAR_LENGTHS[1])), place(|_| 1.0)]
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
    let lengths =
        with_ends(&|i| (ring[i].distance(centre) * scale).clamp(SIDE_LENGTHS[0], SIDE_LENGTHS[1]) * DVec2::from_angle(angles[i]));
    let middle = first.midpoint(end);
    [lengths, with_ends(&|i| middle + 0.5 * DVec2::from_angle(PI * i as f64 / last as f64))]
}

/// Directions of the ring around `centre`, their angles scaled to the sum `total`; all angles equal where one would make a sliver.
fn share_out(centre: DVec3, ring: &[DVec3], closed: bool, total: f64) -> Vec<f64> {
    let n = ring.len();
    let gaps = if closed { n } else { n - 1 };
    let mut angles: Vec<f64> = (0..gaps).map(|i| (ring[i] - centre).angle_between(ring[(i + 1) % n] - centre)).collect();
    let sum: f64 = angles.iter().sum();
    let too_flat = |a: &f64| !(LEAST_ANGLE..GREATEST_ANGLE).contains(&(a * total / sum));
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

/// True where no flat triangle is folded or a sliver.
pub(crate) fn are_unfolded(triangles: &[[DVec2; 3]]) -> bool {
    triangles.iter().all(|[a, b, c]| orient2d(*a, *b, *c) > LEAST_AREA * longest([*a, *b, *c]))
}

/// The square of the longest edge.
fn longest([a, b, c]: [DVec2; 3]) -> f64 {
    a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a))
}
