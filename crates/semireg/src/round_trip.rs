//! How exact the map between base mesh and working mesh is.

use crate::BaseStages;
use glam::DVec3;
use mesh_core::{FaceId, Id as _, SurfacePoint};

/// Steps around the unit interval that spread any number of points evenly and independently (multiples of irrational numbers).
const STEPS: [f64; 3] = [0.754_877_666_246_692_8, 0.618_033_988_749_894_9, 0.245_122_333_753_307_1];

impl BaseStages {
    /// The greatest distance between a point of the working mesh and where the base map brings it by way of the base mesh, over
    /// the diagonal, of `n` points spread over the faces; 0 without points. Infinite when a point is not found in any base face.
    pub fn round_trip_error(&self, n: usize) -> f64 {
        (0..n).map(|i| self.round_trip(self.spread_point(i))).fold(0.0, f64::max)
    }

    /// A point in any face, however small the face is.
    fn spread_point(&self, i: usize) -> SurfacePoint {
        let n_faces = self.working.mesh.n_faces();
        let [face, s, t] = STEPS.map(|step| (0.5 + i as f64 * step).fract());
        // The square root makes points even in the triangle.
        let (s, t) = (s.sqrt(), t);
        let weights = DVec3::new(1.0 - s, s * (1.0 - t), s * t);
        SurfacePoint::new(FaceId::new(((face * n_faces as f64) as usize).min(n_faces - 1)), weights)
    }

    fn round_trip(&self, point: SurfacePoint) -> f64 {
        let (mesh, base) = (&self.working.mesh, &self.base);
        let Some((face, weights)) = base.map.find(point) else { return f64::INFINITY };
        if !base.map_faces.iter().any(|&f| f == face) {
            return f64::INFINITY;
        }
        base.map.locate(face, weights).position(mesh).distance(point.position(mesh)) / mesh.diagonal()
    }
}
