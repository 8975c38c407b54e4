//! Where a remeshed surface and the original are far apart.

use crate::reference::Reference;
use glam::DVec3;
use mesh_core::{FaceId, SurfaceIndex, TriMesh};
use rayon::prelude::*;

/// Where a remeshed surface and the original are farther apart than is accepted.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Missed {
    /// The faces of the remeshed surface that are too far from the original at their middle or that of an edge, and those that are nearest to
    /// a vertex of the original which is too far from them. In rising order.
    pub faces: Vec<FaceId>,
    /// The greatest of these distances, in the units of the meshes; 0 without any.
    pub greatest: f64,
}

/// Where a remeshed surface and the original are farther apart than `most`, a length in the units of the meshes.
pub fn missed(original: &Reference, remeshed: &TriMesh, most: f64) -> Missed {
    let far = |index: &SurfaceIndex, point: DVec3| match index.closest_within(point, most) {
        Some(_) => None,
        None => index.closest(point),
    };
    let strays = |f: FaceId| {
        let [a, b, c] = remeshed.triangle(f);
        let points = [(a + b + c) / 3.0, a.midpoint(b), b.midpoint(c), c.midpoint(a)];
        let distances = points.into_iter().filter_map(|p| Some(far(original.index(), p)?.distance));
        distances.reduce(f64::max).map(|distance| (f, distance))
    };
    let index = SurfaceIndex::new(remeshed);
    let is_left_out = |&p: &DVec3| far(&index, p).map(|closest| (closest.face, closest.distance));
    let faces: Vec<FaceId> = remeshed.faces().ids().collect();
    let mut missed: Vec<(FaceId, f64)> = faces.into_par_iter().filter_map(strays).collect();
    missed.par_extend(original.vertices().par_iter().filter_map(is_left_out));
    let greatest = missed.iter().map(|m| m.1).fold(0.0, f64::max);
    let mut faces: Vec<FaceId> = missed.into_iter().map(|m| m.0).collect();
    faces.sort_unstable();
    faces.dedup();
    Missed { faces, greatest }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_shapes::{moved, sphere, square, subdivide};

    #[test]
    fn a_bump_is_missed_by_the_faces_below_it() {
        let flat = square();
        let fine = subdivide(&subdivide(&flat));
        let bumpy = moved(&fine, |p| if p.truncate().distance(glam::DVec2::splat(0.5)) < 0.1 { p + 0.3 * DVec3::Z } else { p });
        let (flat_reference, bumpy_reference) = (Reference::new(fine.clone()).unwrap(), Reference::new(bumpy.clone()).unwrap());
        assert_eq!(missed(&flat_reference, &flat, 0.01), Missed::default());
        let Missed { faces: below, greatest } = missed(&bumpy_reference, &fine, 0.2);
        assert!((greatest - 0.3).abs() < 1e-12, "{greatest}");
        let touches = |f: &FaceId| fine.triangle(*f).iter().any(|p| p.truncate().distance(glam::DVec2::splat(0.5)) < 0.1);
        assert!(!below.is_empty() && below.iter().all(touches));
        // The other way the faces of the bump are far.
        let on_bump = missed(&flat_reference, &bumpy, 0.05).faces;
        assert_eq!(on_bump.len(), bumpy.faces().ids().filter(touches).count());
    }

    #[test]
    fn a_sphere_within_another_is_missed_everywhere() {
        let inner = sphere(2);
        let outer = Reference::new(moved(&inner, |p| 1.1 * p)).unwrap();
        assert_eq!(missed(&outer, &inner, 0.05).faces.len(), inner.n_faces());
        assert!(missed(&outer, &inner, 0.2).faces.is_empty());
    }
}
