//! The base mesh with its ties to the working mesh.

use crate::{BaseMap, Domain, MapFaceId, RegionMapError, Surface};
use glam::DVec3;
use mesh_core::{FaceId, Id as _, IdVec, SurfacePoint, TriMesh};

/// Steps around the unit interval that spread any number of points evenly and independently (multiples of irrational numbers).
const STEPS: [f64; 3] = [0.754_877_666_246_692_8, 0.618_033_988_749_894_9, 0.245_122_333_753_307_1];

/// A simplicial base mesh, where its vertices, edges and faces belong, and the bijection to the working mesh.
#[derive(Clone, Debug)]
pub struct BaseMesh {
    /// The base mesh over the surface, its vertices at the points of its region map.
    pub domain: Domain,
    /// The map to the working mesh.
    pub map: BaseMap,
    /// The face of the map for every base face, with the same order of corners.
    pub map_faces: IdVec<FaceId, MapFaceId>,
}

/// Why something is not the base mesh of a surface.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BaseMeshError {
    /// Its domain does not fit the surface.
    #[error(transparent)]
    Region(#[from] RegionMapError),
    /// A part of it is of another mesh or surface.
    #[error("{0} is of another mesh or surface")]
    OtherSurface(&'static str),
}

impl BaseMesh {
    /// Checks that it is a base mesh of the surface, and that its map leads onto that.
    pub fn check(&self, surface: &Surface) -> Result<(), BaseMeshError> {
        self.domain.check(surface.network())?;
        if self.mesh().faces() != self.domain.topology.faces() {
            return Err(BaseMeshError::OtherSurface("the topology of the base mesh"));
        }
        let is_whole = self.map_faces.len() == self.mesh().n_faces() && self.map_faces.iter().all(|&f| self.map.is_present(f));
        if !is_whole || !self.map.is_of(surface.mesh()) {
            return Err(BaseMeshError::OtherSurface("the map of the base mesh"));
        }
        Ok(())
    }

    /// Vertices and faces.
    pub fn mesh(&self) -> &TriMesh {
        &self.domain.mesh
    }

    /// The point of the working mesh at barycentric coordinates of a base face.
    pub fn locate(&self, face: FaceId, barycentric: DVec3) -> SurfacePoint {
        self.map.locate(self.map_faces[face], barycentric)
    }

    /// The greatest distance between a point of the working mesh and where the map brings it by way of the base mesh, over the
    /// diagonal, of `n` points spread over the faces; 0 without points. Infinite when a point is not found in any base face.
    pub fn round_trip_error(&self, working: &TriMesh, n: usize) -> f64 {
        if working.n_faces() == 0 {
            return 0.0;
        }
        let mut present = self.map_faces.as_slice().to_vec();
        present.sort_unstable();
        let greatest = (0..n).map(|i| self.round_trip(working, &present, spread_point(working, i))).fold(0.0, f64::max);
        greatest / working.diagonal()
    }

    /// That distance for one point. `present` are the faces of the map that base faces have, in rising order.
    fn round_trip(&self, working: &TriMesh, present: &[MapFaceId], point: SurfacePoint) -> f64 {
        let Some((face, weights)) = self.map.find(point) else { return f64::INFINITY };
        if present.binary_search(&face).is_err() {
            return f64::INFINITY;
        }
        self.map.locate(face, weights).position(working).distance(point.position(working))
    }
}

/// A point in any face, however small the face is.
fn spread_point(mesh: &TriMesh, i: usize) -> SurfacePoint {
    let [face, s, t] = STEPS.map(|step| (0.5 + i as f64 * step).fract());
    // The square root makes points even in the triangle.
    let s = s.sqrt();
    let weights = DVec3::new(1.0 - s, s * (1.0 - t), s * t);
    let face = (face * mesh.n_faces() as f64) as usize;
    SurfacePoint::new(FaceId::new(face.min(mesh.n_faces() - 1)), weights)
}
