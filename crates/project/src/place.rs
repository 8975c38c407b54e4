//! Where the map puts a domain vertex.

use crate::ProjectError;
use mesh_core::{IdVec, SurfacePoint, TriMesh, VertexId};
use region_map::{BaseMesh, RegionMapError};

/// The map that places vertices: a base mesh, and every domain vertex as a point of a base face.
#[derive(Clone, Copy, Debug)]
pub struct Origins<'a> {
    /// The base mesh with its map.
    pub base: &'a BaseMesh,
    /// Points on the faces of the base mesh.
    pub points: &'a IdVec<VertexId, SurfacePoint>,
}

impl Origins<'_> {
    /// Checks that the map is of this working mesh, and that there is a point for each of `n_vertices`, on a face of the base
    /// mesh.
    pub(crate) fn check(&self, working: &TriMesh, n_vertices: usize) -> Result<(), ProjectError> {
        if !self.base.map.is_of(working) || !self.base.map_faces.iter().all(|&f| self.base.map.is_present(f)) {
            return Err(ProjectError::OtherMap);
        }
        let (found, expected) = (self.points.len(), n_vertices);
        if found != expected {
            return Err(RegionMapError::WrongSize { what: "origins", found, expected }.into());
        }
        match self.points.enumerate().find(|(_, p)| self.base.map_faces.get(p.face).is_none()) {
            Some((v, _)) => Err(RegionMapError::Misattached(v).into()),
            None => Ok(()),
        }
    }

    /// The point of the working mesh that the map gives a domain vertex.
    pub(crate) fn place(&self, v: VertexId) -> SurfacePoint {
        let p = self.points[v];
        self.base.locate(p.face, p.barycentric)
    }
}
