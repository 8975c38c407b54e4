//! Where the vertices are: each over a point of the surface, at a height.

use crate::system::Freedom;
use glam::DVec3;
use mesh_core::{FaceId, HalfedgeId, Id, IdVec, MeshError, SurfacePoint, Topology, TriMesh, VertexId, walk};
use rayon::prelude::*;
use region_map::{Attachment, Domain, Surface};

/// How far a vertex may slide over the surface in one round, as a share of the mean length of its edges.
const SLIDE: f64 = 0.2;
/// How often a vertex at a bad spot goes half of the way back before it goes all of it.
pub(crate) const HALVINGS: usize = 4;

/// The place of one vertex.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    pub(crate) point: SurfacePoint,
    pub(crate) foot: DVec3,
    /// The surface's unit normal; zero for a vertex that stays.
    pub(crate) normal: DVec3,
    pub(crate) height: f64,
}

impl Spot {
    pub(crate) fn position(&self) -> DVec3 {
        self.foot + self.height * self.normal
    }
}

/// The places of all vertices.
#[derive(Clone, Debug)]
pub(crate) struct Placement(pub(crate) IdVec<VertexId, Spot>);

impl Placement {
    /// On the surface; only vertices inside sheets have a normal.
    pub(crate) fn new(surface: &Surface, Domain { mesh, region, .. }: &Domain) -> Self {
        let spot = |v: VertexId| {
            let point = region.points[v];
            let normal = match region.attachments[v] {
                Attachment::Sheet(_) => surface.normals().at(point),
                _ => DVec3::ZERO,
            };
            Spot { point, foot: mesh.position(v), normal, height: 0.0 }
        };
        Self(region.vertices().map(spot).collect())
    }

    /// Displaced: along the surface by walking inside the sheet, where `slides` says so, and by heights within their limits.
    pub(crate) fn displaced(
        &self,
        surface: &Surface,
        displacements: &IdVec<VertexId, DVec3>,
        edges: &IdVec<VertexId, f64>,
        slide: f64,
        reach: f64,
    ) -> Self {
        let may_cross = |e| !surface.network().is_barrier(e);
        let spot = |i: usize| {
            let v = VertexId::new(i);
            let (mut spot, displacement) = (self.0[v], displacements[v]);
            if spot.normal == DVec3::ZERO {
                return spot;
            }
            let rise = displacement.dot(spot.normal);
            spot.height = (spot.height + rise).clamp(-reach * edges[v], reach * edges[v]);
            let along = slide * (displacement - rise * spot.normal).clamp_length_max(SLIDE * edges[v]);
            if along != DVec3::ZERO {
                let point = walk(surface.mesh(), surface.topology(), spot.point, along, may_cross).end;
                let normal = surface.normals().at(point);
                if normal != DVec3::ZERO {
                    spot = Spot { point, foot: point.position(surface.mesh()), normal, ..spot };
                }
            }
            spot
        };
        Self(IdVec::from_vec((0..self.0.len()).into_par_iter().map(spot).collect()))
    }

    /// What the vertices are free to do when they may slide, or only rise.
    pub(crate) fn freedoms(&self, slides: bool) -> IdVec<VertexId, Freedom> {
        let freedom = |spot: &Spot| match spot.normal {
            DVec3::ZERO => Freedom::Fixed,
            _ if slides => Freedom::Free,
            normal => Freedom::Along(normal),
        };
        self.0.iter().map(freedom).collect()
    }

    /// Takes the vertices of some faces back towards where they were; `round` counts up from 0. A vertex that has slid goes all the way.
    pub(crate) fn take_back(&mut self, domain: &TriMesh, before: &Self, faces: &[FaceId], round: usize) {
        let mut vertices: Vec<VertexId> = faces.iter().flat_map(|&f| domain.face(f)).collect();
        vertices.sort_unstable();
        vertices.dedup();
        for v in vertices {
            let (spot, before) = (&mut self.0[v], before.0[v]);
            if round < HALVINGS && spot.point == before.point {
                spot.height = before.height + 0.5 * (spot.height - before.height);
            } else {
                *spot = before;
            }
        }
    }

    pub(crate) fn triangle(&self, domain: &TriMesh, f: FaceId) -> [DVec3; 3] {
        domain.face(f).map(|v| self.0[v].position())
    }

    pub(crate) fn mesh(&self, domain: &TriMesh) -> Result<TriMesh, MeshError> {
        domain.with_positions(self.0.iter().map(Spot::position).collect())
    }
}

/// The mean length of the edges of every vertex.
pub(crate) fn mean_edges(Domain { mesh, topology, .. }: &Domain) -> IdVec<VertexId, f64> {
    let mean = |v: VertexId| {
        let lengths: Vec<f64> = topology.one_ring(v).map(|w| mesh.distance(v, w)).collect();
        lengths.iter().sum::<f64>() / lengths.len().max(1) as f64
    };
    mesh.positions().ids().map(mean).collect()
}

/// The faces round some faces.
fn neighbourhood(domain: &TriMesh, topology: &Topology, faces: &[FaceId]) -> Vec<FaceId> {
    let mut around: Vec<FaceId> =
        faces.iter().flat_map(|&f| domain.face(f)).flat_map(|v| topology.fan(v)).map(HalfedgeId::face).collect();
    around.sort_unstable();
    around.dedup();
    around
}

/// No triangle may fall below the quality that this share of all triangles did not have at the start, unless it was there already.
const WORST: f64 = 0.01;

/// By what share the quality of the worst triangles may fall nevertheless: without it, vertices whose triangles are the worst of all stay
/// on the surface while all around them rises (those of valence 5 of a sphere).
const SLACK: f64 = 0.003;

/// The shape that triangles had at the start and shall not lose.
pub(crate) struct ShapeGuard<'a> {
    domain: &'a TriMesh,
    topology: &'a Topology,
    /// The surface's normal under each face.
    normals: IdVec<FaceId, DVec3>,
    /// Least quality, negative against the normal.
    least: IdVec<FaceId, f64>,
    /// Mean quality at the start.
    mean: f64,
}

impl<'a> ShapeGuard<'a> {
    /// Triangles may lose the share `loss` of their quality.
    pub(crate) fn new(domain: &'a TriMesh, topology: &'a Topology, normals: IdVec<FaceId, DVec3>, loss: f64) -> Self {
        let start: Vec<f64> = normals.enumerate().map(|(f, &n)| signed_quality(domain.triangle(f), n)).collect();
        let mut sorted = start.clone();
        let rank = (WORST * sorted.len() as f64) as usize;
        let floor = if sorted.is_empty() { 0.0 } else { *sorted.select_nth_unstable_by(rank, f64::total_cmp).1 };
        let least =
            start.iter().map(|&q| (q.min(floor) * (1.0 - SLACK.copysign(q))).max((1.0 - loss.copysign(q)) * q).min(q)).collect();
        Self { domain, topology, normals, least, mean: mean(&start) }
    }

    /// By how much the mean quality has fallen.
    pub(crate) fn loss(&self, now: &Placement) -> f64 {
        let quality = |f: FaceId| signed_quality(now.triangle(self.domain, f), self.normals[f]);
        let faces: Vec<FaceId> = self.domain.faces().ids().collect();
        self.mean - mean(&faces.into_par_iter().map(quality).collect::<Vec<f64>>())
    }

    /// Takes vertices back until no triangle is worse than it may be; in `before` none is.
    pub(crate) fn hold(&self, now: &mut Placement, before: &Placement) {
        let mut suspects: Vec<FaceId> = self.domain.faces().ids().collect();
        for round in 0.. {
            suspects.retain(|&f| signed_quality(now.triangle(self.domain, f), self.normals[f]) < self.least[f]);
            if suspects.is_empty() {
                return;
            }
            now.take_back(self.domain, before, &suspects, round);
            suspects = neighbourhood(self.domain, self.topology, &suspects);
        }
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

fn signed_quality(triangle: [DVec3; 3], normal: DVec3) -> f64 {
    mesh_core::aspect_ratio(triangle).copysign(mesh_core::vector_area(triangle).dot(normal))
}
