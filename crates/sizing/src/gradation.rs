//! Gradual change: the field grows along the surface by at most a given slope.

use mesh_core::{IdVec, VertexId};
use region_map::Surface;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Lowers values until no edge is steeper than `slope`, from the least value on (Dijkstra).
pub(crate) fn limit_gradient(surface: &Surface, values: &mut IdVec<VertexId, f64>, slope: f64) {
    // Values are positive: their bits order like the numbers.
    let mut queue: BinaryHeap<_> = values.enumerate().map(|(v, h)| Reverse((h.to_bits(), v))).collect();
    while let Some(Reverse((bits, v))) = queue.pop() {
        let h = f64::from_bits(bits);
        if h > values[v] {
            continue;
        }
        for w in surface.topology().one_ring(v) {
            let bound = h + slope * surface.mesh().distance(v, w);
            if bound < values[w] {
                values[w] = bound;
                queue.push(Reverse((bound.to_bits(), w)));
            }
        }
    }
}
