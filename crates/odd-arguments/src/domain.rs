//! Domains with something wrong.

use glam::DVec3;
use mesh_core::{FaceId, TriMesh, VertexId};
use region_map::{ArcId, ArcSpan, Attachment, CornerId, Domain, SheetId};

/// A domain with one thing wrong, chosen by `kind` from 0 to 9 (it comes back as it is for any other): an attachment, a point, a sheet, a
/// span, a table that is too long, an `other` mesh, or positions times `value`. `i` is the number that stands where it does not belong.
pub fn damaged(domain: &Domain, kind: u32, i: u32, value: f64, other: TriMesh) -> Domain {
    let mut wrong = domain.clone();
    let region = &mut wrong.region;
    let v = VertexId(i % domain.mesh.n_vertices() as u32);
    match kind {
        0 => region.attachments[v] = Attachment::Sheet(SheetId(i)),
        1 => region.attachments[v] = Attachment::Corner(CornerId(i)),
        2 => region.attachments[v] = Attachment::Arc { arc: ArcId(i), t: value },
        3 => region.points[v].face = FaceId(i),
        4 => region.points[v].barycentric = DVec3::splat(value),
        5 => region.sheet_of_face[FaceId(i % domain.mesh.n_faces() as u32)] = SheetId(i),
        6 => region.insert_span(v, VertexId(i), ArcSpan { arc: ArcId(i), from: value, to: -value }),
        7 => _ = region.points.push(region.points[v]),
        8 => wrong.mesh = other,
        9 => {
            let scaled = domain.mesh.positions().iter().map(|&p| value * p).collect();
            wrong.mesh = domain.mesh.with_positions(scaled).unwrap_or(wrong.mesh);
        }
        _ => {}
    }
    wrong
}
