//! Distances to a chain of segments.

use glam::DVec3;
use mesh_core::closest_on_segment;

/// So many segments share a box.
const BLOCK: usize = 16;
/// A box has to be farther than the nearest segment by this share of the coordinates, well above their rounding, to be passed
/// over.
const ROUNDING: f64 = 1e-12;

/// A chain of segments, in boxes.
pub(crate) struct Polyline {
    points: Vec<DVec3>,
    /// The corners of the box round each block of segments.
    boxes: Vec<[DVec3; 2]>,
}

impl Polyline {
    pub(crate) fn new(points: Vec<DVec3>) -> Self {
        let last = points.len().saturating_sub(1);
        let around = |start: usize| {
            let block = &points[start..=(start + BLOCK).min(last)];
            block.iter().fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[lo, hi], &p| [lo.min(p), hi.max(p)])
        };
        let boxes = (0..last).step_by(BLOCK).map(around).collect();
        Self { points, boxes }
    }

    /// The distance of a point from the nearest segment; infinite without segments.
    pub(crate) fn distance(&self, p: DVec3) -> f64 {
        let mut nearest = f64::INFINITY;
        for (i, &[lo, hi]) in self.boxes.iter().enumerate() {
            let rounding = ROUNDING * p.abs().max(lo.abs()).max(hi.abs()).max_element();
            if (lo - p).max(p - hi).max(DVec3::ZERO).length() > nearest + rounding {
                continue;
            }
            let block = &self.points[i * BLOCK..=((i + 1) * BLOCK).min(self.points.len() - 1)];
            nearest = block.windows(2).map(|ends| to_segment(p, ends[0], ends[1])).fold(nearest, f64::min);
        }
        nearest
    }
}

fn to_segment(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    p.distance(a.lerp(b, closest_on_segment(p, a, b)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = DVec3> {
        (-1.0..1.0, -1.0..1.0, -1.0..1.0).prop_map(|(x, y, z)| DVec3::new(x, y, z))
    }

    proptest! {
        #[test]
        fn no_segment_is_nearer(points in prop::collection::vec(point(), 0..100), p in point()) {
            let all = points.windows(2).map(|ends| to_segment(p, ends[0], ends[1])).fold(f64::INFINITY, f64::min);
            prop_assert_eq!(Polyline::new(points).distance(p).to_bits(), all.to_bits());
        }
    }
}
