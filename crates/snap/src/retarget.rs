//! The domain on the network with the claimed features.

use crate::SnapError;
use crate::claims::{Claims, Track};
use crate::drag::drag;
use crate::minor::runs;
use mesh_core::{FaceId, HalfedgeId, IdVec, SurfacePoint, Topology, VertexId};
use region_map::{Arc, ArcKind, ArcSpan, Attachment, Domain, Network, RegionMap, SheetId, Surface};
use std::collections::BTreeMap;

/// The surface with all claims in its network, and the domain on it.
pub(crate) fn retarget(claims: &Claims) -> Result<(Surface, Domain), SnapError> {
    let topology = claims.surface.topology();
    let network = finer_network(claims)?;
    let mut map = RegionMap { spans: BTreeMap::new(), ..claims.domain.region.clone() };
    for (&[a, b], span) in &claims.spans {
        let old = &claims.surface.network().arcs[span.arc];
        if let Some(span) = moved_span(old, span, &network, topology) {
            map.insert_span(a, b, span);
        }
    }
    claims.tracks.iter().for_each(|track| add_track(track, claims, &network, &mut map));
    attach(&network, claims, &mut map);
    map.sheet_of_face = sheets(claims, &network, &map);
    place(claims, &network, &mut map);
    map.check(&claims.domain.topology, &network)?;
    Ok((claims.surface.with_network(network)?, claims.domain.placed(claims.surface, map)?))
}

fn finer_network(claims: &Claims) -> Result<Network, SnapError> {
    let (mesh, topology, network) = (claims.surface.mesh(), claims.surface.topology(), claims.surface.network());
    let mut kinds: IdVec<_, Option<ArcKind>> = network.arc_of_edge.iter().map(|arc| arc.map(|a| network.arcs[a].kind)).collect();
    for &e in claims.tracks.iter().flat_map(|track| &track.piece.edges) {
        kinds[e] = Some(ArcKind::Sharp);
    }
    let is_corner = |v: VertexId| network.corner_of_vertex[v].is_some() || claims.pins.contains_key(&v);
    let is_left = |v: &[VertexId]| topology.find_edge(v[0], v[1]).is_none_or(|e| kinds[e].is_none());
    let minor = network.minor.iter().flat_map(|chain| runs(chain, is_left)).collect();
    Ok(Network::trace(mesh, topology, &kinds, is_corner, minor)?)
}

/// A span of an arc on the arc of the finer network that its middle lies on.
fn moved_span(old: &Arc, span: &ArcSpan, network: &Network, topology: &Topology) -> Option<ArcSpan> {
    let middle = old.normalise(0.5 * (span.from + span.to));
    let (i, s) = old.segment(middle);
    let arc = network.arc_of_edge[topology.edge(old.halfedges[i])]?;
    let (at, direction) = along(&network.arcs[arc], [old.vertices[i], old.vertices[i + 1]], s)?;
    let half = 0.5 * direction * (span.to - span.from);
    Some(ArcSpan { arc, from: at - half, to: at + half })
}

/// The arc length `s` (0 to 1) of the way along an edge of an arc, and 1 when the arc runs the same way, else -1.
fn along(arc: &Arc, [a, b]: [VertexId; 2], s: f64) -> Option<(f64, f64)> {
    let i = arc.vertices.windows(2).position(|w| w == [a, b] || w == [b, a])?;
    let forward = arc.vertices[i] == a;
    let s = if forward { s } else { 1.0 - s };
    let t = arc.lengths[i] + s * (arc.lengths[i + 1] - arc.lengths[i]);
    Some((t, if forward { 1.0 } else { -1.0 }))
}

/// Spreads the vertices of a track over its arc, as they are spread over the path.
fn add_track(track: &Track, claims: &Claims, network: &Network, map: &mut RegionMap) {
    let Some(arc) = track.piece.edges.first().and_then(|&e| network.arc_of_edge[e]) else { return };
    let (length, forward) = (network.arcs[arc].length(), network.arcs[arc].vertices[0] == track.piece.vertices[0]);
    let mut steps = vec![0.0];
    for w in track.path.windows(2) {
        steps.push(steps[steps.len() - 1] + claims.domain.mesh.distance(w[0], w[1]));
    }
    let total = steps[steps.len() - 1];
    let t = |step: f64| length * if forward { step / total } else { 1.0 - step / total };
    for (w, s) in track.path.windows(2).zip(steps.windows(2)) {
        map.insert_span(w[0], w[1], ArcSpan { arc, from: t(s[0]), to: t(s[1]) });
    }
}

/// Attaches all vertices that have spans, and those at corners.
fn attach(network: &Network, claims: &Claims, map: &mut RegionMap) {
    for (&[a, b], span) in &map.spans {
        for (v, t) in [(a, span.from), (b, span.to)] {
            map.attachments[v] = Attachment::Arc { arc: span.arc, t: network.arcs[span.arc].normalise(t) };
        }
    }
    for (v, attachment) in claims.domain.region.attachments.enumerate() {
        if let Attachment::Corner(c) = *attachment
            && let Some(corner) = network.corner_of_vertex[claims.surface.network().corners[c]]
        {
            map.attachments[v] = Attachment::Corner(corner);
        }
    }
    for (&w, &v) in &claims.pins {
        if let Some(corner) = network.corner_of_vertex[w] {
            map.attachments[v] = Attachment::Corner(corner);
        }
    }
}

/// The sheet of every domain face: from the arcs around its part of the domain, or where there are none from a vertex' point.
fn sheets(claims: &Claims, network: &Network, map: &RegionMap) -> IdVec<FaceId, SheetId> {
    let topology = &claims.domain.topology;
    let on_arc = |e| {
        let [a, b] = topology.ends(e);
        map.span(a, b)
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
    let of_point = |f: FaceId| network.sheet_of_face[map.points[topology.face(f)[0]].face];
    parts.enumerate().map(|(f, &part)| sheet_of_part[part as usize].unwrap_or_else(|| of_point(f))).collect()
}

/// Sets the points of all vertices: on arcs and at corners as attached, those around dragged along.
fn place(claims: &Claims, network: &Network, map: &mut RegionMap) {
    let (mesh, topology) = (claims.surface.mesh(), claims.surface.topology());
    for (v, attachment) in map.attachments.clone().enumerate() {
        match *attachment {
            Attachment::Arc { arc, t } => map.points[v] = network.arcs[arc].point(topology, t),
            Attachment::Corner(c) => {
                if let Some(h) = topology.fan(network.corners[c]).next() {
                    map.points[v] = SurfacePoint::at_corner(h.face(), h.corner());
                }
            }
            Attachment::Sheet(_) => {}
        }
    }
    drag(claims, map);
    for v in map.vertices() {
        let Attachment::Sheet(_) = map.attachments[v] else { continue };
        let Some(sheet) = claims.domain.topology.fan(v).next().map(HalfedgeId::face).map(|f| map.sheet_of_face[f]) else {
            continue;
        };
        map.attachments[v] = Attachment::Sheet(sheet);
        if network.sheet_of_face[map.points[v].face] != sheet {
            // Left on the other side of a closed crease.
            let position = map.points[v].position(mesh);
            if let Some(closest) = claims.surface.index().closest_where(position, |f| network.sheet_of_face[f] == sheet) {
                map.points[v] = closest.point();
            }
        }
    }
}
