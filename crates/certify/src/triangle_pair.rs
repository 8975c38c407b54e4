//! Do two triangles meet? Exact answers, by the signs of mesh-core's exact predicates.
//!
//! Everything is closed: touching is meeting. Two triangles without a common corner meet where an edge of one meets the other.

use crate::apart::{Triangle, are_apart, are_apart_beyond_corner, are_apart_beyond_edge};
use glam::{DVec2, DVec3};
use mesh_core::exact::{orient2d, orient3d};
use std::cmp::Ordering::{self, Equal, Greater, Less};

/// On which side of a plane a point lies, `Equal` on it.
fn side3([a, b, c]: Triangle, p: DVec3) -> Ordering {
    sign(orient3d(a, b, c, p))
}

/// On which side of a line a point lies, `Equal` on it.
fn side2([a, b]: [DVec2; 2], p: DVec2) -> Ordering {
    sign(orient2d(a, b, p))
}

fn sign(determinant: f64) -> Ordering {
    determinant.partial_cmp(&0.0).unwrap_or(Equal)
}

/// Without one coordinate.
fn drop_axis(p: DVec3, axis: usize) -> DVec2 {
    DVec2::new(p[(axis + 1) % 3], p[(axis + 2) % 3])
}

/// A coordinate that can be dropped from a triangle without making it degenerate, `None` for a degenerate one.
fn free_axis(t: Triangle) -> Option<usize> {
    (0..3).find(|&axis| {
        let [a, b, c] = t.map(|p| drop_axis(p, axis));
        side2([a, b], c) != Equal
    })
}

/// Whether two triangles meet that have no corner in common.
pub(crate) fn triangles_meet(t: Triangle, u: Triangle) -> bool {
    // Most pairs are settled by a plane that has one triangle on its one side.
    let apart = |t: Triangle, u: Triangle| {
        let sides = u.map(|p| side3(t, p));
        sides[0] != Equal && sides.iter().all(|&s| s == sides[0])
    };
    let edge_meets = |t: Triangle, u: Triangle| (0..3).any(|c| segment_meets([t[c], t[(c + 1) % 3]], u));
    !are_apart(&t, &u) && !apart(t, u) && !apart(u, t) && (edge_meets(t, u) || edge_meets(u, t))
}

/// Whether two triangles with the one common corner `[0]` meet elsewhere: the common line leaves one of them through the edge
/// opposite of the corner.
pub(crate) fn meet_beyond_corner(t: Triangle, u: Triangle) -> bool {
    !are_apart_beyond_corner(&t, &u) && (segment_meets([t[1], t[2]], u) || segment_meets([u[1], u[2]], t))
}

/// Whether two triangles with the common edge from `t[0]` to `t[1]` meet beyond it: `apex`, the other triangle's third corner,
/// lies in the plane of `t` and on the same side of the edge.
pub(crate) fn meet_beyond_edge(t: Triangle, apex: DVec3) -> bool {
    if are_apart_beyond_edge(&t, apex) {
        return false;
    }
    let Some(axis) = free_axis(t) else { return false };
    let [a, b, c, apex2] = [t[0], t[1], t[2], apex].map(|p| drop_axis(p, axis));
    side3(t, apex) == Equal && side2([a, b], apex2) == side2([a, b], c)
}

/// Whether a segment and a triangle meet.
fn segment_meets([p, q]: [DVec3; 2], t: Triangle) -> bool {
    let (side_p, side_q) = (side3(t, p), side3(t, q));
    if side_p == Equal && side_q == Equal {
        return coplanar_segment_meets([p, q], t);
    }
    if side_p == side_q {
        return false;
    }
    // The line through p and q crosses the plane in one point, inside where it passes all edges on one side.
    one_sided([0, 1, 2].map(|c| side3([p, q, t[c]], t[(c + 1) % 3])))
}

/// Whether a segment and a triangle in one plane meet.
fn coplanar_segment_meets(segment: [DVec3; 2], t: Triangle) -> bool {
    let Some(axis) = free_axis(t) else { return false };
    let [p, q] = segment.map(|p| drop_axis(p, axis));
    let t = t.map(|p| drop_axis(p, axis));
    let inside = |p: DVec2| one_sided([0, 1, 2].map(|c| side2([t[c], t[(c + 1) % 3]], p)));
    inside(p) || (0..3).any(|c| segments_cross([p, q], [t[c], t[(c + 1) % 3]]))
}

/// Whether two segments of a plane meet that are not on one line.
///
/// A segment on the line of a triangle's edge needs no more: it ends inside, or it crosses the next edge at the corner.
fn segments_cross([p, q]: [DVec2; 2], [a, b]: [DVec2; 2]) -> bool {
    side2([p, q], a) != side2([p, q], b) && side2([a, b], p) != side2([a, b], q)
}

/// Whether no two are strictly on different sides.
fn one_sided(sides: [Ordering; 3]) -> bool {
    !(sides.contains(&Less) && sides.contains(&Greater))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    const FLAT: Triangle = [DVec3::ZERO, DVec3::new(4.0, 0.0, 0.0), DVec3::new(0.0, 4.0, 0.0)];

    fn segment(p: [f64; 3], q: [f64; 3]) -> bool {
        segment_meets([p.into(), q.into()], FLAT)
    }

    #[test]
    fn segments_across_a_triangle() {
        assert!(segment([1.0, 1.0, -1.0], [1.0, 1.0, 1.0]));
        assert!(segment([1.0, 1.0, 0.0], [1.0, 1.0, 1.0]), "ends on it");
        assert!(segment([2.0, 2.0, -1.0], [2.0, 2.0, 1.0]), "through its edge");
        assert!(segment([0.0, 0.0, -1.0], [0.0, 0.0, 1.0]), "through its corner");
        assert!(!segment([1.0, 1.0, 1e-300], [1.0, 1.0, 1.0]), "just above");
        assert!(!segment([3.0, 3.0, -1.0], [3.0, 3.0, 1.0]), "beside it");
        assert!(!segment([5.0, 0.0, 0.0], [5.0, 0.0, 1.0]), "ends in its plane");
    }

    #[test]
    fn segments_in_the_plane_of_a_triangle() {
        assert!(segment([1.0, 1.0, 0.0], [1.5, 1.0, 0.0]), "inside");
        assert!(segment([-1.0, 1.0, 0.0], [9.0, 1.0, 0.0]), "right through");
        assert!(segment([-1.0, 0.0, 0.0], [9.0, 0.0, 0.0]), "over a whole edge");
        assert!(segment([-1.0, 1.0, 0.0], [1.0, -1.0, 0.0]), "touches a corner");
        assert!(!segment([5.0, 0.0, 0.0], [9.0, 0.0, 0.0]), "on the line of an edge");
        assert!(!segment([3.0, 3.0, 0.0], [5.0, 1.0, 0.0]));
    }

    #[test]
    fn triangles_with_common_corners() {
        let p = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
        assert!(!meet_beyond_edge(FLAT, p(1.0, -1.0, 0.0)), "unfolded");
        assert!(meet_beyond_edge(FLAT, p(1.0, 1.0, 0.0)), "folded over");
        assert!(!meet_beyond_edge(FLAT, p(1.0, 1.0, 1e-300)), "nearly folded over");
        assert!(!meet_beyond_corner(FLAT, [FLAT[0], p(-1.0, 0.0, 0.0), p(0.0, -1.0, 1.0)]));
        assert!(meet_beyond_corner(FLAT, [FLAT[0], p(1.0, 1.0, 1.0), p(1.0, 1.0, -1.0)]), "stands on it");
        assert!(meet_beyond_corner(FLAT, [FLAT[0], p(8.0, 8.0, 0.0), p(9.0, 0.0, 1.0)]), "an edge lies in it");
        assert!(meet_beyond_corner([FLAT[0], p(1.0, 0.0, 0.0), p(0.0, 1.0, 0.0)], FLAT), "the smaller lies in the larger");
    }

    #[test]
    fn triangles_without_common_corners() {
        let up = |t: Triangle, z: f64| t.map(|p| p + DVec3::new(0.5, 0.5, z));
        assert!(triangles_meet(FLAT, up(FLAT, 0.0)));
        assert!(!triangles_meet(FLAT, up(FLAT, 1e-9)));
        let inner = FLAT.map(|p| 0.1 * p + DVec3::new(0.5, 0.5, 0.0));
        assert!(triangles_meet(FLAT, inner) && triangles_meet(inner, FLAT));
    }

    /// Separating axes on integers: exact, and by another method.
    fn separated(t: [[i64; 3]; 3], u: [[i64; 3]; 3]) -> bool {
        let cross =
            |a: [i64; 3], b: [i64; 3]| [0, 1, 2].map(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
        let dot = |a: [i64; 3], b: [i64; 3]| (0..3).map(|i| a[i] * b[i]).sum::<i64>();
        let edges = |t: [[i64; 3]; 3]| [0, 1, 2].map(|c| [0, 1, 2].map(|i| t[(c + 1) % 3][i] - t[c][i]));
        let (e, f) = (edges(t), edges(u));
        let normals = [cross(e[0], e[1]), cross(f[0], f[1])];
        let mut axes = normals.to_vec();
        axes.extend(e.iter().flat_map(|&a| f.map(|b| cross(a, b))));
        axes.extend(e.iter().chain(&f).flat_map(|&a| normals.map(|n| cross(a, n))));
        axes.into_iter().any(|axis| {
            let [a, b] = [t, u].map(|t| t.map(|p| dot(p, axis)));
            a.iter().max() < b.iter().min() || b.iter().max() < a.iter().min()
        })
    }

    #[test]
    fn small_integer_triangles_as_by_separating_axes() {
        let mut rng = Pcg64Mcg::seed_from_u64(3);
        let mut meeting = 0;
        for _ in 0..20_000 {
            let [t, u] = [(); 2].map(|()| [[(); 3]; 3].map(|p| p.map(|()| rng.random_range(0..4i64))));
            let [ft, fu] = [t, u].map(|t| t.map(|p| DVec3::from_array(p.map(|x| x as f64))));
            if free_axis(ft).is_none() || free_axis(fu).is_none() {
                continue;
            }
            assert_eq!(triangles_meet(ft, fu), !separated(t, u), "{t:?} {u:?}");
            meeting += usize::from(!separated(t, u));
        }
        assert!(meeting > 5_000, "{meeting}");
    }
}
