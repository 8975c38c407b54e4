//! Where the vertices are: each over a point of the surface, at a height.

use crate::system::Freedom;
use glam::DVec3;
use mesh_core::{FaceId, Id, IdVec, MeshError, SurfacePoint, TriMesh, VertexId, walk_end};
use rayon::prelude::*;
use region_map::{Attachment, Domain, Surface};

/// How far a vertex may slide over the surface in one round, as a share of the mean length of its edges.
const SLIDE: f64 = 0.2;
/// How often a vertex that has gone too far goes half of the way back before it goes all of it.
pub(crate) const HALVINGS: usize = 4;

/// The place of one vertex.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) point: SurfacePoint,
    /// The position of the point.
    foot: DVec3,
    /// The surface's unit normal; `None` for a vertex that stays.
    normal: Option<DVec3>,
    /// Distance from the foot along the normal.
    pub(crate) height: f64,
}

impl Place {
    pub(crate) fn position(&self) -> DVec3 {
        self.foot + self.normal.map_or(DVec3::ZERO, |normal| self.height * normal)
    }
}

/// The places of all vertices.
#[derive(Clone, Debug)]
pub(crate) struct Placement(pub(crate) IdVec<VertexId, Place>);

impl Placement {
    /// On the surface. What is not inside a sheet stays, and so does what has no normal.
    pub(crate) fn new(surface: &Surface, Domain { mesh, region, .. }: &Domain) -> Self {
        let place = |v: VertexId| {
            let point = region.points[v];
            let normal = match region.attachments[v] {
                Attachment::Sheet(_) => normal_at(surface, point),
                _ => None,
            };
            Place { point, foot: mesh.position(v), normal, height: 0.0 }
        };
        Self(region.vertices().map(place).collect())
    }

    /// Every vertex displaced: the share `slide` of the part along the surface is walked inside the sheet, and the part along the
    /// normal changes the height, which is at most `reach` times the mean edge length of the vertex.
    pub(crate) fn displaced(
        &self,
        surface: &Surface,
        displacements: &IdVec<VertexId, DVec3>,
        edges: &IdVec<VertexId, f64>,
        slide: f64,
        reach: f64,
    ) -> Self {
        let may_cross = |e| !surface.network().is_barrier(e);
        let place = |i: usize| {
            let v = VertexId::new(i);
            let (mut place, displacement) = (self.0[v], displacements[v]);
            let Some(normal) = place.normal else { return place };
            let rise = displacement.dot(normal);
            // Edges of huge meshes may be infinitely long: then there may be no number, and no bound.
            let bound = (reach * edges[v]).min(f64::MAX);
            place.height = (place.height + rise).clamp(-bound, bound);
            let along = slide * (displacement - rise * normal).clamp_length_max(SLIDE * edges[v]);
            if along != DVec3::ZERO {
                let point = walk_end(surface.mesh(), surface.topology(), place.point, along, may_cross);
                if let Some(normal) = normal_at(surface, point) {
                    place = Place { point, foot: point.position(surface.mesh()), normal: Some(normal), ..place };
                }
            }
            place
        };
        Self(IdVec::from_vec((0..self.0.len()).into_par_iter().map(place).collect()))
    }

    /// In which directions the vertices may move: all where they may slide, else their normals.
    pub(crate) fn freedoms(&self, slides: bool) -> IdVec<VertexId, Freedom> {
        let freedom = |place: &Place| match place.normal {
            None => Freedom::Fixed,
            Some(_) if slides => Freedom::Free,
            Some(normal) => Freedom::Along(normal),
        };
        self.0.iter().map(freedom).collect()
    }

    /// Takes the vertices of some faces back towards where they were; `round` counts up from 0. A vertex that has slid goes all
    /// the way.
    pub(crate) fn take_back(&mut self, domain: &TriMesh, before: &Self, faces: &[FaceId], round: usize) {
        let mut vertices: Vec<VertexId> = faces.iter().flat_map(|&f| domain.face(f)).collect();
        vertices.sort_unstable();
        vertices.dedup();
        for v in vertices {
            let (place, before) = (&mut self.0[v], before.0[v]);
            if round < HALVINGS && place.point == before.point {
                place.height = before.height + 0.5 * (place.height - before.height);
            } else {
                *place = before;
            }
        }
    }

    pub(crate) fn triangle(&self, domain: &TriMesh, f: FaceId) -> [DVec3; 3] {
        domain.face(f).map(|v| self.0[v].position())
    }

    pub(crate) fn mesh(&self, domain: &TriMesh) -> Result<TriMesh, MeshError> {
        domain.with_positions(self.0.iter().map(Place::position).collect())
    }
}

/// The unit normal at a point; `None` where those around it cancel.
fn normal_at(surface: &Surface, point: SurfacePoint) -> Option<DVec3> {
    Some(surface.normals().at(point)).filter(|&normal| normal != DVec3::ZERO)
}

/// The mean length of the edges of every vertex.
pub(crate) fn mean_edges(Domain { mesh, topology, .. }: &Domain) -> IdVec<VertexId, f64> {
    let mean = |v: VertexId| {
        let lengths: Vec<f64> = topology.one_ring(v).map(|w| mesh.distance(v, w)).collect();
        lengths.iter().sum::<f64>() / lengths.len().max(1) as f64
    };
    mesh.positions().ids().map(mean).collect()
}
