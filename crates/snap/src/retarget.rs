//! The domain on the network with the bends and creases that its vertices are assigned to.

use crate::SnapError;
use crate::assignment::{Assignment, FollowedPiece};
use crate::drag::drag;
use crate::minor::runs;
use mesh_core::{EdgeId, FaceId, IdVec, SurfacePoint, Topology, VertexId};
use region_map::{Arc, ArcKind, ArcSpan, Attachment, Domain, Network, RegionMap, SheetId, Surface};
use std::collections::BTreeMap;

/// The surface with all that is assigned in its network, and the domain on it.
pub(crate) fn retarget(assignment: &Assignment) -> Result<(Surface, Domain), SnapError> {
    let Assignment { surface, domain, .. } = *assignment;
    let network = finer_network(assignment)?;
    let mut region = with_moved_spans(assignment, &network);
    assignment.pieces().iter().for_each(|followed| add_piece(followed, assignment, &network, &mut region));
    attach(&network, assignment, &mut region);
    region.sheet_of_face = sheets(&domain.topology, &network, &region);
    place(assignment, &network, &mut region);
    region.check(&domain.topology, &network)?;
    Ok((surface.with_network(network)?, domain.placed(surface, region)?))
}

/// The region map of the domain with its spans on another network of the same surface. Those on arcs that this has not are left out; all else is as it was.
pub(crate) fn with_moved_spans(assignment: &Assignment, network: &Network) -> RegionMap {
    let Assignment { surface, domain, .. } = *assignment;
    let mut region = RegionMap { spans: BTreeMap::new(), ..domain.region.clone() };
    let places = places_on_arcs(surface.topology(), network);
    for (&[a, b], span) in assignment.spans() {
        let old = &surface.network().arcs[span.arc];
        if let Some(span) = moved_span(old, span, network, &places, surface.topology()) {
            region.insert_span(a, b, span);
        }
    }
    region
}

fn finer_network(assignment: &Assignment) -> Result<Network, SnapError> {
    let (topology, network) = (assignment.surface.topology(), assignment.surface.network());
    let mut kinds: IdVec<_, Option<ArcKind>> = network.arc_of_edge.iter().map(|arc| arc.map(|a| network.arcs[a].kind)).collect();
    for &e in assignment.pieces().iter().flat_map(|followed| &followed.piece.edges) {
        kinds[e] = Some(ArcKind::Sharp);
    }
    let is_corner = |v: VertexId| network.corner_of_vertex[v].is_some() || assignment.corners().contains_key(&v);
    let is_left = |v: &[VertexId]| topology.find_edge(v[0], v[1]).is_none_or(|e| kinds[e].is_none());
    let minor = network.minor.iter().flat_map(|chain| runs(chain, is_left)).collect();
    Ok(Network::trace(assignment.surface.mesh(), topology, &kinds, is_corner, minor)?)
}

/// For every edge on an arc which edge of the arc it is, from its beginning.
fn places_on_arcs(topology: &Topology, network: &Network) -> IdVec<EdgeId, Option<usize>> {
    let mut places = IdVec::filled(None, topology.n_edges());
    for arc in &network.arcs {
        for (i, &h) in arc.halfedges.iter().enumerate() {
            places[topology.edge(h)] = Some(i);
        }
    }
    places
}

/// A span of an arc on the arc of another network that its middle lies on.
fn moved_span(
    old: &Arc,
    span: &ArcSpan,
    network: &Network,
    places: &IdVec<EdgeId, Option<usize>>,
    topology: &Topology,
) -> Option<ArcSpan> {
    let middle = old.normalise(0.5 * (span.from + span.to));
    let (i, s) = old.segment(middle);
    let edge = topology.edge(old.halfedges[i]);
    let arc = network.arc_of_edge[edge]?;
    let (at, direction) = along(&network.arcs[arc], places[edge]?, old.vertices[i], s);
    let half = 0.5 * direction * (span.to - span.from);
    Some(ArcSpan { arc, from: at - half, to: at + half })
}

/// The arc length `s` (0 to 1) of the way from the end `start` along the `i`-th edge of an arc, and 1 when the arc runs the same
/// way, else -1.
fn along(arc: &Arc, i: usize, start: VertexId, s: f64) -> (f64, f64) {
    let forward = arc.vertices[i] == start;
    let s = if forward { s } else { 1.0 - s };
    let t = arc.lengths[i] + s * (arc.lengths[i + 1] - arc.lengths[i]);
    (t, if forward { 1.0 } else { -1.0 })
}

/// Spreads the vertices of a path over the arc of its piece, as they are spread over the path.
fn add_piece(FollowedPiece { piece, path }: &FollowedPiece, assignment: &Assignment, network: &Network, region: &mut RegionMap) {
    let Some(arc) = piece.edges.first().and_then(|&e| network.arc_of_edge[e]) else { return };
    let (length, forward) = (network.arcs[arc].length(), network.arcs[arc].vertices[0] == piece.vertices[0]);
    let mut steps = vec![0.0];
    for w in path.windows(2) {
        steps.push(steps[steps.len() - 1] + assignment.domain.mesh.distance(w[0], w[1]));
    }
    let total = steps[steps.len() - 1];
    let t = |step: f64| length * if forward { step / total } else { 1.0 - step / total };
    for (w, s) in path.windows(2).zip(steps.windows(2)) {
        region.insert_span(w[0], w[1], ArcSpan { arc, from: t(s[0]), to: t(s[1]) });
    }
}

/// Attaches all vertices that have spans, and those at corners.
pub(crate) fn attach(network: &Network, assignment: &Assignment, region: &mut RegionMap) {
    for (&[a, b], span) in &region.spans {
        for (v, t) in [(a, span.from), (b, span.to)] {
            region.attachments[v] = Attachment::Arc { arc: span.arc, t: network.arcs[span.arc].normalise(t) };
        }
    }
    for (v, attachment) in assignment.domain.region.attachments.enumerate() {
        if let Attachment::Corner(c) = *attachment
            && let Some(corner) = network.corner_of_vertex[assignment.surface.network().corners[c]]
        {
            region.attachments[v] = Attachment::Corner(corner);
        }
    }
    for (&w, &v) in assignment.corners() {
        if let Some(corner) = network.corner_of_vertex[w] {
            region.attachments[v] = Attachment::Corner(corner);
        }
    }
}

/// The sheet of every domain face: from the arcs around its part of the domain, or where there are none from a vertex' point.
pub(crate) fn sheets(topology: &Topology, network: &Network, region: &RegionMap) -> IdVec<FaceId, SheetId> {
    let on_arc = |e| {
        let [a, b] = topology.ends(e);
        region.span(a, b)
    };
    let (parts, n) = topology.regions(|e| on_arc(e).is_none());
    let mut sheet_of_part: Vec<Option<SheetId>> = vec![None; n];
    for e in topology.edge_ids() {
        let Some(span) = on_arc(e) else { continue };
        let [left, right] = network.arcs[span.arc].sheets;
        let sides = if span.from <= span.to { [left, right] } else { [right, left] };
        let (f, g) = topology.edge_faces(e);
        for (face, sheet) in [Some(f), g].into_iter().zip(sides) {
            if let Some(face) = face {
                sheet_of_part[parts[face] as usize] = sheet;
            }
        }
    }
    let of_point = |f: FaceId| network.sheet_of_face[region.points[topology.face(f)[0]].face];
    parts.enumerate().map(|(f, &part)| sheet_of_part[part as usize].unwrap_or_else(|| of_point(f))).collect()
}

/// Sets the points of all vertices: on arcs and at corners as attached, those around dragged along.
fn place(assignment: &Assignment, network: &Network, region: &mut RegionMap) {
    let (mesh, topology) = (assignment.surface.mesh(), assignment.surface.topology());
    for (v, attachment) in region.attachments.clone().enumerate() {
        match *attachment {
            Attachment::Arc { arc, t } => region.points[v] = network.arcs[arc].point(topology, t),
            Attachment::Corner(c) => {
                if let Some(h) = topology.fan(network.corners[c]).next() {
                    region.points[v] = SurfacePoint::at_corner(h.face(), h.corner());
                }
            }
            Attachment::Sheet(_) => {}
        }
    }
    drag(assignment, region);
    for v in region.vertices() {
        let Attachment::Sheet(_) = region.attachments[v] else { continue };
        let Some(sheet) = assignment.domain.topology.faces_at(v).next().map(|f| region.sheet_of_face[f]) else {
            continue;
        };
        region.attachments[v] = Attachment::Sheet(sheet);
        if network.sheet_of_face[region.points[v].face] != sheet {
            // Left on the other side of a closed crease.
            let position = region.points[v].position(mesh);
            if let Some(closest) = assignment.surface.index().closest_where(position, |f| network.sheet_of_face[f] == sheet) {
                region.points[v] = closest.point();
            }
        }
    }
}
