//! The base mesh with its ties to the working mesh.

use crate::{BaseMap, MapFaceId, RegionMap};
use glam::DVec3;
use mesh_core::{FaceId, IdVec, SurfacePoint, TriMesh};

/// How many base vertices there are, and why.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BaseCounts {
    /// What was asked for.
    pub asked: usize,
    /// The least that the topology and the kept network need.
    pub needed: usize,
    /// What there is.
    pub made: usize,
    /// Why more were made than asked for; empty where the request was met.
    pub reason: String,
}

/// A simplicial base mesh, where its vertices, edges and faces belong, and the bijection to the working mesh.
#[derive(Clone, Debug)]
pub struct BaseMesh {
    /// Vertices and faces; positions are those of `region.points`.
    pub mesh: TriMesh,
    /// Attachments and surface points.
    pub region: RegionMap,
    /// The map to the working mesh.
    pub map: BaseMap,
    /// The face of the map for every base face, with the same order of corners.
    pub map_faces: IdVec<FaceId, MapFaceId>,
    /// Asked, needed, made.
    pub counts: BaseCounts,
}

impl BaseMesh {
    /// The point of the working mesh at barycentric coordinates of a base face.
    pub fn locate(&self, face: FaceId, barycentric: DVec3) -> SurfacePoint {
        self.map.locate(self.map_faces[face], barycentric)
    }
}
