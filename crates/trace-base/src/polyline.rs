//! A part of an arc as a polyline.

use glam::DVec3;
use mesh_core::TriMesh;
use region_map::Arc;

/// Points of an arc with their arc lengths, rising. On a loop they may go beyond the length.
pub(crate) struct Polyline(Vec<(f64, DVec3)>);

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
        Self(points)
    }

    /// The arc length of the point nearest to `p`, and its distance.
    pub(crate) fn foot(&self, p: DVec3) -> (f64, f64) {
        let feet = self.0.windows(2).map(|w| {
            let [(s, a), (t, b)] = [w[0], w[1]];
            let x = mesh_core::closest_on_segment(p, a, b);
            (s + (t - s) * x, a.lerp(b, x).distance(p))
        });
        feet.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0.0, f64::INFINITY))
    }
}
