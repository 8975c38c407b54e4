//! Widths of the strips between facing arcs.

use glam::DVec3;
use mesh_core::{HalfedgeId, SurfacePoint, VertexId, walk};
use region_map::Surface;

/// Steps of a search across a strip.
const STEPS: usize = 16;

/// For arc vertices beside a strip narrower than `most`: its width, found by walking into the sheet at a right angle to the arc
/// until another arc stops the walk.
pub(crate) fn strip_widths(surface: &Surface<'_>, most: f64) -> Vec<(VertexId, f64)> {
    let mut widths = Vec::new();
    for arc in &surface.network.arcs {
        for (&h, ends) in arc.halfedges.iter().zip(arc.vertices.windows(2)) {
            for side in [Some(h), surface.topology.twin(h)].into_iter().flatten() {
                if let Some(width) = width_from(surface, side, most) {
                    widths.extend(ends.iter().map(|&v| (v, width)));
                }
            }
        }
    }
    widths
}

/// The width of the strip on the left of a halfedge on an arc, where it is below `most`.
fn width_from(surface: &Surface<'_>, h: HalfedgeId, most: f64) -> Option<f64> {
    let t = surface.mesh.triangle(h.face());
    let (a, b) = (t[h.corner()], t[(h.corner() + 1) % 3]);
    let mut direction = mesh_core::normal(t).cross(b - a).try_normalize()?;
    // A little inside, so that the walk does not start on the barrier that it leaves.
    let mut weights = DVec3::splat(0.01);
    weights[h.corner()] = 0.495;
    weights[(h.corner() + 1) % 3] = 0.495;
    let mut at = SurfacePoint::new(h.face(), weights);
    let start = at.position(surface.mesh);
    let mut last = start;
    let mut travelled = 0.0;
    for _ in 0..STEPS {
        let step = most / STEPS as f64;
        let walked = walk(surface.mesh, surface.topology, at, step * direction, |e| !surface.network.is_barrier(e));
        let position = walked.end.position(surface.mesh);
        travelled += position.distance(last);
        if walked.stopped {
            return Some(travelled.max(start.distance(position)));
        }
        (at, last, direction) = (walked.end, position, walked.direction);
    }
    None
}
