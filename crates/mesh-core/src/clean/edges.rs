//! The halfedges of any faces, grouped by their undirected edge.

use crate::{FaceId, HalfedgeId, IdVec, VertexId};
use rayon::prelude::*;

/// A halfedge with the ends of its edge, the lower first.
pub(crate) type EdgeUse = ([VertexId; 2], HalfedgeId);

/// All halfedges sorted by their edge, then by id: `chunk_by` the ends gives the uses of one edge.
pub(crate) fn edge_groups(faces: &IdVec<FaceId, [VertexId; 3]>) -> EdgeGroups {
    let mut uses: Vec<EdgeUse> = faces
        .enumerate()
        .flat_map(|(f, v)| {
            [0, 1, 2].map(|c| {
                let (a, b) = (v[c], v[(c + 1) % 3]);
                ([a.min(b), a.max(b)], HalfedgeId::of(f, c))
            })
        })
        .collect();
    uses.par_sort_unstable();
    EdgeGroups { uses }
}

/// See [`edge_groups`].
pub(crate) struct EdgeGroups {
    uses: Vec<EdgeUse>,
}

impl EdgeGroups {
    /// The uses of every edge, edges in the order of their ends.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &[EdgeUse]> {
        self.uses.chunk_by(|a, b| a.0 == b.0)
    }
}
