//! The other way to a base mesh: the working mesh itself, coarsened in its map.

use crate::editor::Editor;
use crate::improve::improve;
use crate::{BaseError, BaseOptions};
use glam::{DVec2, DVec3};
use mesh_core::{FaceId, IdVec};
use rayon::prelude::*;
use region_map::{BaseCounts, BaseMap, BaseMesh, Chart, ChartFace, ChartId, MapFaceId, RegionMap, Sizing, Surface};

/// Coarsens the working mesh to a base mesh.
pub fn decimate(surface: &Surface<'_>, sizing: &Sizing, options: &BaseOptions) -> Result<BaseMesh, BaseError> {
    let mut editor = Editor::new(surface, identity(surface)?)?;
    improve(&mut editor, sizing, options);
    let mut base = editor.finish()?;
    base.counts = BaseCounts { asked: options.base_vertices, needed: 0, made: base.mesh.n_vertices(), reason: String::new() };
    Ok(base)
}

/// The working mesh as its own base mesh: a chart for every face.
fn identity(surface: &Surface<'_>) -> Result<BaseMesh, BaseError> {
    let mesh = surface.mesh;
    let faces: Vec<FaceId> = mesh.faces().ids().collect();
    let charts: Result<Vec<(Chart, [DVec2; 3])>, _> = faces
        .into_par_iter()
        .map(|f| {
            let uv = [DVec2::ZERO, DVec2::X, DVec2::Y];
            let piece = ChartFace { vertices: [0, 1, 2], source: f, barycentric: [DVec3::X, DVec3::Y, DVec3::Z] };
            Chart::new(uv.to_vec(), vec![piece]).map(|chart| (chart, uv))
        })
        .collect();
    let (charts, layouts): (Vec<Chart>, Vec<[DVec2; 3]>) =
        charts.map_err(|e| BaseError::Internal(e.to_string()))?.into_iter().unzip();
    let first: Vec<(ChartId, [DVec2; 3])> = layouts.into_iter().enumerate().map(|(i, t)| (mesh_core::Id::new(i), t)).collect();
    let map = BaseMap::new(IdVec::from_vec(charts), &first);
    let map_faces = (0..mesh.n_faces()).map(<MapFaceId as mesh_core::Id>::new).collect();
    let region = RegionMap::identity(surface.topology, surface.network);
    Ok(BaseMesh { mesh: mesh.clone(), region, map, map_faces, counts: BaseCounts::default() })
}
