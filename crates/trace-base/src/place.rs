//! Where the base vertices are on the surface.

use crate::attach::Attached;
use crate::foreign::Foreign;
use mesh_core::{FaceId, IdVec, SurfaceIndex, SurfacePoint, Topology, TriMesh, VertexId};
use region_map::{ArcSpan, Attachment, RegionMap};
use std::collections::BTreeMap;

/// The region map of an attached base mesh: its vertices at corners, on arcs, and at the nearest points of their sheets that face
/// the same way.
pub(crate) fn region_map(mesh: &TriMesh, topology: &Topology, base: &Foreign, attached: &Attached) -> RegionMap {
    let network = &attached.network;
    let mut placed: IdVec<VertexId, Option<(Attachment, SurfacePoint)>> = IdVec::filled(None, base.mesh.n_vertices());
    let mut spans = BTreeMap::new();
    for (a, chain) in attached.chains.enumerate() {
        let arc = &network.arcs[a];
        for stop in chain {
            let t = arc.normalise(stop.t);
            placed[stop.vertex] = Some((Attachment::Arc { arc: a, t }, arc.point(topology, t)));
        }
        for pair in chain.windows(2) {
            let (lo, hi) = if pair[0].vertex < pair[1].vertex { (pair[0], pair[1]) } else { (pair[1], pair[0]) };
            spans.insert([lo.vertex, hi.vertex], ArcSpan { arc: a, from: lo.t, to: hi.t });
        }
    }
    for (c, &v) in attached.corners.enumerate() {
        if let Some(h) = topology.fan(network.corners[c]).next() {
            placed[v] = Some((Attachment::Corner(c), SurfacePoint::at_corner(h.face(), h.corner())));
        }
    }
    let mut faces_of_sheet = vec![Vec::new(); network.n_sheets];
    network.sheet_of_face.enumerate().for_each(|(f, s)| faces_of_sheet[s.0 as usize].push(f));
    let indices: Vec<SurfaceIndex> = faces_of_sheet.iter().map(|f| SurfaceIndex::of_faces(mesh, f.iter().copied())).collect();
    let normals = mesh.normals();
    let inside = |v: VertexId| {
        let sheet = base.topology.fan(v).next().map(|h| attached.sheet_of_face[h.face()]).unwrap_or(region_map::SheetId(0));
        let index = &indices[sheet.0 as usize];
        let (at, facing) = (base.position(v), facing(base, v));
        let closest = index.closest_where(at, |f| normals[f].dot(facing) > 0.0).or_else(|| index.closest(at));
        // A sheet has faces, so there is a closest point.
        let point = closest.map_or(SurfacePoint::at_corner(FaceId(0), 0), |c| c.point());
        (Attachment::Sheet(sheet), point)
    };
    let (attachments, points): (Vec<_>, Vec<_>) = placed.enumerate().map(|(v, &p)| p.unwrap_or_else(|| inside(v))).unzip();
    RegionMap {
        attachments: IdVec::from_vec(attachments),
        points: IdVec::from_vec(points),
        sheet_of_face: attached.sheet_of_face.clone(),
        spans,
    }
}

/// The way that the base mesh faces at a vertex.
fn facing(base: &Foreign, v: VertexId) -> glam::DVec3 {
    base.topology.fan(v).map(|h| mesh_core::vector_area(base.mesh.triangle(h.face()))).sum()
}
