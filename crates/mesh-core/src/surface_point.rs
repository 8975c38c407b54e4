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
    /// The weighted mean of three values at the corners. What the three have in common it has exactly, too: on a face at one height the points are at that
    /// height, without rounding.
    pub fn interpolate(&self, [a, b, c]: [DVec3; 3]) -> DVec3 {
        let w = self.barycentric;
        match self.nearest_corner() {
            0 => a + w.y * (b - a) + w.z * (c - a),
            1 => b + w.z * (c - b) + w.x * (a - b),
            _ => c + w.x * (a - c) + w.y * (b - c),
        }
    }
    /// The vertex of the face with the greatest weight.
    pub fn nearest_vertex(&self, mesh: &TriMesh) -> VertexId {
        mesh.face(self.face)[self.nearest_corner()]
    }
    fn nearest_corner(&self) -> usize {
        let w = self.barycentric;
        if w.x >= w.y && w.x >= w.z {
            0
        } else if w.y >= w.z {
            1
        } else {
            2
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where two solids touch in a face, their results would cut each other by rounding.
    #[test]
    fn what_the_corners_share_stays_exact() {
        let [height, corners] =
            [0.40005, 0.1].map(|z| [DVec3::new(0.1, 0.7, z), DVec3::new(-3.3, 0.2, z), DVec3::new(1.9, -0.6, z)]);
        for (i, j) in (0..=20).flat_map(|i| (0..=20 - i).map(move |j| (i, j))) {
            let [x, y] = [i, j].map(|n| f64::from(n) / 20.0);
            let point = SurfacePoint::new(FaceId(0), DVec3::new(x, y, 1.0 - x - y));
            assert_eq!((point.interpolate(height).z, point.interpolate(corners).z), (0.40005, 0.1));
        }
        for corner in 0..3 {
            assert_eq!(SurfacePoint::at_corner(FaceId(0), corner).interpolate(height), height[corner]);
        }
    }

    #[test]
    fn weights_become_a_share_of_one_each() {
        let weights = |w: [f64; 3]| SurfacePoint::new(FaceId(0), w.into()).barycentric;
        assert_eq!(weights([2.0, -1.0, 6.0]), DVec3::new(0.25, 0.0, 0.75));
        for without_sum in [[0.0; 3], [-1.0; 3], [f64::NAN; 3], [f64::INFINITY, 1.0, 0.0], [f64::MAX; 3]] {
            assert_eq!(weights(without_sum), DVec3::splat(1.0 / 3.0), "{without_sum:?}");
        }
    }
}
