//! Keeps triangles from losing too much of their quality.

use crate::placement::Placement;
use glam::DVec3;
use mesh_core::{FaceId, IdVec, Topology, TriMesh};
use rayon::prelude::*;

/// The faces round some faces.
fn neighbourhood(domain: &TriMesh, topology: &Topology, faces: &[FaceId]) -> Vec<FaceId> {
    let mut around: Vec<FaceId> = faces.iter().flat_map(|&f| domain.face(f)).flat_map(|v| topology.faces_at(v)).collect();
    around.sort_unstable();
    around.dedup();
    around
}

/// The quality that this share of all triangles is below at the start. No better triangle may fall below it.
const WORST: f64 = 0.01;

/// By what share the quality of the worst triangles may fall nevertheless: without it, vertices whose triangles are the worst of
/// all stay on the surface while all around them rises (those of valence 5 of a sphere).
const SLACK: f64 = 0.003;

/// The least quality of every triangle.
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
    /// Triangles may lose the share `loss` of the quality that they have in `domain`.
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
