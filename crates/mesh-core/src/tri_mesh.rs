//! [`TriMesh`], checked once at construction, and [`Soup`], what a file holds before any check.

use crate::{FaceId, IdVec, VertexId};
use glam::DVec3;

/// Triangles as they come from a file or another program: nothing is promised.
///
/// Indices may be out of range or repeated, coordinates may be infinite or not a number. [`crate::clean`] makes a mesh of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Soup {
    /// Vertex positions.
    pub positions: Vec<DVec3>,
    /// Triangles as indices into `positions`, which may be out of range.
    pub triangles: Vec<[u32; 3]>,
}

/// Why positions and faces are not a mesh.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// A face names a vertex that is not there.
    #[error("face {face} refers to vertex {vertex}, but there are only {vertices}; clean the mesh first")]
    IndexOutOfRange {
        /// The face.
        face: usize,
        /// The index that it holds.
        vertex: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// A face has the same vertex twice.
    #[error("face {face} uses vertex {vertex} twice; clean the mesh first")]
    RepeatedVertex {
        /// The face.
        face: usize,
        /// The vertex.
        vertex: u32,
    },
    /// A coordinate is infinite or not a number.
    #[error("vertex {vertex} has a coordinate that is not finite; clean the mesh first")]
    NotFinite {
        /// The vertex.
        vertex: usize,
    },
}

/// A triangle mesh: positions and faces whose indices are in range and distinct, all coordinates finite.
///
/// Manifoldness is not part of the promise: [`crate::Topology::new`] checks that.
#[derive(Clone, Debug, PartialEq)]
pub struct TriMesh {
    positions: IdVec<VertexId, DVec3>,
    faces: IdVec<FaceId, [VertexId; 3]>,
}

impl TriMesh {
    /// Checks and takes positions and faces.
    pub fn new(positions: Vec<DVec3>, faces: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        if let Some(vertex) = positions.iter().position(|p| !p.is_finite()) {
            return Err(MeshError::NotFinite { vertex });
        }
        for (face, f) in faces.iter().enumerate() {
            if let Some(&vertex) = f.iter().find(|&&v| v as usize >= positions.len()) {
                return Err(MeshError::IndexOutOfRange { face, vertex, vertices: positions.len() });
            }
            if let Some(c) = (0..3).find(|&c| f[c] == f[(c + 1) % 3]) {
                return Err(MeshError::RepeatedVertex { face, vertex: f[c] });
            }
        }
        let faces = faces.into_iter().map(|f| f.map(VertexId)).collect();
        Ok(Self { positions: IdVec::from_vec(positions), faces })
    }

    /// The same faces with other positions.
    ///
    /// Fails on a coordinate that is not finite. Panics when the number of positions differs.
    pub fn with_positions(&self, positions: Vec<DVec3>) -> Result<Self, MeshError> {
        assert_eq!(positions.len(), self.positions.len(), "as many positions as vertices");
        if let Some(vertex) = positions.iter().position(|p| !p.is_finite()) {
            return Err(MeshError::NotFinite { vertex });
        }
        Ok(Self { positions: IdVec::from_vec(positions), faces: self.faces.clone() })
    }

    /// Positions of all vertices.
    pub fn positions(&self) -> &IdVec<VertexId, DVec3> {
        &self.positions
    }
    /// Vertices of all faces, counter-clockwise seen from outside.
    pub fn faces(&self) -> &IdVec<FaceId, [VertexId; 3]> {
        &self.faces
    }
    /// Number of vertices.
    pub fn n_vertices(&self) -> usize {
        self.positions.len()
    }
    /// Number of faces.
    pub fn n_faces(&self) -> usize {
        self.faces.len()
    }
    /// Position of a vertex.
    pub fn position(&self, v: VertexId) -> DVec3 {
        self.positions[v]
    }
    /// Vertices of a face.
    pub fn face(&self, f: FaceId) -> [VertexId; 3] {
        self.faces[f]
    }
    /// Positions of the corners of a face.
    pub fn triangle(&self, f: FaceId) -> [DVec3; 3] {
        self.faces[f].map(|v| self.positions[v])
    }
    /// The mesh as a soup again, for writers.
    pub fn to_soup(&self) -> Soup {
        Soup { positions: self.positions.as_slice().to_vec(), triangles: self.faces.iter().map(|f| f.map(|v| v.0)).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn three_points() -> Vec<DVec3> {
        vec![DVec3::ZERO, DVec3::X, DVec3::Y]
    }

    #[test]
    fn a_bad_face_is_named() {
        let e = TriMesh::new(three_points(), vec![[0, 1, 2], [0, 1, 3]]).unwrap_err();
        assert_eq!(e, MeshError::IndexOutOfRange { face: 1, vertex: 3, vertices: 3 });
        let e = TriMesh::new(three_points(), vec![[0, 2, 0]]).unwrap_err();
        assert_eq!(e, MeshError::RepeatedVertex { face: 0, vertex: 0 });
    }

    #[test]
    fn a_position_that_is_not_finite_is_named() {
        let mut p = three_points();
        p[2].y = f64::NAN;
        assert_eq!(TriMesh::new(p, vec![]).unwrap_err(), MeshError::NotFinite { vertex: 2 });
    }
}
