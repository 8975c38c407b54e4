//! The paper's normal displacement (eq. 6), kept to the sheet: `v + n d` with the least `|d|`.

use glam::DVec3;
use mesh_core::{HalfedgeId, Id, IdVec, SurfaceIndex, SurfacePoint, Topology, TriMesh, VertexId};
use region_map::{Attachment, RegionMap, SheetId, Surface};

/// A ray that hits farther away than this, in distances of the sheet, grazes it or has missed the part that it was meant for: such hits
/// are the spikes of the paper's Fig. 5.
const FARTHEST: f64 = 4.0;

/// Distances below this share of the diagonal are rounding: flat sheets are hit at such.
const ROUNDING: f64 = 1e-9;

/// One index a sheet.
pub(crate) struct SheetIndices {
    sheets: IdVec<SheetId, SurfaceIndex>,
    rounding: f64,
}

impl SheetIndices {
    pub(crate) fn new(surface: &Surface<'_>) -> Self {
        let mut faces = IdVec::filled(Vec::new(), surface.network.n_sheets);
        for (f, &s) in surface.network.sheet_of_face.enumerate() {
            faces[s].push(f);
        }
        let sheets = faces.iter().map(|list: &Vec<_>| SurfaceIndex::of_faces(surface.mesh, list.iter().copied())).collect();
        Self { sheets, rounding: ROUNDING * surface.mesh.diagonal() }
    }

    /// The nearer hit of the sheet along both directions of the normal, if it faces the same way.
    pub(crate) fn displaced(&self, surface: &Surface<'_>, sheet: SheetId, from: DVec3, normal: DVec3) -> Option<SurfacePoint> {
        let hits = self.sheets.get(sheet)?.first_hits_both_ways(from, normal);
        let facing = hits.into_iter().flatten().filter(|h| surface.normals.at(h.point()).dot(normal) > 0.0);
        facing.min_by(|a, b| a.t.total_cmp(&b.t)).map(|h| h.point())
    }

    /// Where a position goes without a map: to where its ray hits, or to the nearest point of the sheet where it misses or hits far
    /// away. The flag is true for a hit.
    pub(crate) fn place(
        &self,
        surface: &Surface<'_>,
        sheet: SheetId,
        from: DVec3,
        normal: DVec3,
    ) -> Option<(SurfacePoint, bool)> {
        let nearest = self.sheets.get(sheet)?.closest(from)?;
        let hit = self.displaced(surface, sheet, from, normal);
        let reach = FARTHEST * nearest.distance.max(self.rounding);
        let near = hit.filter(|h| h.position(surface.mesh).distance(from) <= reach);
        Some(near.map_or((nearest.point(), false), |h| (h, true)))
    }
}

/// Unit normals of the domain at its vertices, by area.
fn domain_normals(domain: &TriMesh, topology: &Topology) -> IdVec<VertexId, DVec3> {
    let areas: Vec<DVec3> = domain.faces().ids().map(|f| mesh_core::vector_area(domain.triangle(f))).collect();
    let at = |v| topology.fan(v).map(|h: HalfedgeId| areas[h.face().index()]).sum::<DVec3>().normalize_or_zero();
    domain.positions().ids().map(at).collect()
}

/// Rounds of averaging. Measured on rays alone (250 base vertices, 3 levels): flipped triangles after 0, 2, 4 and 8 rounds
/// 153, 19, 10, 0 on the kitten, 57, 5, 0, 0 on the rabbit, 16, 17, 16, 22 on fandisk.
const ROUNDS: usize = 4;

/// Normals averaged over the one-ring a few times: those of a linearly subdivided mesh are constant on every base triangle, and the
/// paper's rays would leave a step at each base edge. Vertices where sheets meet have the normal of neither and are left out.
pub(crate) fn interpolated_normals(domain: &TriMesh, topology: &Topology, region: &RegionMap) -> IdVec<VertexId, DVec3> {
    let mut normals = domain_normals(domain, topology);
    for _ in 0..ROUNDS {
        let smooth = |v: VertexId| {
            let inside = topology.one_ring(v).filter(|&w| matches!(region.attachments[w], Attachment::Sheet(_)));
            (normals[v] + inside.map(|w| normals[w]).sum::<DVec3>()).normalize_or_zero()
        };
        normals = domain.positions().ids().map(smooth).collect();
    }
    normals
}
