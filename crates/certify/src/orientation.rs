//! Which triangles of a remeshed surface look the wrong way?

use crate::surface::Surface;
use mesh_core::{FaceId, TriMesh};
use rayon::prelude::*;

/// Two sheets of the original in one place (thin plates, double walls) face both ways. A triangle is no fold when a sheet that
/// faces as it does lies this much farther away at most than the nearest one, in parts of the diagonal (the judge's figure).
const SHEET_DISTANCE: f64 = 1e-4;

/// The faces of the remeshed surface whose normal opposes that of the original at the point nearest to their middle, in order.
///
/// Faces without area have no normal and do not count here: [`crate::Quality::degenerate`] counts them.
pub fn flipped(original: &Surface, remeshed: &TriMesh) -> Vec<FaceId> {
    let normals = original.mesh.normals();
    let opposes = |f: FaceId| {
        let (normal, middle) = (remeshed.normal(f), remeshed.centroid(f));
        let Some(nearest) = original.index.closest(middle) else { return false };
        let other_sheet = || original.index.closest_where(middle, |g| normals[g].dot(normal) > 0.0);
        let reach = nearest.distance + SHEET_DISTANCE * original.diagonal;
        normals[nearest.face].dot(normal) < 0.0 && other_sheet().is_none_or(|sheet| sheet.distance > reach)
    };
    let faces: Vec<FaceId> = remeshed.faces().ids().collect();
    faces.into_par_iter().filter(|&f| opposes(f)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_shapes::{cube, joined, moved, sphere, square, subdivide, with_face_turned};
    use glam::DVec3;

    fn faces(original: &TriMesh, remeshed: &TriMesh) -> Vec<u32> {
        let flipped = flipped(&Surface::new(original).unwrap(), remeshed);
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
}
