//! Patches of a working mesh.

use mesh_core::{FaceId, Id as _, IdVec, TriMesh, define_id};

define_id! {
    /// A patch of the segmentation.
    PatchId "p"
}

/// The patch of every face (paper, section 3.1). `segment-vsa` promises that every patch is a disk whose border is one simple
/// cycle of distinct vertices, and that no arc of the network has the same patch on both sides.
#[derive(Clone, Debug, PartialEq)]
pub struct Segmentation {
    /// The patch of every face.
    pub patch_of_face: IdVec<FaceId, PatchId>,
    /// Number of patches; every one has a face.
    pub n_patches: usize,
}

impl Segmentation {
    /// True where every face of the mesh has one of the patches, and there are not more patches than faces.
    pub fn fits(&self, mesh: &TriMesh) -> bool {
        self.patch_of_face.len() == mesh.n_faces()
            && self.n_patches <= mesh.n_faces()
            && self.patch_of_face.iter().all(|p| p.index() < self.n_patches)
    }

    /// The faces of every patch, in the order of their ids.
    pub fn faces_of_patches(&self) -> IdVec<PatchId, Vec<FaceId>> {
        let mut faces = IdVec::filled(Vec::new(), self.n_patches);
        for (f, &p) in self.patch_of_face.enumerate() {
            faces[p].push(f);
        }
        faces
    }
}
