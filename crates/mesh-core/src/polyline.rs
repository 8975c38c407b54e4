//! The nearest point of a chain of segments.

use crate::Bounds;
use crate::triangle::closest_on_segment;
use glam::DVec3;
use std::ops::Range;

/// Segments in a run.
const RUN: usize = 16;
/// A box may hold something nearer, though it seems farther away by this share of the distance: more than the rounding of both.
const ROUNDING: f64 = 1e-9;

/// A chain of segments, in boxes: the nearest point of a long one is found by looking at few of them.
#[derive(Clone, Debug)]
pub struct Polyline {
    points: Vec<(f64, DVec3)>,
    runs: Vec<Run>,
}

/// Some segments in a row, and the box round them: what is farther away than something found already need not be looked at.
#[derive(Clone, Debug)]
struct Run {
    segments: Range<usize>,
    bounds: Bounds,
}

/// A point of a polyline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foot {
    /// Where it is: what the ends of its segment have beside their positions, interpolated.
    pub t: f64,
    /// Its distance from the point that it is nearest to.
    pub distance: f64,
}

impl Polyline {
    /// The chain through some points, each with a number that tells where on the chain it is, such as its arc length.
    pub fn new(points: Vec<(f64, DVec3)>) -> Self {
        let n = points.len().saturating_sub(1);
        let run = |from: usize| {
            let segments = from..(from + RUN).min(n);
            let bounds = Bounds::of(points[segments.start..=segments.end].iter().map(|p| p.1))?;
            Some(Run { segments, bounds })
        };
        let runs = (0..n).step_by(RUN).filter_map(run).collect();
        Self { points, runs }
    }

    /// The point nearest to `p`, the first of several; `None` where that is not nearer than `below`.
    pub fn foot_below(&self, p: DVec3, below: f64) -> Option<Foot> {
        let mut best: Option<Foot> = None;
        for run in &self.runs {
            let limit = best.map_or(below, |b| b.distance);
            let to_box = (run.bounds.min - p).max(p - run.bounds.max).max(DVec3::ZERO).length();
            if to_box > limit * (1.0 + ROUNDING) {
                continue;
            }
            for i in run.segments.clone() {
                let [(s, a), (t, b)] = [self.points[i], self.points[i + 1]];
                let x = closest_on_segment(p, a, b);
                let foot = Foot { t: s + (t - s) * x, distance: a.lerp(b, x).distance(p) };
                if foot.distance < best.map_or(below, |b| b.distance) {
                    best = Some(foot);
                }
            }
        }
        best
    }

    /// The point nearest to `p`, the first of several; infinitely far without segments.
    pub fn foot(&self, p: DVec3) -> Foot {
        self.foot_below(p, f64::INFINITY).unwrap_or(Foot { t: 0.0, distance: f64::INFINITY })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = DVec3> {
        (-1.0..1.0, -1.0..1.0, -1.0..1.0).prop_map(|(x, y, z)| DVec3::new(x, y, z))
    }

    proptest! {
        /// The boxes leave out nothing that counts.
        #[test]
        fn the_foot_is_that_of_all_segments(points in prop::collection::vec(point(), 0..100), p in point()) {
            let points: Vec<(f64, DVec3)> = points.into_iter().enumerate().map(|(i, p)| (i as f64, p)).collect();
            let line = Polyline::new(points.clone());
            let feet = points.windows(2).map(|w| {
                let x = closest_on_segment(p, w[0].1, w[1].1);
                Foot { t: w[0].0 + (w[1].0 - w[0].0) * x, distance: w[0].1.lerp(w[1].1, x).distance(p) }
            });
            let Some(nearest) = feet.min_by(|a, b| a.distance.total_cmp(&b.distance)) else {
                prop_assert_eq!(line.foot(p).distance, f64::INFINITY);
                return Ok(());
            };
            prop_assert_eq!(line.foot(p), nearest);
            prop_assert_eq!(line.foot_below(p, nearest.distance), None);
            prop_assert_eq!(line.foot_below(p, nearest.distance * 1.1), Some(nearest));
        }
    }
}
