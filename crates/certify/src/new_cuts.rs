//! Where does a remeshed surface cut itself that did not before?
//!
//! It does so wherever its original does, in triangles of its own: their number says nothing. What is new are cuts away from the curves along which
//! the original cuts itself.

use crate::intersections::self_intersecting;
use crate::own_cuts::SIZE;
use crate::reference::Reference;
use mesh_core::{FaceId, TriMesh};

/// The faces of a remeshed surface that intersect others where the original does not cut itself, in rising order: farther from there than their
/// own longest edge and half a percent of the diagonal, for the size of the pieces and for how far the surfaces are apart.
pub fn new_cuts(original: &Reference, remeshed: &TriMesh) -> Vec<FaceId> {
    away_from_own(original, remeshed, &self_intersecting(remeshed))
}

/// The same of the faces of a remeshed surface that intersect others.
pub(crate) fn away_from_own(original: &Reference, remeshed: &TriMesh, cutting: &[FaceId]) -> Vec<FaceId> {
    if cutting.is_empty() || original.self_intersecting().is_empty() {
        return cutting.to_vec();
    }
    let own = original.own_cuts();
    let reach = |f: FaceId| {
        let [a, b, c] = remeshed.triangle(f);
        a.distance(b).max(b.distance(c)).max(c.distance(a)) + 2.0 * SIZE * original.diagonal()
    };
    let is_new = |f: &FaceId| own.closest_within(remeshed.centroid(*f), reach(*f)).is_none();
    cutting.iter().copied().filter(is_new).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_shapes::{crossing_cubes, cube, joined, moved, sphere, square, subdivide};
    use glam::DVec3;

    /// Split finer, the cubes cut each other in more triangles, none of which is new; where a third body enters a side, all are.
    #[test]
    fn only_cuts_elsewhere_are_new() {
        let original = Reference::new(crossing_cubes()).unwrap();
        let fine = subdivide(&subdivide(&crossing_cubes()));
        assert!(self_intersecting(&fine).len() > original.self_intersecting().len());
        assert_eq!(new_cuts(&original, &fine), []);
        let ball = moved(&sphere(1), |p| 0.02 * p + DVec3::new(0.2, 0.2, 0.0));
        let new = new_cuts(&original, &joined(&subdivide(&subdivide(&fine)), &ball));
        assert!(!new.is_empty() && new.len() < 80);
        let whole = Reference::new(cube()).unwrap();
        assert_eq!(new_cuts(&whole, &crossing_cubes()), self_intersecting(&crossing_cubes()));
    }

    /// Squares that touch along a line of the one, at places that rounding parts, keep that line as their own.
    #[test]
    fn what_touches_may_touch() {
        let turn = glam::DMat3::from_rotation_x(0.3) * glam::DMat3::from_rotation_z(0.7);
        let wall = moved(&square(), |p| DVec3::new(0.1 + 0.7 * p.x, 1.0 / 3.0, p.y));
        let both = moved(&joined(&square(), &wall), |p| turn * p);
        let original = Reference::new(both.clone()).unwrap();
        let fine = subdivide(&subdivide(&both));
        assert_eq!(new_cuts(&original, &fine), []);
    }
}
