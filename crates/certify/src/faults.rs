//! Which triangles of a remeshed surface would the certificate refuse?

use crate::quality::DEGENERATE_ASPECT_RATIO;
use crate::reference::Reference;
use mesh_core::{FaceId, TriMesh, aspect_ratio};
use rayon::prelude::*;

/// The triangles for which the certificate would refuse a mesh.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Faults {
    /// Those that face against the original, in rising order.
    pub flipped: Vec<FaceId>,
    /// Those of an aspect ratio below [`DEGENERATE_ASPECT_RATIO`], in rising order. They may be flipped as well.
    pub degenerate: Vec<FaceId>,
}

impl Faults {
    /// True without any.
    pub fn is_empty(&self) -> bool {
        self.flipped.is_empty() && self.degenerate.is_empty()
    }

    /// All of them, in rising order, each once.
    pub fn faces(&self) -> Vec<FaceId> {
        let mut faces = [self.flipped.as_slice(), &self.degenerate].concat();
        faces.sort_unstable();
        faces.dedup();
        faces
    }
}

/// The faces of a remeshed surface that the certificate would refuse.
pub fn faulty_faces(original: &Reference, remeshed: &TriMesh) -> Faults {
    let faces: Vec<FaceId> = remeshed.faces().ids().collect();
    faults_of(original, remeshed, faces)
}

/// Those of some faces that the certificate would refuse. Faces that the mesh has not are left out.
pub fn faulty_faces_among(original: &Reference, remeshed: &TriMesh, faces: &[FaceId]) -> Faults {
    let mut faces: Vec<FaceId> = faces.iter().copied().filter(|&f| remeshed.faces().get(f).is_some()).collect();
    faces.sort_unstable();
    faces.dedup();
    faults_of(original, remeshed, faces)
}

fn faults_of(original: &Reference, remeshed: &TriMesh, faces: Vec<FaceId>) -> Faults {
    let is_degenerate = |f: &FaceId| aspect_ratio(remeshed.triangle(*f)) < DEGENERATE_ASPECT_RATIO;
    let degenerate = faces.iter().copied().filter(is_degenerate).collect();
    Faults { flipped: flipped_of(original, remeshed, faces), degenerate }
}

/// The faces of the remeshed surface whose normal opposes that of the original at the point nearest to their middle, in rising
/// order ([`mesh_core::SurfaceIndex::opposes`]).
///
/// Faces without area have no normal and do not count here: [`crate::Quality::degenerate`] counts them.
pub fn flipped(original: &Reference, remeshed: &TriMesh) -> Vec<FaceId> {
    flipped_of(original, remeshed, remeshed.faces().ids().collect())
}

fn flipped_of(original: &Reference, remeshed: &TriMesh, faces: Vec<FaceId>) -> Vec<FaceId> {
    let opposes = |f: &FaceId| original.index().opposes(remeshed.centroid(*f), remeshed.normal(*f));
    faces.into_par_iter().filter(opposes).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_shapes::{cube, joined, mesh, moved, sphere, square, subdivide, with_face_turned};
    use glam::DVec3;

    fn faces(original: &TriMesh, remeshed: &TriMesh) -> Vec<u32> {
        let flipped = flipped(&Reference::new(original.clone()).unwrap(), remeshed);
        flipped.into_iter().map(|f| f.0).collect()
    }

    #[test]
    fn one_turned_triangle_is_found() {
        assert!(faces(&sphere(3), &sphere(2)).is_empty());
        for f in [0, 17, 319] {
            assert_eq!(faces(&sphere(3), &with_face_turned(&sphere(2), f)), [f as u32]);
        }
        assert_eq!(faces(&square(), &with_face_turned(&subdivide(&square()), 5)), [5]);
        assert!(faces(&cube(), &subdivide(&cube())).is_empty());
    }

    #[test]
    fn a_sheet_that_faces_the_same_way_in_the_same_place_is_no_fold() {
        let back = |z: f64| moved(&with_face_turned(&with_face_turned(&square(), 0), 1), |p| p - z * DVec3::Z);
        let thin = joined(&square(), &back(1e-5));
        assert!(faces(&thin, &back(0.0)).is_empty());
        let thick = joined(&square(), &back(1e-2));
        assert_eq!(faces(&thick, &back(0.0)), [0, 1]);
    }

    #[test]
    fn flipped_and_degenerate_faces_of_all_or_of_some() {
        // Upright, turned over, a needle, and a needle turned over.
        let positions = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0.5, -1e-3, 0.]];
        let remeshed = mesh(&positions, &[[0, 1, 2], [0, 2, 1], [0, 3, 1], [0, 1, 3]]);
        let original = Reference::new(square()).unwrap();
        let all = faulty_faces(&original, &remeshed);
        assert_eq!(all, Faults { flipped: vec![FaceId(1), FaceId(3)], degenerate: vec![FaceId(2), FaceId(3)] });
        assert_eq!(all.faces(), [1, 2, 3].map(FaceId));
        assert!(!all.is_empty() && Faults::default().is_empty());
        let some = faulty_faces_among(&original, &remeshed, &[FaceId(3), FaceId(0), FaceId(9), FaceId(3)]);
        assert_eq!(some, Faults { flipped: vec![FaceId(3)], degenerate: vec![FaceId(3)] });
    }
}
