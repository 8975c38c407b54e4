//! Constrained Delaunay triangulation of a patch in its chart. The only file that knows spade.

use glam::DVec2;
use mesh_core::exact::orient2d;
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};

struct Site {
    at: DVec2,
    /// Its place in the caller's list: spade merges equal points, so its own indices may shift.
    index: usize,
}

impl HasPosition for Site {
    type Scalar = f64;
    fn position(&self) -> Point2<f64> {
        Point2::new(self.at.x, self.at.y)
    }
}

/// Polygons are of unit size; a site nearer to a side than about this would make a triangle without area.
const MARGIN: f64 = 1e-9;

/// Triangulates a strictly convex polygon (its corners first in `points`, counter-clockwise) with points inside.
///
/// Returns counter-clockwise triangles as indices into `points`. Points that are not strictly inside, or coincide with another one,
/// are left out. `None` when spade fails or a triangle has no area.
pub(crate) fn triangulate(points: &[DVec2], corners: usize) -> Option<Vec<[usize; 3]>> {
    let sides: Vec<[usize; 2]> = (0..corners).map(|i| [i, (i + 1) % corners]).collect();
    let is_inside = |p: DVec2| sides.iter().all(|&[i, j]| orient2d(points[i], points[j], p) > MARGIN);
    let sites = points
        .iter()
        .enumerate()
        .filter(|&(index, &p)| index < corners || is_inside(p))
        .map(|(index, &at)| Site { at: clear_underflow(at), index })
        .collect();
    let mut crossing = false;
    let cdt = ConstrainedDelaunayTriangulation::<Site>::try_bulk_load_cdt(sites, sides.clone(), |_| crossing = true).ok()?;
    let triangles: Vec<[usize; 3]> = cdt.inner_faces().map(|f| f.vertices().map(|v| v.data().index)).collect();
    let has_side = |s: &[usize; 2]| triangles.iter().any(|t| (0..3).any(|c| t[c] == s[0] && t[(c + 1) % 3] == s[1]));
    let is_flat = |t: &[usize; 3]| orient2d(points[t[0]], points[t[1]], points[t[2]]) <= 0.0;
    let whole = !crossing && sides.iter().all(has_side) && !triangles.iter().any(is_flat);
    whole.then_some(triangles)
}

/// spade refuses coordinates below 2^-142 that are not zero.
fn clear_underflow(p: DVec2) -> DVec2 {
    let p = spade::mitigate_underflow(Point2::new(p.x, p.y));
    DVec2::new(p.x, p.y)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(n: usize) -> Vec<DVec2> {
        (0..n).map(|i| DVec2::from_angle(std::f64::consts::TAU * i as f64 / n as f64)).collect()
    }

    #[test]
    fn counts_follow_from_euler() {
        for corners in 3..12 {
            for inner in 0..5 {
                let mut points = polygon(corners);
                points.extend((0..inner).map(|i| 0.1 * DVec2::from_angle(1.3 * i as f64)));
                let triangles = triangulate(&points, corners).unwrap();
                assert_eq!(triangles.len(), corners + 2 * inner - 2);
            }
        }
    }

    #[test]
    fn equal_sites_are_one() {
        let mut points = polygon(5);
        points.extend([DVec2::splat(0.1), DVec2::splat(0.1)]);
        assert_eq!(triangulate(&points, 5).unwrap().len(), 5);
    }

    #[test]
    fn sites_that_are_not_inside_are_left_out() {
        let mut points = polygon(4);
        points.extend([DVec2::new(2.0, 0.1), points[0].midpoint(points[1])]);
        assert_eq!(triangulate(&points, 4).unwrap().len(), 2);
    }
}
