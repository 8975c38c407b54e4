//! The stage: charts, triangulations, one mesh, and then its connectivity improved.

use crate::BaseError;
use crate::arguments::{check_sites, check_wishes};
use crate::assemble::{FlatFace, Patchwork, make_simplicial};
use crate::chart::{PatchChart, chart};
use crate::improve::improved;
use crate::patch_cdt::triangulate;
use glam::DVec2;
use mesh_core::{FaceId, Id, IdVec, SurfacePoint, Topology, TriMesh, VertexId};
use rayon::prelude::*;
use region_map::{
    ArcSpan, Attachment, BaseMap, BaseMesh, CellArc, CellArcId, CellCornerId, Cells, Chart, ChartId, Domain, Network, PatchId,
    RegionMap, SheetId, Sites, Sizing, Surface,
};
use rustc_hash::FxHashSet;
use std::collections::BTreeMap;

/// How the base mesh is made.
#[derive(Clone, Debug, PartialEq)]
pub struct BaseOptions {
    /// Wanted number of vertices; the improvement removes and adds vertices to meet it. Default 200.
    pub base_vertices: usize,
    /// Rounds of improvement of the connectivity; 0 keeps the triangulation of the sites as it is. Default 10.
    pub rounds: usize,
    /// The share of a patch that its chart may shrink to less than a quarter of the mean scale, 0 to 1; patches beyond it are
    /// refused as uncharted. Default 0.05. Measured: convex patches stay below .01; beyond .05 the fine triangles that the map
    /// places begin to turn over (fandisk's stepped side .09, the rabbit's back with both ears .2).
    pub max_shrunk: f64,
}

impl Default for BaseOptions {
    fn default() -> Self {
        Self { base_vertices: 200, rounds: 10, max_shrunk: 0.05 }
    }
}

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
    let (mesh, topology, network) = (surface.mesh(), surface.topology(), surface.network());
    let vertices = Vertices::collect(topology, network, cells, sites)?;
    let flat: Vec<Option<(Chart, Vec<FlatFace>)>> = (0..cells.patches.len())
        .into_par_iter()
        .map(|p| triangulate_patch(mesh, cells, sites, &vertices, PatchId::new(p), options))
        .collect();
    let uncharted: Vec<PatchId> = (0..flat.len()).filter(|&p| flat[p].is_none()).map(PatchId::new).collect();
    if !uncharted.is_empty() {
        return Err(BaseError::Uncharted(uncharted));
    }
    let (charts, faces): (Vec<_>, Vec<_>) = flat.into_iter().flatten().unzip();
    let charts: IdVec<PatchId, Chart> = IdVec::from_vec(charts);
    let arc_edges: FxHashSet<[VertexId; 2]> =
        cells.arcs.ids().flat_map(|a| vertices.edges_along(cells, a)).map(|(ends, _)| ends).collect();
    let patchwork = make_simplicial(IdVec::from_vec(faces), &charts, &arc_edges, vertices.points.len());
    let first = join(mesh, network, cells, vertices, charts, patchwork)?;
    improved(surface, first, sizing, options)
}

/// The base vertices before any chord is split: cell corners, then arc sites, then patch sites.
struct Vertices {
    attachments: IdVec<VertexId, Attachment>,
    points: IdVec<VertexId, SurfacePoint>,
    /// For every arc its sites: arc length on the cell arc, base vertex.
    on_arcs: IdVec<CellArcId, Vec<(f64, VertexId)>>,
    /// The first site of every patch.
    in_patches: IdVec<PatchId, usize>,
}

impl Vertices {
    fn collect(topology: &Topology, network: &Network, cells: &Cells, sites: &Sites) -> Result<Self, BaseError> {
        let least = cells.least_segments();
        let short = cells.arcs.ids().find(|&a| sites.on_arcs[a].len() + 1 < least[a]);
        if let Some(arc) = short {
            return Err(BaseError::Internal(format!(
                "arc {arc} has {} sites, needs {}",
                sites.on_arcs[arc].len(),
                least[arc] - 1
            )));
        }
        let mut all = Self { attachments: IdVec::new(), points: IdVec::new(), on_arcs: IdVec::new(), in_patches: IdVec::new() };
        let places = places_of_corners(network, cells);
        for (c, &v) in cells.corners.enumerate() {
            let h = topology.fan(v).next().ok_or_else(|| BaseError::Internal(format!("corner at isolated vertex {v}")))?;
            let sheet = Attachment::Sheet(network.sheet_of_face[h.face()]);
            let corner = network.corner_of_vertex[v].map(Attachment::Corner);
            all.attachments.push(corner.or(places[c]).unwrap_or(sheet));
            all.points.push(SurfacePoint::at_corner(h.face(), h.corner()));
        }
        for (id, arc) in cells.arcs.enumerate() {
            let mut list = Vec::new();
            for &t in &sites.on_arcs[id] {
                let point = arc.point(topology, t);
                let on_network = arc.on.map(|span| on_network_arc(network, arc, span, t));
                all.points.push(point);
                list.push((t, all.attachments.push(on_network.unwrap_or(Attachment::Sheet(network.sheet_of_face[point.face])))));
            }
            all.on_arcs.push(list);
        }
        for list in &sites.in_patches {
            all.in_patches.push(all.points.len());
            for &point in list {
                all.points.push(point);
                all.attachments.push(Attachment::Sheet(network.sheet_of_face[point.face]));
            }
        }
        Ok(all)
    }

    fn corner(c: CellCornerId) -> VertexId {
        VertexId(c.0)
    }

    /// The base edges along an arc: ends in rising order, and the part of the network arc from the lower end to the higher.
    fn edges_along(&self, cells: &Cells, id: CellArcId) -> Vec<([VertexId; 2], Option<ArcSpan>)> {
        let arc = &cells.arcs[id];
        let mut stops = vec![(0.0, Self::corner(arc.corners[0]))];
        stops.extend(&self.on_arcs[id]);
        stops.push((arc.length(), Self::corner(arc.corners[1])));
        let place = |span: ArcSpan, t: f64| span.from + (span.to - span.from) * t / arc.length();
        stops
            .windows(2)
            .map(|w| {
                let [(s, a), (t, b)] = [w[0], w[1]];
                let (lo, hi) = if a < b { ((s, a), (t, b)) } else { ((t, b), (s, a)) };
                let span = arc.on.map(|on| ArcSpan { arc: on.arc, from: place(on, lo.0), to: place(on, hi.0) });
                ([lo.1, hi.1], span)
            })
            .collect()
    }
}

/// For cell corners that lie inside a network arc: where.
fn places_of_corners(network: &Network, cells: &Cells) -> IdVec<CellCornerId, Option<Attachment>> {
    let mut places = IdVec::filled(None, cells.corners.len());
    for arc in &cells.arcs {
        let Some(span) = arc.on else { continue };
        places[arc.corners[0]] = Some(on_network_arc(network, arc, span, 0.0));
        places[arc.corners[1]] = Some(on_network_arc(network, arc, span, arc.length()));
    }
    places
}

/// The attachment at arc length `t` of a cell arc that covers `span` of a network arc.
fn on_network_arc(network: &Network, arc: &CellArc, span: ArcSpan, t: f64) -> Attachment {
    let t = span.from + (span.to - span.from) * t / arc.length();
    Attachment::Arc { arc: span.arc, t: network.arcs[span.arc].normalise(t) }
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
    let PatchChart { chart, border } = chart(mesh, cells, p, &vertices.on_arcs, Vertices::corner, options.max_shrunk)?;
    let (mut ids, mut uv): (Vec<VertexId>, Vec<DVec2>) = border.iter().copied().unzip();
    let corners = uv.len();
    for (i, &site) in sites.in_patches[p].iter().enumerate() {
        let Some(at) = chart.find(site) else { continue };
        ids.push(VertexId::new(vertices.in_patches[p] + i));
        uv.push(at);
    }
    let triangles = triangulate(&uv, corners)?;
    let face = |t: [usize; 3]| FlatFace { vertices: t.map(|i| ids[i]), uv: t.map(|i| uv[i]) };
    Some((chart, triangles.into_iter().map(face).collect()))
}

/// One mesh, region map and base map of all patches.
fn join(
    mesh: &TriMesh,
    network: &Network,
    cells: &Cells,
    vertices: Vertices,
    charts: IdVec<PatchId, Chart>,
    patchwork: Patchwork,
) -> Result<BaseMesh, BaseError> {
    let mut spans = BTreeMap::new();
    for arc in cells.arcs.ids() {
        spans.extend(vertices.edges_along(cells, arc).into_iter().filter_map(|(ends, span)| Some((ends, span?))));
    }
    let Vertices { mut attachments, mut points, .. } = vertices;
    let sheet = |p: PatchId| -> SheetId { network.sheet_of_face[cells.patches[p].faces[0]] };
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
    let map = BaseMap::new(IdVec::from_vec(charts.into_vec()), &flat);
    let positions = points.iter().map(|p| p.position(mesh)).collect();
    let base = TriMesh::new(positions, faces).map_err(|e| BaseError::Internal(e.to_string()))?;
    let map_faces = (0..base.n_faces()).map(region_map::MapFaceId::new).collect();
    let region = RegionMap { attachments, points, sheet_of_face, spans };
    let domain = Domain::new(base, region).map_err(|e| BaseError::Internal(e.to_string()))?;
    Ok(BaseMesh { domain, map, map_faces })
}
