//! The paper's way to a base mesh: charts, triangulations, one mesh, and then its connectivity improved.

mod assemble;
mod patch_cdt;
mod vertices;

use crate::arguments::{check_sites, check_wishes};
use crate::improve::{improved, made_delaunay};
use crate::{BaseError, BaseOptions};
use assemble::{FlatFace, Patchwork, make_simplicial};
use chart::{PatchChart, chart_patch};
use glam::DVec2;
use mesh_core::{FaceId, Id, IdVec, TriMesh, VertexId};
use patch_cdt::triangulate;
use rayon::prelude::*;
use region_map::{
    Attachment, BaseMap, BaseMesh, Cells, Chart, ChartId, Domain, PatchId, RegionMap, SheetId, Sites, Sizing, Surface,
};
use rustc_hash::FxHashSet;
use std::collections::BTreeMap;
use vertices::{Vertices, edges_along};

/// Builds the base mesh of the sites: simplicial, manifold, of the topology of the mesh, every arc of the network on its edges.
///
/// Fails where patches cannot be laid flat, where an option is out of its range, and where the arguments are not of one surface.
pub fn build(
    surface: &Surface,
    cells: &Cells,
    sites: &Sites,
    sizing: &Sizing,
    options: &BaseOptions,
) -> Result<BaseMesh, BaseError> {
    check_wishes(surface, sizing, options)?;
    check_sites(surface, cells, sites)?;
    let vertices = Vertices::collect(surface, cells, sites)?;
    let flat: Vec<Option<(Chart, Vec<FlatFace>)>> = (0..cells.patches.len())
        .into_par_iter()
        .map(|p| triangulate_patch(surface.mesh(), cells, sites, &vertices, PatchId::new(p), options))
        .collect();
    let uncharted: Vec<PatchId> = (0..flat.len()).filter(|&p| flat[p].is_none()).map(PatchId::new).collect();
    if !uncharted.is_empty() {
        return Err(BaseError::Uncharted(uncharted));
    }
    let (charts, faces): (Vec<_>, Vec<_>) = flat.into_iter().flatten().unzip();
    let charts: IdVec<PatchId, Chart> = IdVec::from_vec(charts);
    let arc_edges: FxHashSet<[VertexId; 2]> =
        cells.arcs.ids().flat_map(|a| edges_along(cells, &vertices.border, a)).map(|e| e.ends).collect();
    let patchwork = make_simplicial(IdVec::from_vec(faces), &charts, &arc_edges, vertices.points.len());
    let first = join(surface, cells, vertices, charts, patchwork)?;
    if options.rounds == 0 {
        return made_delaunay(surface, first, &arc_edges);
    }
    improved(surface, first, sizing, options)
}

/// Charts one patch and triangulates its sites there; `None` where one of the two fails.
fn triangulate_patch(
    mesh: &TriMesh,
    cells: &Cells,
    sites: &Sites,
    vertices: &Vertices,
    p: PatchId,
    options: &BaseOptions,
) -> Option<(Chart, Vec<FlatFace>)> {
    let PatchChart { chart, polygon } = chart_patch(mesh, cells, p, &vertices.border, options.max_shrunk)?;
    let (mut ids, mut uv): (Vec<VertexId>, Vec<DVec2>) = polygon.iter().map(|c| (c.vertex, c.at)).unzip();
    let corners = uv.len();
    for (i, &site) in sites.in_patches[p].iter().enumerate() {
        let Some(at) = chart.find(site) else { continue };
        ids.push(VertexId::new(vertices.first_inside[p] + i));
        uv.push(at);
    }
    let triangles = triangulate(&uv, corners)?;
    let face = |t: [usize; 3]| FlatFace { vertices: t.map(|i| ids[i]), uv: t.map(|i| uv[i]) };
    Some((chart, triangles.into_iter().map(face).collect()))
}

/// One mesh, region map and base map of all patches.
fn join(
    surface: &Surface,
    cells: &Cells,
    vertices: Vertices,
    charts: IdVec<PatchId, Chart>,
    patchwork: Patchwork,
) -> Result<BaseMesh, BaseError> {
    let mut spans = BTreeMap::new();
    for arc in cells.arcs.ids() {
        spans.extend(edges_along(cells, &vertices.border, arc).into_iter().filter_map(|e| Some((e.ends, e.span?))));
    }
    let Vertices { mut attachments, mut points, .. } = vertices;
    let sheet = |p: PatchId| -> SheetId { surface.network().sheet_of_face[cells.patches[p].faces[0]] };
    for (p, point) in patchwork.added {
        attachments.push(Attachment::Sheet(sheet(p)));
        points.push(point);
    }
    let (mut faces, mut flat, mut sheet_of_face) = (Vec::new(), Vec::new(), IdVec::<FaceId, SheetId>::new());
    for (p, list) in patchwork.faces.enumerate() {
        for f in list {
            faces.push(f.vertices.map(|v| v.0));
            flat.push((ChartId::new(p.index()), f.uv));
            sheet_of_face.push(sheet(p));
        }
    }
    let map = BaseMap::new(IdVec::from_vec(charts.into_vec()), &flat).map_err(|e| BaseError::Internal(e.to_string()))?;
    let positions = points.iter().map(|p| p.position(surface.mesh())).collect();
    let base = TriMesh::new(positions, faces).map_err(|e| BaseError::Internal(e.to_string()))?;
    let map_faces = (0..base.n_faces()).map(region_map::MapFaceId::new).collect();
    let region = RegionMap { attachments, points, sheet_of_face, spans };
    let domain = Domain::new(base, region).map_err(|e| BaseError::Internal(e.to_string()))?;
    Ok(BaseMesh { domain, map, map_faces })
}
