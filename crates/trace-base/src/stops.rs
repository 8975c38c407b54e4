//! Where base vertices cut an arc.

use crate::cut_mesh::CutMesh;
use mesh_core::VertexId;
use region_map::Arc;

/// A base vertex on an arc, and its arc length.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stop {
    pub(crate) vertex: VertexId,
    pub(crate) t: f64,
}

/// A stop this close to a vertex of its arc, as a share of the arc's edge, is cut there: pieces without area have no chart.
const AT_VERTEX: f64 = 1e-9;

/// Cuts an arc at stops and gives the vertices from each to the next, the ends included. The stops begin and end with the ends of the
/// arc, or on a loop with the same place.
pub(crate) fn cut_at_stops(cut: &mut CutMesh, arc: &Arc, chain: &[Stop]) -> Vec<Vec<u32>> {
    let length = arc.length();
    let Some(last) = chain.len().checked_sub(1) else { return Vec::new() };
    // Every stop in the first round: the edge that it is on, and how far along.
    let mut stops: Vec<(usize, f64, usize)> = Vec::new();
    let inner = if arc.is_loop() { 0..last } else { 1..last };
    for k in inner {
        let t = if arc.is_loop() { chain[k].t.rem_euclid(length) } else { chain[k].t };
        let (i, s) = arc.segment(t);
        // Rounding may have put a stop beside the vertex that it is at.
        stops.push(match s {
            s if s < AT_VERTEX => (i, 0.0, k),
            s if s > 1.0 - AT_VERTEX => ((i + 1) % (arc.vertices.len() - 1), 0.0, k),
            s => (i, s, k),
        });
    }
    stops.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut run: Vec<(u32, Option<usize>)> = Vec::new();
    let mut next = stops.into_iter().peekable();
    for i in 0..arc.vertices.len() - 1 {
        let [start, end] = [arc.vertices[i].0, arc.vertices[i + 1].0];
        let (mut from, mut done) = (start, 0.0);
        run.push((start, None));
        while let Some((_, s, k)) = next.next_if(|n| n.0 == i) {
            if s == 0.0 {
                run.last_mut().iter_mut().for_each(|r| r.1 = Some(k));
            } else if let Some(m) = cut.cut(from, end, (s - done) / (1.0 - done)) {
                run.push((m, Some(k)));
                (from, done) = (m, s);
            }
        }
    }
    if arc.is_loop() {
        let first = run.iter().position(|r| r.1 == Some(0)).unwrap_or(0);
        run.rotate_left(first);
        run.push((run[0].0, Some(last)));
    } else {
        run[0].1 = Some(0);
        run.push((arc.vertices[arc.vertices.len() - 1].0, Some(last)));
    }
    let mut paths: Vec<Vec<u32>> = Vec::new();
    for (v, stop) in run {
        paths.last_mut().iter_mut().for_each(|p| p.push(v));
        if stop.is_some() {
            paths.push(vec![v]);
        }
    }
    paths.pop();
    paths
}
