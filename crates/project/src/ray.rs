//! The paper's normal displacement (eq. 6), kept to the sheet: `v + n d` with the least `|d|`.

use glam::DVec3;
use mesh_core::{HalfedgeId, Id, IdVec, SurfacePoint, VertexId};
use region_map::{Attachment, Domain, SheetId, Surface};

/// A ray that hits farther away than this, in distances of the sheet, grazes it or has missed the part that it was meant for:
/// such hits are the spikes of the paper's Fig. 5.
const FARTHEST: f64 = 4.0;

/// Distances below this share of the diagonal are rounding: flat sheets are hit at such.
const ROUNDING: f64 = 1e-9;

/// The surface, ready to be asked by many threads at once.
#[derive(Clone, Copy)]
pub(crate) struct Rays<'a> {
    surface: &'a Surface,
    rounding: f64,
}

impl<'a> Rays<'a> {
    /// Builds the indices and normals of the surface where they are not there yet: no thread shall wait for another one to do it.
    pub(crate) fn new(surface: &'a Surface) -> Self {
        surface.normals();
        surface.sheet_index(SheetId(0));
        Self { surface, rounding: ROUNDING * surface.mesh().diagonal() }
    }

    /// The nearer hit of the sheet along both directions of the normal, if it faces the same way.
    pub(crate) fn displaced(&self, sheet: SheetId, from: DVec3, normal: DVec3) -> Option<SurfacePoint> {
        let hits = self.surface.sheet_index(sheet)?.first_hits_both_ways(from, normal);
        let facing = hits.into_iter().flatten().filter(|h| self.surface.normals().at(h.point()).dot(normal) > 0.0);
        facing.min_by(|a, b| a.t.total_cmp(&b.t)).map(|h| h.point())
    }

    /// Where a position goes without a map: to where its ray hits, or to the nearest point of the sheet where it misses or hits
    /// far away. The flag is true for a hit.
    pub(crate) fn place(&self, sheet: SheetId, from: DVec3, normal: DVec3) -> Option<(SurfacePoint, bool)> {
        let nearest = self.surface.sheet_index(sheet)?.closest(from)?;
        let hit = self.displaced(sheet, from, normal);
        let reach = FARTHEST * nearest.distance.max(self.rounding);
        let near = hit.filter(|h| h.position(self.surface.mesh()).distance(from) <= reach);
        Some(near.map_or((nearest.point(), false), |h| (h, true)))
    }
}

/// Unit normals of the domain at its vertices, by area.
fn domain_normals(Domain { mesh, topology, .. }: &Domain) -> IdVec<VertexId, DVec3> {
    let areas: Vec<DVec3> = mesh.faces().ids().map(|f| mesh_core::vector_area(mesh.triangle(f))).collect();
    let at = |v| topology.fan(v).map(|h: HalfedgeId| areas[h.face().index()]).sum::<DVec3>().normalize_or_zero();
    mesh.positions().ids().map(at).collect()
}

/// Rounds of averaging. Measured on rays alone (250 base vertices, 3 levels): flipped triangles after 0, 2, 4 and 8 rounds
/// 153, 19, 10, 0 on the kitten, 57, 5, 0, 0 on the rabbit, 16, 17, 16, 22 on fandisk.
const ROUNDS: usize = 4;

/// Normals averaged over the one-ring a few times: those of a linearly subdivided mesh are constant on every base triangle, and
/// the paper's rays would leave a step at each base edge. Vertices where sheets meet have the normal of neither and are left out.
pub(crate) fn interpolated_normals(domain: &Domain) -> IdVec<VertexId, DVec3> {
    let Domain { mesh, topology, region } = domain;
    let mut normals = domain_normals(domain);
    for _ in 0..ROUNDS {
        let smooth = |v: VertexId| {
            let inside = topology.one_ring(v).filter(|&w| matches!(region.attachments[w], Attachment::Sheet(_)));
            (normals[v] + inside.map(|w| normals[w]).sum::<DVec3>()).normalize_or_zero()
        };
        normals = mesh.positions().ids().map(smooth).collect();
    }
    normals
}
