//! A part of an arc as a polyline.

use glam::DVec3;
use mesh_core::{Bounds, TriMesh, closest_on_segment};
use region_map::Arc;
use std::ops::Range;

/// Points of an arc with their arc lengths, rising. On a loop they may go beyond the length.
pub(crate) struct Polyline {
    points: Vec<(f64, DVec3)>,
    runs: Vec<Run>,
}

/// Some segments in a row, and the box round them: what is farther away than something found already need not be looked at.
struct Run {
    segments: Range<usize>,
    bounds: Bounds,
}

/// Segments in a run.
const RUN: usize = 16;
/// A box may hold something nearer, though it seems farther away by this share of the distance: more than the rounding of both.
const ROUNDING: f64 = 1e-9;

/// A point of a polyline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Foot {
    /// Its arc length.
    pub(crate) t: f64,
    /// Its distance from the point that it is nearest to.
    pub(crate) distance: f64,
}

impl Polyline {
    /// The part of an arc from `from` to `to`; on a loop it may go beyond the loop's start.
    pub(crate) fn of_arc(mesh: &TriMesh, arc: &Arc, from: f64, to: f64) -> Self {
        let rounds = if arc.is_loop() { 2 } else { 1 };
        let all = (0..rounds).flat_map(|k| {
            let offset = f64::from(k) * arc.length();
            arc.lengths.iter().zip(&arc.vertices).map(move |(t, &v)| (t + offset, mesh.position(v)))
        });
        let mut points = vec![(from, arc.position(mesh, from))];
        points.extend(all.filter(|&(t, _)| from < t && t < to));
        points.push((to, arc.position(mesh, to)));
        Self::new(points)
    }

    fn new(points: Vec<(f64, DVec3)>) -> Self {
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
    pub(crate) fn foot_below(&self, p: DVec3, below: f64) -> Option<Foot> {
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

    /// The point nearest to `p`, the first of several.
    pub(crate) fn foot(&self, p: DVec3) -> Foot {
        self.foot_below(p, f64::INFINITY).unwrap_or(Foot { t: 0.0, distance: f64::INFINITY })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The boxes leave out nothing that counts.
    #[test]
    fn the_foot_is_that_of_all_segments() {
        let at = |i: usize| {
            let s = i as f64 * 0.1;
            DVec3::new((3.0 * s).sin(), (2.0 * s).cos(), 0.2 * s)
        };
        let points: Vec<(f64, DVec3)> = (0..101).map(|i| (i as f64, at(i))).collect();
        let line = Polyline::new(points.clone());
        for k in 0..200 {
            let s = f64::from(k) * 0.7;
            let p = 2.0 * DVec3::new(s.sin(), (1.3 * s).cos(), (0.7 * s).sin());
            let feet = points.windows(2).map(|w| {
                let x = closest_on_segment(p, w[0].1, w[1].1);
                Foot { t: w[0].0 + (w[1].0 - w[0].0) * x, distance: w[0].1.lerp(w[1].1, x).distance(p) }
            });
            let nearest = feet.min_by(|a, b| a.distance.total_cmp(&b.distance)).unwrap();
            assert_eq!(line.foot(p), nearest);
            assert_eq!(line.foot_below(p, nearest.distance), None);
            assert_eq!(line.foot_below(p, nearest.distance * 1.1), Some(nearest));
        }
    }
}
