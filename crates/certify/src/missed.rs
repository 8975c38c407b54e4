//! Where a remeshed surface and the original are far apart.

use crate::reference::Reference;
use glam::DVec3;
use mesh_core::{FaceId, SurfaceIndex, TriMesh};
use rayon::prelude::*;

/// A face is looked at in more places where it is farther than this share of what is accepted in one of the first four: the farthest place is seldom
/// among them. More misses some of those that are too far, less takes longer.
const SUSPECT: f64 = 0.8;
/// Then in the points of a grid that divides its edges into so many parts.
const PARTS: u32 = 6;

/// Where a remeshed surface and the original are farther apart than is accepted.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Missed {
    /// The faces of the remeshed surface that are too far from the original somewhere, and those that are nearest to a vertex of the original which is
    /// too far from them. In rising order.
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
        let first = [(a + b + c) / 3.0, a.midpoint(b), b.midpoint(c), c.midpoint(a)];
        if first.into_iter().all(|p| original.index().closest_within(p, SUSPECT * most).is_some()) {
            return None;
        }
        let distances = first.into_iter().chain(grid([a, b, c])).filter_map(|p| Some(far(original.index(), p)?.distance));
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

/// The points of a grid on a triangle.
fn grid([a, b, c]: [DVec3; 3]) -> impl Iterator<Item = DVec3> {
    let share = |i: u32| f64::from(i) / f64::from(PARTS);
    let at = move |i: u32, j: u32| a + share(i) * (b - a) + share(j) * (c - a);
    (0..=PARTS).flat_map(move |i| (0..=PARTS - i).map(move |j| at(i, j)))
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

    /// The corner of a triangle that stands up: at the middles of its edges it is half as far off.
    #[test]
    fn the_farthest_place_of_a_face_is_found() {
        let flat = subdivide(&square());
        let corner = flat.position(flat.face(FaceId(0))[0]);
        let raised = moved(&flat, |p| if p == corner { p + 0.1 * DVec3::Z } else { p });
        let Missed { faces, greatest } = missed(&Reference::new(flat).unwrap(), &raised, 0.055);
        assert!(faces.contains(&FaceId(0)) && (greatest - 0.1).abs() < 1e-12, "{faces:?} {greatest}");
    }

    #[test]
    fn a_sphere_within_another_is_missed_everywhere() {
        let inner = sphere(2);
        let outer = Reference::new(moved(&inner, |p| 1.1 * p)).unwrap();
        assert_eq!(missed(&outer, &inner, 0.05).faces.len(), inner.n_faces());
        assert!(missed(&outer, &inner, 0.2).faces.is_empty());
    }
}
