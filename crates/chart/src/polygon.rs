//! The convex polygon that a patch is charted onto.
//!
//! Any strictly convex polygon gives an injective chart; one with the patch's own angles and side lengths gives one with little
//! distortion. On a circle, a right angle of the patch would be opened to nearly 180 degrees, and all triangles near it shrink
//! without bound.

use glam::DVec2;
use mesh_core::exact::orient2d;
use std::f64::consts::{PI, TAU};

/// Least turn at a corner, as a share of the mean turn: the polygon must stay strictly convex with room to spare.
const LEAST_TURN: f64 = 0.15;
/// Greatest turn at a corner: sharper ones than 36 degrees inside would crowd the chart there.
const GREATEST_TURN: f64 = 0.8 * PI;
/// Least length of a side, as a share of the mean one: shorter sides would make slivers in the chart.
const LEAST_SIDE: f64 = 0.1;
/// Least length of a side of a polygon on a circle, as a share of the mean one.
const LEAST_INSCRIBED: f64 = 0.25;
/// Where the patch's own angles don't give a polygon, they are mixed with those of a regular one: so much is the share of its own, in
/// the order in which they are tried.
const OWN_SHARES: [f64; 4] = [1.0, 0.75, 0.5, 0.25];
/// Closing the polygon may change a side by factors in this range.
const CLOSING: std::ops::Range<f64> = 0.3..4.0;
/// Least sine of the turn at a corner: less could be lost to rounding.
const LEAST_SINE: f64 = 1e-6;

/// A strictly convex polygon, counter-clockwise around the origin and of perimeter 2 pi, whose side `k` runs from corner `k` to the
/// next. `sides` are the lengths wanted, `turns` the exterior angles (negative where the patch is concave).
pub(crate) fn convex_polygon(sides: &[f64], turns: &[f64]) -> Vec<DVec2> {
    let n = sides.len();
    let mean = sides.iter().sum::<f64>() / n as f64;
    let sides: Vec<f64> = sides.iter().map(|s| s.max(LEAST_SIDE * mean) * TAU / (mean * n as f64)).collect();
    let even = TAU / n as f64;
    let own = convex_turns(turns);
    for share in OWN_SHARES {
        let blend: Vec<f64> = own.iter().map(|t| share * t + (1.0 - share) * even).collect();
        if let Some(polygon) = closed(&sides, &blend)
            && is_strictly_convex(&polygon)
        {
            return polygon;
        }
    }
    inscribed(&sides)
}

/// Positive turns of sum 2 pi that follow the patch's.
fn convex_turns(turns: &[f64]) -> Vec<f64> {
    let n = turns.len() as f64;
    let least = LEAST_TURN * TAU / n;
    let positive: Vec<f64> = turns.iter().map(|t| t.clamp(0.0, GREATEST_TURN)).collect();
    let sum: f64 = positive.iter().sum();
    if sum <= 0.0 {
        return vec![TAU / n; turns.len()];
    }
    positive.iter().map(|t| least + t * (TAU - n * least) / sum).collect()
}

/// Sides of the given directions, their lengths changed as little as closes the polygon; `None` when one would turn backwards.
fn closed(sides: &[f64], turns: &[f64]) -> Option<Vec<DVec2>> {
    let mut heading = 0.0;
    let directions: Vec<DVec2> = turns
        .iter()
        .map(|turn| {
            heading += turn;
            DVec2::from_angle(heading)
        })
        .collect();
    // Lengths s (1 + x . d) with the x for which the sides sum up to zero: the 2 x 2 system (sum s d d^T) x = -sum s d.
    let gap: DVec2 = sides.iter().zip(&directions).map(|(s, d)| *s * *d).sum();
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for (s, d) in sides.iter().zip(&directions) {
        (xx, xy, yy) = (xx + s * d.x * d.x, xy + s * d.x * d.y, yy + s * d.y * d.y);
    }
    let x = DVec2::new(xy * gap.y - yy * gap.x, xy * gap.x - xx * gap.y) / (xx * yy - xy * xy);
    let mut at = DVec2::ZERO;
    let mut corners = Vec::with_capacity(sides.len());
    for (s, d) in sides.iter().zip(&directions) {
        corners.push(at);
        let factor = 1.0 + x.dot(*d);
        if !CLOSING.contains(&factor) {
            return None;
        }
        at += s * factor * d;
    }
    let centre = corners.iter().sum::<DVec2>() / corners.len() as f64;
    Some(corners.into_iter().map(|c| c - centre).collect())
}

/// Corners on the unit circle at steps that follow the lengths.
fn inscribed(sides: &[f64]) -> Vec<DVec2> {
    let least = LEAST_INSCRIBED * TAU / sides.len() as f64;
    let sides: Vec<f64> = sides.iter().map(|s| s.max(least)).collect();
    let total: f64 = sides.iter().sum();
    let mut angle = 0.0;
    sides
        .iter()
        .map(|s| {
            let corner = DVec2::from_angle(angle);
            angle += TAU * s / total;
            corner
        })
        .collect()
}

/// Does every corner turn left by more than rounding?
fn is_strictly_convex(p: &[DVec2]) -> bool {
    let n = p.len();
    let turns = |i: usize| {
        orient2d(p[i], p[(i + 1) % n], p[(i + 2) % n])
            > LEAST_SINE * p[i].distance(p[(i + 1) % n]) * p[(i + 1) % n].distance(p[(i + 2) % n])
    };
    (0..n).all(turns)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_square_stays_one() {
        let quarter = PI / 2.0;
        let turns = [quarter, 0.0, quarter, 0.0, quarter, 0.0, quarter, 0.0];
        let p = convex_polygon(&[1.0; 8], &turns);
        let extent = p.iter().fold(DVec2::ZERO, |m, c| m.max(c.abs()));
        let diagonal = p[0].distance(p[4]);
        assert!((diagonal / p[2].distance(p[6]) - 1.0).abs() < 1e-9);
        // A circle would have 1 here, a square sqrt 2.
        assert!(diagonal / p[1].distance(p[5]) > 1.25, "{p:?} {extent}");
    }

    proptest! {
        #[test]
        fn always_strictly_convex(sides in prop::collection::vec(1e-3f64..1.0, 3..40), seed in prop::collection::vec(-3.0f64..3.0, 40)) {
            let polygon = convex_polygon(&sides, &seed[..sides.len()]);
            let n = polygon.len();
            for i in 0..n {
                prop_assert!(orient2d(polygon[i], polygon[(i + 1) % n], polygon[(i + 2) % n]) > 0.0);
            }
            // Strictly convex turns could still go round twice.
            let area: f64 = (0..n).map(|i| polygon[i].perp_dot(polygon[(i + 1) % n])).sum();
            prop_assert!(area < 2.0 * PI + 1e-9);
        }
    }
}
