//! Arc length in units of the sizing field.

use region_map::{CellArc, Sizing};

/// `integral ds / h` along an arc, relative to the edge length of the budget, up to stops that begin and end with the arc.
pub(crate) struct ArcMeasure {
    /// Arc length and measure, rising.
    stops: Vec<(f64, f64)>,
}

/// Where the field varies it is taken as constant over pieces of this share of an arc: an edge of a CAD file may be as long as its arc.
/// Smaller pieces follow the field more closely, and take more time and memory.
const PIECE: f64 = 1.0 / 64.0;

impl ArcMeasure {
    pub(crate) fn new(arc: &CellArc, sizing: &Sizing) -> Self {
        let mut stops = vec![(0.0, 0.0)];
        let mut measure = 0.0;
        for (ends, vertices) in arc.lengths.windows(2).zip(arc.vertices.windows(2)) {
            let length = ends[1] - ends[0];
            let [h0, h1] = [0, 1].map(|i| sizing.relative[vertices[i]]);
            // One piece where the ratio is 0, or not a number on an arc without length.
            let n = if h0 == h1 { 1 } else { (length / (PIECE * arc.length())).ceil().max(1.0) as usize };
            for i in 0..n {
                let middle = (i as f64 + 0.5) / n as f64;
                measure += length / n as f64 / (h0 + middle * (h1 - h0));
                let end = if i + 1 == n { ends[1] } else { ends[0] + length * (i + 1) as f64 / n as f64 };
                stops.push((end, measure));
            }
        }
        Self { stops }
    }

    /// The measure of the whole arc.
    pub(crate) fn total(&self) -> f64 {
        self.stops[self.stops.len() - 1].1
    }

    /// The arc lengths that cut the arc into `k` parts of equal measure.
    pub(crate) fn even_steps(&self, k: usize) -> Vec<f64> {
        let step = |i: usize| {
            let wanted = self.total() * i as f64 / k as f64;
            let end = self.stops.partition_point(|s| s.1 <= wanted).clamp(1, self.stops.len() - 1);
            let [(t0, m0), (t1, m1)] = [self.stops[end - 1], self.stops[end]];
            let share = if m1 > m0 { (wanted - m0) / (m1 - m0) } else { 0.5 };
            t0 + share * (t1 - t0)
        };
        (1..k).map(step).collect()
    }
}
