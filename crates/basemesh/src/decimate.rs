//! The other way to a base mesh: the working mesh itself, coarsened in its map.

use crate::improve::improved;
use crate::{BaseError, BaseOptions};
use glam::{DVec2, DVec3};
use mesh_core::{FaceId, Id as _, IdVec};
use rayon::prelude::*;
use region_map::{BaseCounts, BaseMap, BaseMesh, Chart, ChartFace, ChartId, MapError, MapFaceId, RegionMap, Sizing, Surface};

/// Where the corners of a working face are in its chart. Its shape does not matter: the map is affine there.
const CORNERS: [DVec2; 3] = [DVec2::ZERO, DVec2::X, DVec2::Y];

/// Coarsens the working mesh to a base mesh (after Lee et al., *MAPS*, 1998), by the edits that improve any other.
pub fn decimate(surface: &Surface<'_>, sizing: &Sizing, options: &BaseOptions) -> Result<BaseMesh, BaseError> {
    let first = identity(surface).map_err(|e| BaseError::Internal(e.to_string()))?;
    improved(surface, first, sizing, options)
}

/// The working mesh as its own base mesh: a chart for every face.
fn identity(surface: &Surface<'_>) -> Result<BaseMesh, MapError> {
    let mesh = surface.mesh;
    let chart = |f: usize| {
        let barycentric = [DVec3::X, DVec3::Y, DVec3::Z];
        Chart::new(CORNERS.to_vec(), vec![ChartFace { vertices: [0, 1, 2], source: FaceId::new(f), barycentric }])
    };
    let n = mesh.n_faces();
    let charts = (0..n).into_par_iter().map(chart).collect::<Result<Vec<Chart>, MapError>>()?;
    let first: Vec<_> = (0..n).map(|f| (ChartId::new(f), CORNERS)).collect();
    Ok(BaseMesh {
        mesh: mesh.clone(),
        region: RegionMap::identity(surface.topology, surface.network),
        map: BaseMap::new(IdVec::from_vec(charts), &first),
        map_faces: (0..n).map(MapFaceId::new).collect(),
        counts: BaseCounts::default(),
    })
}
