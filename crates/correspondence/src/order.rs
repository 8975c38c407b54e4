//! [`FaceOrder`]: the orders in which the faces of a level are written.

use mesh_core::{MeshError, TriMesh};

/// An order of the faces of a level. All keep the order of the vertices, and the first corner of each face.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FaceOrder {
    /// Ours: the children of face `f` are `4f..4f+3`, the three at the corners first, the one in the middle last.
    #[default]
    Children,
    /// That of SubdivNet (Hu et al., *Subdivision-based mesh convolution networks*, 2022), which pools in blocks: of `4F` faces, the
    /// children of face `f` are `f`, `f + F`, `f + 2F` and `f + 3F`, the three at the corners first.
    SubdivNet,
}

impl FaceOrder {
    /// Where a face of a level goes that has this number in the order [`FaceOrder::Children`]. The base mesh has `n_base` faces.
    ///
    /// With `b` the base face and `c_k` the number of the child at split k, that is `b + n_base (c_1 + 4 c_2 + 16 c_3 + ...)`.
    pub fn place(self, face: usize, level: u32, n_base: usize) -> usize {
        match self {
            Self::Children => face,
            Self::SubdivNet => {
                let child = |split: u32| (face >> (2 * (level - split))) & 3;
                let blocks: usize = (1..=level).map(|split| child(split) << (2 * (split - 1))).sum();
                (face >> (2 * level)) + n_base * blocks
            }
        }
    }

    /// The parent, a level before, of the face at a place.
    pub fn parent(self, place: usize, level: u32, n_base: usize) -> usize {
        match self {
            Self::Children => place / 4,
            Self::SubdivNet => place % (n_base << (2 * level.saturating_sub(1))),
        }
    }

    /// The base face of the face at a place.
    pub fn base_face(self, place: usize, level: u32, n_base: usize) -> usize {
        match self {
            Self::Children => place >> (2 * level),
            Self::SubdivNet => place % n_base,
        }
    }

    /// A mesh of a level, its faces in the order [`FaceOrder::Children`], in this order.
    ///
    /// Fails as [`TriMesh::new`] does, which it never should.
    pub fn ordered(self, mesh: &TriMesh, level: u32) -> Result<TriMesh, MeshError> {
        self.rearranged(mesh, level, |faces, from, to| faces[to] = mesh.faces().as_slice()[from].map(|v| v.0))
    }

    /// A mesh of a level, its faces in this order, in the order [`FaceOrder::Children`].
    ///
    /// Fails as [`TriMesh::new`] does, which it never should.
    pub fn restored(self, mesh: &TriMesh, level: u32) -> Result<TriMesh, MeshError> {
        self.rearranged(mesh, level, |faces, from, to| faces[from] = mesh.faces().as_slice()[to].map(|v| v.0))
    }

    fn rearranged(self, mesh: &TriMesh, level: u32, put: impl Fn(&mut [[u32; 3]], usize, usize)) -> Result<TriMesh, MeshError> {
        let (n, n_base) = (mesh.n_faces(), mesh.n_faces() >> (2 * level));
        // What is no subdivision of so many levels has no other order.
        if self == Self::Children || n_base << (2 * level) != n {
            return Ok(mesh.clone());
        }
        let mut faces = vec![[0; 3]; n];
        (0..n).for_each(|face| put(&mut faces, face, self.place(face, level, n_base)));
        TriMesh::new(mesh.positions().as_slice().to_vec(), faces)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pools as SubdivNet does, by its own definition: level by level, block by block, down to the base.
    #[test]
    fn pooling_by_blocks_leads_to_the_parents_of_three_levels() {
        const BASE: usize = 5;
        // The number in our order at each place of SubdivNet's.
        let mut at: Vec<usize> = vec![usize::MAX; BASE * 64];
        (0..BASE * 64).for_each(|face| at[FaceOrder::SubdivNet.place(face, 3, BASE)] = face);
        for level in (0..3).rev() {
            let coarse = BASE << (2 * level);
            let parents: Vec<usize> = (0..coarse).map(|f| at[f] / 4).collect();
            for (f, &parent) in parents.iter().enumerate() {
                let pooled = [at[f], at[f + coarse], at[f + 2 * coarse], at[f + 3 * coarse]];
                assert_eq!(pooled, [4 * parent, 4 * parent + 1, 4 * parent + 2, 4 * parent + 3], "face {f} of level {level}");
                assert_eq!(FaceOrder::SubdivNet.place(parent, level, BASE), f);
                for block in 0..4 {
                    assert_eq!(FaceOrder::SubdivNet.parent(f + block * coarse, level + 1, BASE), f);
                }
            }
            at = parents;
        }
        assert_eq!(at, [0, 1, 2, 3, 4]);
    }
}
