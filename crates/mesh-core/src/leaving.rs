//! Directed edges, found by their ends.

use crate::{FaceId, HalfedgeId, IdVec, VertexId};

/// The halfedges that leave each vertex, sorted by the vertex that they go to.
pub(crate) struct Leaving {
    /// Where in `halfedges` those of a vertex start, and at last the end.
    starts: Vec<u32>,
    halfedges: Vec<(VertexId, HalfedgeId)>,
}

impl Leaving {
    /// `faces` of `n_vertices` vertices, all indices in range.
    pub(crate) fn of(faces: &IdVec<FaceId, [VertexId; 3]>, n_vertices: usize) -> Self {
        let mut starts = vec![0; n_vertices + 1];
        for v in faces.iter().flatten() {
            starts[v.0 as usize] += 1;
        }
        let mut end = 0;
        for start in &mut starts {
            end += *start;
            *start = end;
        }
        // Filled from the back, so that each start moves to where it belongs, and halfedges come in their order.
        let mut halfedges = vec![(VertexId(0), HalfedgeId(0)); 3 * faces.len()];
        for (f, v) in faces.enumerate().rev() {
            for c in [2, 1, 0] {
                let start = &mut starts[v[c].0 as usize];
                *start -= 1;
                halfedges[*start as usize] = (v[(c + 1) % 3], HalfedgeId::of(f, c));
            }
        }
        for ends in starts.windows(2) {
            halfedges[ends[0] as usize..ends[1] as usize].sort_unstable();
        }
        Self { starts, halfedges }
    }

    fn at(&self, v: VertexId) -> &[(VertexId, HalfedgeId)] {
        let v = v.0 as usize;
        &self.halfedges[self.starts[v] as usize..self.starts[v + 1] as usize]
    }

    /// The halfedge from one vertex to another.
    pub(crate) fn find(&self, from: VertexId, to: VertexId) -> Option<HalfedgeId> {
        let leaving = self.at(from);
        let i = leaving.partition_point(|&(end, _)| end < to);
        leaving.get(i).filter(|&&(end, _)| end == to).map(|&(_, h)| h)
    }

    /// The first halfedge that runs where one before it does, after that one.
    pub(crate) fn first_repeated(&self) -> Option<[HalfedgeId; 2]> {
        let at_vertices = self.starts.windows(2).map(|ends| &self.halfedges[ends[0] as usize..ends[1] as usize]);
        let repeated = at_vertices.flat_map(|leaving| leaving.windows(2)).filter(|pair| pair[0].0 == pair[1].0);
        repeated.map(|pair| [pair[0].1, pair[1].1]).min_by_key(|pair| pair[1])
    }
}
