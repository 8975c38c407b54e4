//! A domain on the proxy, brought to the surface that the proxy stands for.

use crate::{Proxy, ProxyError};
use mesh_core::{FaceId, IdVec, SurfacePoint, TriMesh, VertexId};
use rayon::prelude::*;
use region_map::{ArcId, ArcSpan, Attachment, Domain, RegionMap, SheetId, Surface};

/// A place along the normal is taken where it is not farther away than so many times the nearest point.
const FARTHER: f64 = 2.0;

impl Proxy {
    /// The same domain with its vertices on the dense surface: at its corners, on its arcs between the same of their vertices, in its sheets along the proxy's
    /// normals, or at the nearest point where these lead far away.
    ///
    /// Fails where the domain is not one on the proxy, or `dense` is not the surface that the proxy was made of.
    pub fn carried(&self, domain: &Domain, dense: &Surface) -> Result<Domain, ProxyError> {
        domain.check(self.surface.network())?;
        self.check_dense(dense)?;
        let map = &domain.region;
        let attachments: IdVec<VertexId, Attachment> = map.attachments.iter().map(|&a| self.attachment(a)).collect();
        let vertices: Vec<VertexId> = map.vertices().collect();
        let point = |&v: &VertexId| match attachments[v] {
            Attachment::Corner(c) => Ok(at_vertex(dense, dense.network().corners[c])),
            Attachment::Arc { arc, t } => Ok(dense.network().arcs[arc].point(dense.topology(), t)),
            Attachment::Sheet(sheet) => self.nearest(domain, v, dense, sheet),
        };
        let points: Vec<SurfacePoint> = vertices.par_iter().map(point).collect::<Result<_, _>>()?;
        let span = |(&ends, s): (&[VertexId; 2], &ArcSpan)| {
            (ends, ArcSpan { arc: s.arc, from: self.arc_length(s.arc, s.from), to: self.arc_length(s.arc, s.to) })
        };
        let spans = map.spans.iter().map(span).collect();
        let region = RegionMap { attachments, points: IdVec::from_vec(points), sheet_of_face: map.sheet_of_face.clone(), spans };
        Ok(domain.placed(dense, region)?)
    }

    fn check_dense(&self, dense: &Surface) -> Result<(), ProxyError> {
        let is_same = |here: &TriMesh, v: VertexId, there: VertexId| {
            dense.mesh().positions().get(there).is_some_and(|&p| p == here.position(v))
        };
        let n_arcs = (self.arc_lengths.len(), self.surface.network().n_sheets);
        let is_of = self.vertices.enumerate().all(|(v, &there)| is_same(self.surface.mesh(), v, there))
            && n_arcs == (dense.network().arcs.len(), dense.network().n_sheets);
        if is_of { Ok(()) } else { Err(ProxyError::NotOfSurface) }
    }

    fn attachment(&self, attachment: Attachment) -> Attachment {
        match attachment {
            Attachment::Arc { arc, t } => Attachment::Arc { arc, t: self.arc_length(arc, t) },
            other => other,
        }
    }

    /// The arc length on the dense surface of the place at arc length `t` here. On a loop both may be beyond the loop.
    fn arc_length(&self, id: ArcId, t: f64) -> f64 {
        let arc = &self.surface.network().arcs[id];
        let (length, there) = (arc.length(), &self.arc_lengths[id]);
        let rounds = if arc.is_loop() && length > 0.0 { (t / length).floor() } else { 0.0 };
        let (i, s) = arc.segment(t - rounds * length);
        let whole = there[there.len() - 1] - there[0];
        rounds * whole + there[i] + s * (there[i + 1] - there[i])
    }

    /// The place in a sheet of the dense surface of a vertex of the domain: among what was merged near it, however near other parts of the sheet lie in
    /// space. It faces as the proxy does there, if any near it does.
    fn nearest(&self, domain: &Domain, v: VertexId, dense: &Surface, sheet: SheetId) -> Result<SurfacePoint, ProxyError> {
        let point = domain.region.points[v];
        if self.surface.mesh().faces().get(point.face).is_none() {
            return Err(ProxyError::NoSuchFace(v));
        }
        let (position, normal) = (point.position(self.surface.mesh()), self.surface.normals().at(point));
        let index = dense.sheet_index(sheet).ok_or(ProxyError::NotOfSurface)?;
        let around = self.around(point.face);
        let is_near = |f: FaceId| dense.mesh().face(f).iter().any(|&v| around.binary_search(&self.stands_for[v]).is_ok());
        let faces_alike = |f: FaceId| dense.mesh().normal(f).dot(normal) > 0.0 && is_near(f);
        let closest = index.closest_where(position, faces_alike).or_else(|| index.closest_where(position, is_near));
        let closest = closest.or_else(|| index.closest(position)).ok_or(ProxyError::NotOfSurface)?;
        // Neighbours meet at a ridge where each goes to its nearest point; along the normals of the proxy they stay apart.
        let hits = index.first_hits_both_ways(position, normal).into_iter().flatten();
        let near = hits.filter(|hit| hit.t <= FARTHER * closest.distance && faces_alike(hit.face));
        Ok(near.min_by(|a, b| a.t.total_cmp(&b.t)).map_or(closest.point(), |hit| hit.point()))
    }

    /// The corners of a face of the proxy and their neighbours, in rising order.
    fn around(&self, face: FaceId) -> Vec<VertexId> {
        let topology = self.surface.topology();
        let faces = self.surface.mesh().face(face).into_iter().flat_map(|v| topology.faces_at(v));
        let mut around: Vec<VertexId> = faces.flat_map(|f| self.surface.mesh().face(f)).collect();
        around.sort_unstable();
        around.dedup();
        around
    }
}

/// A vertex as a point of one of its faces.
fn at_vertex(surface: &Surface, v: VertexId) -> SurfacePoint {
    // Every vertex of a surface has a face.
    let h = surface.topology().fan(v).next();
    h.map_or(SurfacePoint::at_corner(FaceId(0), 0), |h| SurfacePoint::at_corner(h.face(), h.corner()))
}
