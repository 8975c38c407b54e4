//! The paths of base edges that are traced.

use mesh_core::VertexId;
use rustc_hash::FxHashMap;

/// The paths of traced base edges, as vertices of the cut mesh.
#[derive(Default)]
pub(crate) struct Paths {
    /// From the lower to the higher base vertex, by these.
    by_ends: FxHashMap<[VertexId; 2], Vec<u32>>,
}

impl Paths {
    /// Keeps the path from `v` to `w`.
    pub(crate) fn keep(&mut self, v: VertexId, w: VertexId, mut path: Vec<u32>) {
        if v > w {
            path.reverse();
        }
        self.by_ends.insert([v.min(w), v.max(w)], path);
    }

    /// True where the edge between two vertices is traced.
    pub(crate) fn has(&self, v: VertexId, w: VertexId) -> bool {
        self.by_ends.contains_key(&[v.min(w), v.max(w)])
    }

    /// The path from `v` to `w`.
    pub(crate) fn path(&self, v: VertexId, w: VertexId) -> Option<Vec<u32>> {
        let mut path = self.by_ends.get(&[v.min(w), v.max(w)])?.clone();
        if v > w {
            path.reverse();
        }
        Some(path)
    }

    /// The vertex next to `v` on the path to `w`.
    pub(crate) fn first_step(&self, v: VertexId, w: VertexId) -> Option<u32> {
        let path = self.by_ends.get(&[v.min(w), v.max(w)])?;
        Some(if v < w { path[1] } else { path[path.len() - 2] })
    }
}
