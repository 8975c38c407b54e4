//! Where the vertices of a domain are, and how they are displaced together.

use crate::energy::Measures;
use crate::freedom::{ArcNeighbour, Freedom};
use crate::movable_domain::{MovableDomain, each};
use crate::placed_vertex::PlacedVertex;
use glam::DVec3;
use mesh_core::{FaceId, IdVec, MeshError, VertexId};
use region_map::{ArcSpan, Attachment, Domain, RegionMap};

/// The share of the way to its neighbour on the arc that a vertex may slide at once. Less takes more steps; from a half on, two
/// neighbours that slide towards each other might lose their order.
const SLIDE_SHARE: f64 = 0.45;

/// The places of all vertices.
#[derive(Clone, Debug)]
pub(crate) struct Placement(pub(crate) IdVec<VertexId, PlacedVertex>);

impl std::ops::Index<VertexId> for Placement {
    type Output = PlacedVertex;
    fn index(&self, v: VertexId) -> &PlacedVertex {
        &self.0[v]
    }
}

impl Placement {
    /// Where the region map has the vertices.
    pub(crate) fn of_region(domain: &MovableDomain, region: &RegionMap) -> Self {
        let placed = |v: VertexId| match (domain.freedoms[v], region.attachments[v]) {
            (Freedom::Arc(on_arc), Attachment::Arc { t, .. }) => domain.placed_on_arc(&on_arc, t),
            _ => domain.placed_on_sheet(region.points[v]),
        };
        Self(IdVec::from_vec(each(domain.freedoms.len(), placed)))
    }

    /// All vertices displaced at once.
    pub(crate) fn displaced(&self, domain: &MovableDomain, displacement: impl Fn(VertexId) -> DVec3 + Sync) -> Self {
        Self(IdVec::from_vec(each(domain.freedoms.len(), |v| domain.displaced(self, v, displacement(v)))))
    }

    /// Puts one vertex elsewhere.
    pub(crate) fn move_to(&mut self, v: VertexId, placed: PlacedVertex) {
        self.0[v] = placed;
    }

    /// Corner positions of a face.
    pub(crate) fn triangle(&self, domain: &MovableDomain, f: FaceId) -> [DVec3; 3] {
        domain.topology.face(f).map(|v| self[v].position)
    }

    /// The reference normal of a face.
    pub(crate) fn reference_normal(&self, domain: &MovableDomain, f: FaceId) -> DVec3 {
        domain.reference_normal(f, |v| self[v].normals)
    }

    /// Area of a face, negative where it faces against the surface.
    pub(crate) fn signed_area(&self, domain: &MovableDomain, f: FaceId) -> f64 {
        mesh_core::vector_area(self.triangle(domain, f)).dot(self.reference_normal(domain, f))
    }

    /// What the energy of a face depends on.
    pub(crate) fn measures(&self, domain: &MovableDomain, f: FaceId) -> Measures {
        Measures::new(self.triangle(domain, f), self.reference_normal(domain, f))
    }

    /// The domain with its vertices at these places; `start` is the one that they began from.
    pub(crate) fn into_domain(self, movable: &MovableDomain, start: &Domain) -> Result<Domain, MeshError> {
        let mut region = start.region.clone();
        for (v, freedom) in movable.freedoms.enumerate() {
            let placed = &self[v];
            region.points[v] = placed.point;
            if let Freedom::Arc(on_arc) = freedom {
                let arc = &movable.surface.network().arcs[on_arc.arc];
                let wrapped = arc.normalise(placed.t);
                region.attachments[v] = Attachment::Arc { arc: on_arc.arc, t: wrapped };
                for end in [on_arc.behind, on_arc.ahead] {
                    let to = wrapped + (self.length_at(end) - placed.t);
                    region.insert_span(v, end.vertex, ArcSpan { arc: on_arc.arc, from: wrapped, to });
                }
            }
        }
        let positions = self.0.iter().map(|placed| placed.position).collect();
        Ok(Domain { mesh: start.mesh.with_positions(positions)?, topology: movable.topology.clone(), region })
    }

    /// The arc length of a neighbour on the arc.
    fn length_at(&self, end: ArcNeighbour) -> f64 {
        self[end.vertex].t + end.shift
    }
}

impl MovableDomain<'_> {
    /// The place of `v` after a displacement, as far as arcs and neighbours on them let it.
    pub(crate) fn displaced(&self, placement: &Placement, v: VertexId, displacement: DVec3) -> PlacedVertex {
        let placed = placement[v];
        if displacement == DVec3::ZERO {
            return placed;
        }
        match &self.freedoms[v] {
            Freedom::Fixed => placed,
            Freedom::Arc(on_arc) => {
                let [behind, ahead] = [on_arc.behind, on_arc.ahead].map(|end| placement.length_at(end) - placed.t);
                // Half of what a gap may still grow, as the neighbour may slide the other way.
                let slack = |gap: f64| 0.5 * (on_arc.longest_gap - gap.abs()).max(0.0);
                let room = |gap: f64| (SLIDE_SHARE * gap.abs()).min(0.5 * (gap.abs() - on_arc.shortest_gap)).max(0.0);
                let (back, forth) = (-room(behind).min(slack(ahead)), room(ahead).min(slack(behind)));
                let slide = displacement.dot(self.arc_direction(on_arc, placed.t));
                self.placed_on_arc(on_arc, placed.t + slide.clamp(back, forth))
            }
            Freedom::Sheet => self.walked(&placed, displacement),
        }
    }
}
