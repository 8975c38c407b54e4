//! Where the vertices of a domain are, and how they move: over their sheets by walking, along their arcs by sliding.

use crate::domain::{Domain, Freedom, Rail, RailEnd};
use glam::DVec3;
use mesh_core::{FaceId, HalfedgeId, IdVec, SurfacePoint, TriMesh, VertexId, walk};
use rayon::prelude::*;
use region_map::{Attachment, RegionMap};

/// The share of the way to its neighbour on the arc that a vertex may slide at once. Below a half, so that two neighbours that
/// slide towards each other keep their order.
const SLIDE_SHARE: f64 = 0.45;

/// The place of one vertex.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    pub(crate) point: SurfacePoint,
    /// Arc length on the arc, not wrapped around on a loop; 0 off the arcs.
    pub(crate) t: f64,
    pub(crate) position: DVec3,
    /// The surface's unit normals left and right of the arc; twice the same off the arcs.
    pub(crate) normals: [DVec3; 2],
}

/// The places of all vertices.
#[derive(Clone, Debug)]
pub(crate) struct Placement(pub(crate) IdVec<VertexId, Spot>);

impl std::ops::Index<VertexId> for Placement {
    type Output = Spot;
    fn index(&self, v: VertexId) -> &Spot {
        &self.0[v]
    }
}

impl Placement {
    /// Where the region map has the vertices.
    pub(crate) fn of_map(domain: &Domain, map: &RegionMap) -> Self {
        let spot = |v: VertexId| match (domain.freedoms[v], map.attachments[v]) {
            (Freedom::Rail(rail), Attachment::Arc { t, .. }) => domain.spot_on_arc(&rail, t),
            _ => domain.spot_on_sheet(map.points[v]),
        };
        let vertices = domain.freedoms.ids().collect::<Vec<_>>();
        Self(IdVec::from_vec(vertices.into_par_iter().map(spot).collect()))
    }

    /// All vertices displaced at once.
    pub(crate) fn displaced(&self, domain: &Domain, displacement: impl Fn(VertexId) -> DVec3 + Sync) -> Self {
        let vertices: Vec<VertexId> = domain.freedoms.ids().collect();
        Self(IdVec::from_vec(vertices.into_par_iter().map(|v| domain.displaced(self, v, displacement(v))).collect()))
    }

    /// Puts one vertex elsewhere.
    pub(crate) fn move_to(&mut self, v: VertexId, spot: Spot) {
        self.0[v] = spot;
    }

    /// Corner positions of a face.
    pub(crate) fn triangle(&self, domain: &Domain, f: FaceId) -> [DVec3; 3] {
        domain.topology.face(f).map(|v| self[v].position)
    }

    /// The reference normal of a face.
    pub(crate) fn reference_normal(&self, domain: &Domain, f: FaceId) -> DVec3 {
        domain.reference_normal(f, |v| self[v].normals)
    }

    /// Area of a face, negative where it faces against the surface.
    pub(crate) fn signed_area(&self, domain: &Domain, f: FaceId) -> f64 {
        mesh_core::vector_area(self.triangle(domain, f)).dot(self.reference_normal(domain, f))
    }

    /// Brings back the vertices of all faces for which `is_bad` holds here, then those of faces that this makes bad, until none
    /// is left. A face whose three vertices are back where they were in `before` must not be bad.
    pub(crate) fn take_back(&mut self, domain: &Domain, before: &Self, is_bad: impl Fn(&Self, FaceId) -> bool + Sync) {
        let mut suspects: Vec<FaceId> = domain.topology.faces().ids().collect();
        while !suspects.is_empty() {
            let bad: Vec<FaceId> = suspects.into_par_iter().filter(|&f| is_bad(self, f)).collect();
            let corners = bad.into_iter().flat_map(|f| domain.topology.face(f));
            let mut vertices: Vec<VertexId> = corners.collect();
            vertices.sort_unstable();
            vertices.dedup();
            for &v in &vertices {
                self.0[v] = before.0[v];
            }
            suspects = domain.fans(&vertices);
        }
    }

    /// Takes back what turned triangles over that faced with the surface in `before`.
    pub(crate) fn hold_upright(&mut self, domain: &Domain, before: &Self) {
        self.take_back(domain, before, |now, f| now.signed_area(domain, f) <= 0.0 && before.signed_area(domain, f) > 0.0);
    }

    /// The region map and the mesh of these places.
    pub(crate) fn into_domain(
        self,
        domain: &Domain,
        mesh: &TriMesh,
        map: &RegionMap,
    ) -> Result<(TriMesh, RegionMap), mesh_core::MeshError> {
        let mut map = map.clone();
        for (v, freedom) in domain.freedoms.enumerate() {
            let spot = &self[v];
            map.points[v] = spot.point;
            if let Freedom::Rail(rail) = freedom {
                let arc = &domain.surface.network.arcs[rail.arc];
                let wrapped = arc.normalise(spot.t);
                map.attachments[v] = Attachment::Arc { arc: rail.arc, t: wrapped };
                for end in [rail.behind, rail.ahead] {
                    let to = wrapped + (self.end_of_rail(end) - spot.t);
                    map.insert_span(v, end.vertex, region_map::ArcSpan { arc: rail.arc, from: wrapped, to });
                }
            }
        }
        let positions = self.0.iter().map(|spot| spot.position).collect();
        Ok((mesh.with_positions(positions)?, map))
    }

    /// The arc length of a neighbour on the rail.
    fn end_of_rail(&self, end: RailEnd) -> f64 {
        self[end.vertex].t + end.shift
    }
}

impl Domain<'_> {
    /// The faces around some vertices, in order.
    pub(crate) fn fans(&self, vertices: &[VertexId]) -> Vec<FaceId> {
        let mut faces: Vec<FaceId> = vertices.iter().flat_map(|&v| self.topology.fan(v).map(HalfedgeId::face)).collect();
        faces.sort_unstable();
        faces.dedup();
        faces
    }

    /// Unit direction of a rail at arc length `t`.
    pub(crate) fn rail_direction(&self, rail: &Rail, t: f64) -> DVec3 {
        let arc = &self.surface.network.arcs[rail.arc];
        let (i, _) = arc.segment(t);
        let [a, b] = [i, i + 1].map(|i| self.surface.mesh.position(arc.vertices[i]));
        (b - a).normalize_or_zero()
    }

    fn spot_on_sheet(&self, point: SurfacePoint) -> Spot {
        let normal = self.surface.normals.at(point);
        Spot { point, t: 0.0, position: point.position(self.surface.mesh), normals: [normal; 2] }
    }

    pub(crate) fn spot_on_arc(&self, rail: &Rail, t: f64) -> Spot {
        let arc = &self.surface.network.arcs[rail.arc];
        let point = arc.point(self.surface.topology, t);
        let (_, s) = arc.segment(t);
        let [left, right] = arc.sides(self.surface.topology, t);
        let normal = |h: Option<HalfedgeId>, s| h.map_or(DVec3::ZERO, |h| self.surface.normals.along(h, s));
        Spot { point, t, position: point.position(self.surface.mesh), normals: [normal(left, s), normal(right, 1.0 - s)] }
    }

    /// The place of `v` after a displacement, as far as arcs and neighbours on them let it.
    pub(crate) fn displaced(&self, placement: &Placement, v: VertexId, displacement: DVec3) -> Spot {
        let spot = placement[v];
        if displacement == DVec3::ZERO {
            return spot;
        }
        match &self.freedoms[v] {
            Freedom::Fixed => spot,
            Freedom::Rail(rail) => {
                let [behind, ahead] = [rail.behind, rail.ahead].map(|end| placement.end_of_rail(end) - spot.t);
                // Half of what a gap may still grow, as the neighbour may slide the other way.
                let slack = |gap: f64| 0.5 * (rail.longest_gap - gap.abs()).max(0.0);
                let room = |gap: f64| (SLIDE_SHARE * gap.abs()).min(0.5 * (gap.abs() - rail.shortest_gap)).max(0.0);
                let (back, forth) = (-room(behind).min(slack(ahead)), room(ahead).min(slack(behind)));
                let slide = displacement.dot(self.rail_direction(rail, spot.t));
                self.spot_on_arc(rail, spot.t + slide.clamp(back, forth))
            }
            Freedom::Sheet => self.walked(&spot, displacement),
        }
    }

    /// The place after a walk over its sheet.
    pub(crate) fn walked(&self, spot: &Spot, displacement: DVec3) -> Spot {
        let Self { surface, longest_move, .. } = self;
        let displacement = displacement.clamp_length_max(*longest_move);
        let may_cross = |e| !surface.network.is_barrier(e);
        self.spot_on_sheet(walk(surface.mesh, surface.topology, spot.point, displacement, may_cross).end)
    }
}
