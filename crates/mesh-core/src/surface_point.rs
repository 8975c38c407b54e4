//! A point on a mesh.

use crate::{FaceId, TriMesh, VertexId};
use glam::DVec3;

/// A point on a face: weights of its three corners, in their order. They are not negative and their sum is 1, to rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The face.
    pub face: FaceId,
    /// Barycentric coordinates in the face.
    pub barycentric: DVec3,
}

impl SurfacePoint {
    /// A point with its weights made not negative and of sum 1. Weights that are all 0, or whose sum is infinite,
    /// give the middle of the face.
    pub fn new(face: FaceId, barycentric: DVec3) -> Self {
        let clamped = barycentric.max(DVec3::ZERO);
        let sum = clamped.element_sum();
        let barycentric = if sum > 0.0 && sum.is_finite() { clamped / sum } else { DVec3::splat(1.0 / 3.0) };
        Self { face, barycentric }
    }
    /// The corner `corner` (0, 1, and 2 or more for the last one) of a face.
    pub fn at_corner(face: FaceId, corner: usize) -> Self {
        let barycentric = match corner {
            0 => DVec3::X,
            1 => DVec3::Y,
            _ => DVec3::Z,
        };
        Self { face, barycentric }
    }
    /// Position in space.
    pub fn position(&self, mesh: &TriMesh) -> DVec3 {
        self.interpolate(mesh.triangle(self.face))
    }
    /// The weighted mean of three values at the corners.
    pub fn interpolate(&self, [a, b, c]: [DVec3; 3]) -> DVec3 {
        self.barycentric.x * a + self.barycentric.y * b + self.barycentric.z * c
    }
    /// The vertex of the face with the greatest weight.
    pub fn nearest_vertex(&self, mesh: &TriMesh) -> VertexId {
        let w = self.barycentric;
        let corner = if w.x >= w.y && w.x >= w.z {
            0
        } else if w.y >= w.z {
            1
        } else {
            2
        };
        mesh.face(self.face)[corner]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_become_a_share_of_one_each() {
        let weights = |w: [f64; 3]| SurfacePoint::new(FaceId(0), w.into()).barycentric;
        assert_eq!(weights([2.0, -1.0, 6.0]), DVec3::new(0.25, 0.0, 0.75));
        for without_sum in [[0.0; 3], [-1.0; 3], [f64::NAN; 3], [f64::INFINITY, 1.0, 0.0], [f64::MAX; 3]] {
            assert_eq!(weights(without_sum), DVec3::splat(1.0 / 3.0), "{without_sum:?}");
        }
    }
}
