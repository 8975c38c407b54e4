//! A placement with the measures of all its faces. Each placement is measured once, and what is put back is measured anew: the
//! energies, the signs of the areas and the second-order model all ask for the same.

use crate::energy::Measures;
use crate::movable_domain::MovableDomain;
use crate::placement::Placement;
use mesh_core::{FaceId, IdVec, VertexId};

/// A placement, measured.
#[derive(Clone, Debug)]
pub(crate) struct Measured {
    placement: Placement,
    faces: IdVec<FaceId, Measures>,
}

impl Measured {
    pub(crate) fn new(domain: &MovableDomain, placement: Placement) -> Self {
        let faces = IdVec::from_vec(domain.of_faces(|f| placement.measures(domain, f)));
        Self { placement, faces }
    }

    pub(crate) fn placement(&self) -> &Placement {
        &self.placement
    }

    pub(crate) fn into_placement(self) -> Placement {
        self.placement
    }

    /// The measures of every face.
    pub(crate) fn faces(&self) -> &IdVec<FaceId, Measures> {
        &self.faces
    }

    /// Brings back the vertices of some faces to where they were in `before`. Returns all faces that this may have changed, in
    /// order.
    pub(crate) fn put_back(&mut self, domain: &MovableDomain, before: &Placement, bad: &[FaceId]) -> Vec<FaceId> {
        let mut vertices: Vec<VertexId> = bad.iter().flat_map(|&f| domain.topology.face(f)).collect();
        vertices.sort_unstable();
        vertices.dedup();
        for &v in &vertices {
            self.placement.move_to(v, before[v]);
        }
        let changed = domain.fans(&vertices);
        for &f in &changed {
            self.faces[f] = self.placement.measures(domain, f);
        }
        changed
    }

    /// Puts back the triangles that are turned over here and faced with the surface in `before`, then those that this turns over,
    /// until none is left.
    pub(crate) fn hold_upright(&mut self, domain: &MovableDomain, before: &Self) {
        let is_bad = |now: &Self, f: FaceId| now.faces[f].signed_area <= 0.0 && before.faces[f].signed_area > 0.0;
        let mut bad: Vec<FaceId> = domain.topology.faces().ids().filter(|&f| is_bad(self, f)).collect();
        while !bad.is_empty() {
            let changed = self.put_back(domain, &before.placement, &bad);
            bad = changed.into_iter().filter(|&f| is_bad(self, f)).collect();
        }
    }
}
