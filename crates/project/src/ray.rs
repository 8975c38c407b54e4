//! The paper's normal displacement (eq. 6), kept to the sheet: `v + n d` with the least `|d|`.

use glam::DVec3;
use mesh_core::{HalfedgeId, Id, IdVec, SurfaceIndex, SurfacePoint, Topology, TriMesh, VertexId};
use region_map::{RegionMap, SheetId, Surface};

/// One index a sheet.
pub(crate) struct SheetIndices(IdVec<SheetId, SurfaceIndex>);

impl SheetIndices {
    pub(crate) fn new(surface: &Surface<'_>) -> Self {
        let mut faces = IdVec::filled(Vec::new(), surface.network.n_sheets);
        for (f, &s) in surface.network.sheet_of_face.enumerate() {
            faces[s].push(f);
        }
        Self(faces.iter().map(|list: &Vec<_>| SurfaceIndex::of_faces(surface.mesh, list.clone())).collect())
    }

    /// The nearer hit of the sheet along both directions of the normal, if it faces the same way.
    pub(crate) fn displaced(&self, surface: &Surface<'_>, sheet: SheetId, from: DVec3, normal: DVec3) -> Option<SurfacePoint> {
        let hits = self.0.get(sheet)?.first_hits_both_ways(from, normal);
        let facing = hits.into_iter().flatten().filter(|h| surface.normals.at(h.point()).dot(normal) > 0.0);
        facing.min_by(|a, b| a.t.total_cmp(&b.t)).map(|h| h.point())
    }

    /// The point of the sheet nearest to a position.
    pub(crate) fn nearest(&self, sheet: SheetId, to: DVec3) -> Option<SurfacePoint> {
        self.0.get(sheet)?.closest(to).map(|c| c.point())
    }
}

/// Unit normals of the domain at its vertices, each from the faces of one sheet: the faces round a vertex inside a sheet all are.
pub(crate) fn domain_normals(domain: &TriMesh, topology: &Topology) -> IdVec<VertexId, DVec3> {
    let areas: Vec<DVec3> = domain.faces().ids().map(|f| mesh_core::vector_area(domain.triangle(f))).collect();
    let at = |v| topology.fan(v).map(|h: HalfedgeId| areas[h.face().index()]).sum::<DVec3>().normalize_or_zero();
    domain.positions().ids().map(at).collect()
}

/// Normals averaged over the one-ring, twice: those of a linearly subdivided mesh are constant on every base triangle, and the paper's
/// rays would leave a step at each base edge.
pub(crate) fn interpolated_normals(domain: &TriMesh, topology: &Topology, region: &RegionMap) -> IdVec<VertexId, DVec3> {
    let mut normals = domain_normals(domain, topology);
    for _ in 0..2 {
        let smooth = |v: VertexId| {
            let same_sheet =
                topology.fan(v).all(|h| region.sheet_of_face[h.face()] == region.sheet_of_face[first_face(topology, v)]);
            if !same_sheet {
                return normals[v];
            }
            (normals[v] + topology.one_ring(v).map(|w| normals[w]).sum::<DVec3>()).normalize_or_zero()
        };
        normals = domain.positions().ids().map(smooth).collect();
    }
    normals
}

fn first_face(topology: &Topology, v: VertexId) -> mesh_core::FaceId {
    topology.fan(v).next().map_or(mesh_core::FaceId(0), HalfedgeId::face)
}
