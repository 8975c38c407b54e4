//! The domain as the relaxation sees it: what each vertex is free to do, and which side of its arc each face lies on.

use crate::RelaxError;
use crate::corner_normal::{CornerNormal, corner_normals, reference_normal};
use crate::freedom::Freedom;
use crate::longest_gaps::LongestGaps;
use glam::DVec3;
use mesh_core::{FaceId, HalfedgeId, Id, IdVec, Topology, VertexId};
use rayon::prelude::*;
use region_map::{Domain, Surface};
use std::sync::Arc as Shared;

/// A vertex inside a sheet moves this many mean edges in a step at most. Less slows down what has far to go; without a bound
/// steps of thousands of diagonals come up while triangles are inverted, and a walk that long goes round and round (crank_cse:
/// minutes).
const LONGEST_MOVE: f64 = 4.0;

/// So many vertices or faces are one task: with fewer, parts of some hundred triangles were divided among threads, which cost more
/// than it gained.
const AT_ONCE: usize = 512;

/// What never changes while the vertices move.
pub(crate) struct MovableDomain<'a> {
    pub(crate) surface: &'a Surface,
    pub(crate) topology: Shared<Topology>,
    /// What every vertex is free to do.
    pub(crate) freedoms: IdVec<VertexId, Freedom>,
    /// Which normal each face takes at each of its corners.
    pub(crate) normals: IdVec<HalfedgeId, CornerNormal>,
    /// No vertex inside a sheet moves farther in a step.
    pub(crate) longest_move: f64,
}

impl<'a> MovableDomain<'a> {
    /// Checks the domain and works out what its vertices may do.
    pub(crate) fn new(surface: &'a Surface, domain: &Domain) -> Result<Self, RelaxError> {
        domain.check(surface.network())?;
        let topology = domain.topology.clone();
        let longest_gaps = LongestGaps::new(surface, domain);
        let freedoms: Vec<Freedom> =
            domain.region.vertices().map(|v| Freedom::new(surface, domain, &longest_gaps, v)).collect::<Result<_, _>>()?;
        let freedoms = IdVec::from_vec(freedoms);
        let normals = corner_normals(surface, domain, &freedoms);
        let mean_edge = (surface.mesh().total_area() / topology.n_faces().max(1) as f64 * 4.0 / 3f64.sqrt()).sqrt();
        Ok(Self { surface, topology, freedoms, normals, longest_move: LONGEST_MOVE * mean_edge })
    }

    /// Something of every face, in order.
    pub(crate) fn of_faces<T: Send>(&self, value: impl Fn(FaceId) -> T + Sync + Send) -> Vec<T> {
        each(self.topology.n_faces(), value)
    }

    /// Holds some vertices where they are. Fails for one that is not there.
    pub(crate) fn hold(&mut self, held: &[VertexId]) -> Result<(), RelaxError> {
        if let Some(&v) = held.iter().find(|&&v| self.freedoms.get(v).is_none()) {
            return Err(RelaxError::NoSuchVertex(v));
        }
        held.iter().for_each(|&v| self.freedoms[v] = Freedom::Fixed);
        Ok(())
    }

    /// Whether the work on this domain shall end: its caller then throws away what there is.
    pub(crate) fn is_interrupted(&self) -> bool {
        self.surface.interrupt().is_set()
    }

    /// The unit reference normal of a face: the mean of the surface's normals at its corners, each seen from the face's side of
    /// the arcs. `normals` gives both sides at a vertex.
    pub(crate) fn reference_normal(&self, f: FaceId, normals: impl Fn(VertexId) -> [DVec3; 2]) -> DVec3 {
        let corners = self.topology.face(f);
        reference_normal([0, 1, 2].map(|c| (self.normals[HalfedgeId::of(f, c)], normals(corners[c]))))
    }

    /// The faces around some vertices, in order.
    pub(crate) fn fans(&self, vertices: &[VertexId]) -> Vec<FaceId> {
        let mut faces: Vec<FaceId> = vertices.iter().flat_map(|&v| self.topology.faces_at(v)).collect();
        faces.sort_unstable();
        faces.dedup();
        faces
    }
}

/// Something of the first `n` vertices or faces, in order.
pub(crate) fn each<I: Id, T: Send>(n: usize, value: impl Fn(I) -> T + Sync + Send) -> Vec<T> {
    (0..n).into_par_iter().with_min_len(AT_ONCE).map(|i| value(I::new(i))).collect()
}
