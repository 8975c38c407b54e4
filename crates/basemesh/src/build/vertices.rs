//! The base vertices that the sites make.

use crate::BaseError;
use chart::{ArcVertex, BorderVertices};
use mesh_core::{IdVec, SurfacePoint, VertexId};
use region_map::{ArcSpan, Attachment, CellArc, CellArcId, CellCornerId, Cells, Network, PatchId, Sites, Surface};

/// The base vertices before any chord is split: cell corners, then arc sites, then patch sites.
pub(super) struct Vertices {
    pub(super) attachments: IdVec<VertexId, Attachment>,
    pub(super) points: IdVec<VertexId, SurfacePoint>,
    /// Those on the borders of the patches.
    pub(super) border: BorderVertices,
    /// The number of the first site inside every patch.
    pub(super) first_inside: IdVec<PatchId, usize>,
}

impl Vertices {
    /// Fails where an arc has fewer sites than keep base edges apart.
    pub(super) fn collect(surface: &Surface, cells: &Cells, sites: &Sites) -> Result<Self, BaseError> {
        let (topology, network) = (surface.topology(), surface.network());
        let least = cells.least_segments();
        let short = cells.arcs.ids().find(|&a| sites.on_arcs[a].len() + 1 < least[a]);
        if let Some(arc) = short {
            return Err(BaseError::Internal(format!(
                "arc {arc} has {} sites, needs {}",
                sites.on_arcs[arc].len(),
                least[arc] - 1
            )));
        }
        let at_corners = cells.corners.ids().map(|c| VertexId(c.0)).collect();
        let border = BorderVertices { at_corners, on_arcs: IdVec::new() };
        let mut all = Self { attachments: IdVec::new(), points: IdVec::new(), border, first_inside: IdVec::new() };
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
                let sheet = Attachment::Sheet(network.sheet_of_face[point.face]);
                list.push(ArcVertex { t, vertex: all.attachments.push(on_network.unwrap_or(sheet)) });
            }
            all.border.on_arcs.push(list);
        }
        for list in &sites.in_patches {
            all.first_inside.push(all.points.len());
            for &point in list {
                all.points.push(point);
                all.attachments.push(Attachment::Sheet(network.sheet_of_face[point.face]));
            }
        }
        Ok(all)
    }
}

/// A base edge along an arc of the cells.
pub(super) struct ArcEdge {
    /// Its ends, rising.
    pub(super) ends: [VertexId; 2],
    /// The part of the network arc from the lower end to the higher; `None` on a smooth arc.
    pub(super) span: Option<ArcSpan>,
}

/// The base edges along an arc.
pub(super) fn edges_along(cells: &Cells, border: &BorderVertices, id: CellArcId) -> Vec<ArcEdge> {
    let arc = &cells.arcs[id];
    let end = |i: usize, t: f64| ArcVertex { t, vertex: border.at_corners[arc.corners[i]] };
    let mut stops = vec![end(0, 0.0)];
    stops.extend(&border.on_arcs[id]);
    stops.push(end(1, arc.length()));
    let place = |span: ArcSpan, t: f64| span.from + (span.to - span.from) * t / arc.length();
    let edge = |pair: &[ArcVertex]| {
        let (lo, hi) = if pair[0].vertex < pair[1].vertex { (pair[0], pair[1]) } else { (pair[1], pair[0]) };
        let span = arc.on.map(|on| ArcSpan { arc: on.arc, from: place(on, lo.t), to: place(on, hi.t) });
        ArcEdge { ends: [lo.vertex, hi.vertex], span }
    };
    stops.windows(2).map(edge).collect()
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
