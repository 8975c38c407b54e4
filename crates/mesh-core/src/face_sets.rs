//! Sets of faces: what hangs together, and what is around.

use crate::{FaceId, Topology};
use std::collections::BTreeSet;

impl Topology {
    /// Some faces, sorted into clusters: faces with a common vertex are in one. In the order of their first faces. Faces that are
    /// not there are left out.
    pub fn clusters(&self, faces: &[FaceId]) -> Vec<Vec<FaceId>> {
        let mut left: BTreeSet<FaceId> = faces.iter().copied().filter(|&f| self.faces().get(f).is_some()).collect();
        let mut clusters = Vec::new();
        while let Some(first) = left.pop_first() {
            let mut cluster = vec![first];
            let mut next = 0;
            while let Some(&f) = cluster.get(next) {
                let around = self.face(f).into_iter().flat_map(|v| self.faces_at(v));
                cluster.extend(around.filter(|g| left.remove(g)));
                next += 1;
            }
            clusters.push(cluster);
        }
        clusters
    }

    /// Some faces and those around them, so many rings, in rising order. Faces that are not there are left out.
    pub fn widened(&self, faces: &[FaceId], rings: usize) -> Vec<FaceId> {
        let mut wide: BTreeSet<FaceId> = faces.iter().copied().filter(|&f| self.faces().get(f).is_some()).collect();
        for _ in 0..rings {
            let corners = wide.iter().flat_map(|&f| self.face(f));
            wide = corners.flat_map(|v| self.faces_at(v)).collect();
        }
        wide.into_iter().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{IdVec, VertexId};

    /// A strip of `n` triangles, each with an edge in common with the one before it.
    fn strip(n: u32) -> Topology {
        let face = |i: u32| if i.is_multiple_of(2) { [i, i + 1, i + 2] } else { [i + 1, i, i + 2] };
        let faces: IdVec<FaceId, [VertexId; 3]> = (0..n).map(|i| face(i).map(VertexId)).collect();
        Topology::new(&faces, n as usize + 2).unwrap()
    }

    #[test]
    fn clusters_hang_together_by_vertices() {
        let t = strip(6);
        let clusters = |faces: &[u32]| t.clusters(&faces.iter().map(|&f| FaceId(f)).collect::<Vec<_>>());
        assert_eq!(clusters(&[0, 3]), [[FaceId(0)], [FaceId(3)]]);
        assert_eq!(clusters(&[5, 0, 3]), [vec![FaceId(0)], vec![FaceId(3), FaceId(5)]]);
        assert!(clusters(&[]).is_empty());
    }

    #[test]
    fn faces_are_widened_by_rings() {
        let t = strip(9);
        let widened = |faces: &[u32], rings| t.widened(&faces.iter().map(|&f| FaceId(f)).collect::<Vec<_>>(), rings);
        assert_eq!(widened(&[4, 99, 0], 0), [0, 4].map(FaceId));
        assert_eq!(widened(&[0], 1), [0, 1, 2].map(FaceId));
        assert_eq!(widened(&[8], 2), [4, 5, 6, 7, 8].map(FaceId));
    }

    #[test]
    fn clusters_of_faces_that_are_not_there_are_none() {
        let t = strip(4);
        assert_eq!(t.clusters(&[FaceId(9), FaceId(u32::MAX), FaceId(2)]), [[FaceId(2)]]);
    }
}
