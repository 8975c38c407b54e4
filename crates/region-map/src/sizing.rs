//! The sizing field: how long base edges shall be at a place, relative to each other.

use mesh_core::{IdVec, SurfacePoint, TriMesh, VertexId};

/// A relative edge length at every working vertex, above 0; between vertices it is interpolated. Only ratios matter: the number of
/// base vertices sets the scale.
#[derive(Clone, Debug, PartialEq)]
pub struct Sizing {
    /// Relative edge length at every vertex.
    pub relative: IdVec<VertexId, f64>,
}

impl Sizing {
    /// The same edge length everywhere.
    pub fn uniform(mesh: &TriMesh) -> Self {
        Self { relative: IdVec::filled(1.0, mesh.n_vertices()) }
    }

    /// Relative edge length at a point.
    pub fn at(&self, mesh: &TriMesh, point: SurfacePoint) -> f64 {
        let [a, b, c] = mesh.face(point.face).map(|v| self.relative[v]);
        // In this form a field that is constant stays so to the last bit.
        a + point.barycentric.y * (b - a) + point.barycentric.z * (c - a)
    }
}
