//! [`TriMesh`], checked once at construction, and [`Soup`], what a file holds before any check.

use crate::limits::{MOST_FACES, MOST_VERTICES};
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

impl Soup {
    /// Copies plain arrays: the positions of the vertices, and for every triangle its vertices.
    pub fn from_slices(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Self {
        Self { positions: positions.iter().map(|&p| DVec3::from_array(p)).collect(), triangles: triangles.to_vec() }
    }
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
    /// Positions that shall replace others are not as many.
    #[error("{positions} positions for a mesh of {vertices} vertices; give one for each vertex")]
    PositionCount {
        /// Number of positions.
        positions: usize,
        /// Number of vertices.
        vertices: usize,
    },
    /// There are more vertices or faces than ids of 32 bits can tell apart.
    #[error(
        "{vertices} vertices and {faces} faces are more than a mesh can have ({MOST_VERTICES} and {MOST_FACES}); simplify it"
    )]
    TooLarge {
        /// Number of vertices.
        vertices: usize,
        /// Number of faces.
        faces: usize,
    },
}

/// Fails where ids of 32 bits are not enough.
fn check_size(vertices: usize, faces: usize) -> Result<(), MeshError> {
    if vertices > MOST_VERTICES || faces > MOST_FACES { Err(MeshError::TooLarge { vertices, faces }) } else { Ok(()) }
}

fn check_finite(positions: &[DVec3]) -> Result<(), MeshError> {
    positions.iter().position(|p| !p.is_finite()).map_or(Ok(()), |vertex| Err(MeshError::NotFinite { vertex }))
}

/// A triangle mesh: positions and faces whose indices are in range and distinct, all coordinates finite.
///
/// Manifoldness is not part of the promise: [`crate::Topology::new`] checks that. Like the index of a slice, an id that is asked for
/// must be one of the mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct TriMesh {
    positions: IdVec<VertexId, DVec3>,
    faces: IdVec<FaceId, [VertexId; 3]>,
}

impl TriMesh {
    /// Checks and takes positions and faces.
    pub fn new(positions: Vec<DVec3>, faces: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        check_size(positions.len(), faces.len())?;
        check_finite(&positions)?;
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

    /// Checks and copies plain arrays: the positions of the vertices, and for every face its vertices, counter-clockwise seen
    /// from outside. [`Self::position_arrays`] and [`Self::face_arrays`] give them back.
    pub fn from_slices(positions: &[[f64; 3]], faces: &[[u32; 3]]) -> Result<Self, MeshError> {
        Self::new(positions.iter().map(|&p| DVec3::from_array(p)).collect(), faces.to_vec())
    }

    /// The same faces with other positions.
    ///
    /// Fails on a coordinate that is not finite, and on another number of positions.
    pub fn with_positions(&self, positions: Vec<DVec3>) -> Result<Self, MeshError> {
        if positions.len() != self.n_vertices() {
            return Err(MeshError::PositionCount { positions: positions.len(), vertices: self.n_vertices() });
        }
        check_finite(&positions)?;
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
    /// The positions of all vertices as plain arrays.
    pub fn position_arrays(&self) -> Vec<[f64; 3]> {
        self.positions.iter().map(|p| p.to_array()).collect()
    }
    /// The vertices of all faces as plain arrays.
    pub fn face_arrays(&self) -> Vec<[u32; 3]> {
        self.faces.iter().map(|f| f.map(|v| v.0)).collect()
    }
    /// The mesh as a soup again, for writers.
    pub fn to_soup(&self) -> Soup {
        Soup { positions: self.positions.as_slice().to_vec(), triangles: self.face_arrays() }
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

    #[test]
    fn another_number_of_positions_is_refused() {
        let mesh = TriMesh::new(three_points(), vec![[0, 1, 2]]).unwrap();
        for n in [0, 2, 4] {
            let e = mesh.with_positions(vec![DVec3::ZERO; n]).unwrap_err();
            assert_eq!(e, MeshError::PositionCount { positions: n, vertices: 3 });
        }
        assert_eq!(mesh.with_positions(three_points()).unwrap(), mesh);
    }

    #[test]
    fn ids_of_32_bits_are_enough() {
        let (n, f) = (u32::MAX as usize, u32::MAX as usize / 3);
        assert_eq!(check_size(n, f), Ok(()));
        assert_eq!(check_size(n + 1, 0), Err(MeshError::TooLarge { vertices: n + 1, faces: 0 }));
        assert_eq!(check_size(0, f + 1), Err(MeshError::TooLarge { vertices: 0, faces: f + 1 }));
    }

    #[test]
    fn plain_arrays_come_back_as_they_were() {
        let (positions, faces) = ([[0.0, 0.0, -0.0], [1.0, 0.5, 0.0], [0.0, 1e-9, 7.0], [2.0; 3]], [[2, 0, 1], [3, 1, 0]]);
        let mesh = TriMesh::from_slices(&positions, &faces).unwrap();
        assert_eq!((mesh.position_arrays().as_slice(), mesh.face_arrays().as_slice()), (&positions[..], &faces[..]));
        assert_eq!(mesh.to_soup(), Soup::from_slices(&positions, &faces));
        assert!(TriMesh::from_slices(&positions, &[[0, 1, 4]]).is_err());
    }
}
