//! Where the base vertices are on the surface.

use crate::attach::Attached;
use crate::foreign::Foreign;
use mesh_core::{IdVec, SurfacePoint, VertexId};
use region_map::{ArcSpan, Attachment, RegionMap, Surface};
use std::collections::BTreeMap;

/// The region map of an attached base mesh: its vertices at corners, on arcs, and at the nearest points of their sheets that face
/// the same way. `surface` has the network that it is attached to. Fails with a vertex that belongs to no sheet.
pub(crate) fn region_map(surface: &Surface, base: &Foreign, attached: &Attached) -> Result<RegionMap, VertexId> {
    let (mesh, topology, network) = (surface.mesh(), surface.topology(), surface.network());
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
    let normals = mesh.normals();
    let inside = |v: VertexId| {
        let sheet = attached.sheet_of_face[base.topology.fan(v).next()?.face()];
        let index = surface.sheet_index(sheet)?;
        let (at, facing) = (base.position(v), facing(base, v));
        let closest = index.closest_where(at, |f| normals[f].dot(facing) > 0.0).or_else(|| index.closest(at))?;
        Some((Attachment::Sheet(sheet), closest.point()))
    };
    let placed = placed.enumerate().map(|(v, &p)| p.or_else(|| inside(v)).ok_or(v)).collect::<Result<Vec<_>, _>>()?;
    let (attachments, points): (Vec<_>, Vec<_>) = placed.into_iter().unzip();
    Ok(RegionMap {
        attachments: IdVec::from_vec(attachments),
        points: IdVec::from_vec(points),
        sheet_of_face: attached.sheet_of_face.clone(),
        spans,
    })
}

/// The way that the base mesh faces at a vertex.
fn facing(base: &Foreign, v: VertexId) -> glam::DVec3 {
    base.topology.fan(v).map(|h| mesh_core::vector_area(base.mesh.triangle(h.face()))).sum()
}
