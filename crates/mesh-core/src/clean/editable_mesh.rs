//! [`EditableMesh`]: the mesh while it is being cleaned.

use crate::{FaceId, HalfedgeId, IdVec, VertexId};
use glam::DVec3;

/// For every halfedge the one on the other side of its edge, if any.
pub(super) type Twins = IdVec<HalfedgeId, Option<HalfedgeId>>;

/// Faces with three different vertices in range and at different positions.
#[derive(Clone, Default)]
pub(super) struct EditableMesh {
    pub(super) positions: IdVec<VertexId, DVec3>,
    /// Vertex of the soup.
    pub(super) source_vertex: IdVec<VertexId, u32>,
    /// For every vertex of the soup the one that it was merged into; itself where it was not.
    pub(super) merged_into: Vec<u32>,
    pub(super) faces: IdVec<FaceId, [VertexId; 3]>,
    /// Triangle of the soup.
    pub(super) source_face: IdVec<FaceId, u32>,
    /// True for faces that were turned over.
    pub(super) turned: IdVec<FaceId, bool>,
}

impl EditableMesh {
    pub(super) fn from(&self, h: HalfedgeId) -> VertexId {
        self.faces[h.face()][h.corner()]
    }

    pub(super) fn opposite(&self, h: HalfedgeId) -> VertexId {
        self.from(h.prev())
    }

    pub(super) fn triangle(&self, f: FaceId) -> [DVec3; 3] {
        self.faces[f].map(|v| self.positions[v])
    }

    /// Turns a face over. Its first corner stays the first.
    pub(super) fn turn(&mut self, f: FaceId) {
        self.faces[f].swap(1, 2);
        self.turned[f] = !self.turned[f];
    }

    /// Drops the faces marked and returns how many these are.
    pub(super) fn drop_faces(&mut self, drop: &IdVec<FaceId, bool>) -> usize {
        let before = self.faces.len();
        let kept: Vec<FaceId> = drop.ids().filter(|&f| !drop[f]).collect();
        self.faces = kept.iter().map(|&f| self.faces[f]).collect();
        self.source_face = kept.iter().map(|&f| self.source_face[f]).collect();
        self.turned = kept.iter().map(|&f| self.turned[f]).collect();
        before - self.faces.len()
    }

    /// Renumbers the vertices so that all of them are used, in the same order.
    pub(super) fn without_unused_vertices(mut self) -> Self {
        let mut used = IdVec::<VertexId, bool>::filled(false, self.positions.len());
        for &v in self.faces.iter().flatten() {
            used[v] = true;
        }
        let mut kept = EditableMesh::default();
        let mut new = IdVec::<VertexId, VertexId>::filled(VertexId(0), self.positions.len());
        for v in used.ids().filter(|&v| used[v]) {
            new[v] = kept.positions.push(self.positions[v]);
            kept.source_vertex.push(self.source_vertex[v]);
        }
        for v in self.faces.iter_mut().flatten() {
            *v = new[*v];
        }
        EditableMesh { positions: kept.positions, source_vertex: kept.source_vertex, ..self }
    }
}
