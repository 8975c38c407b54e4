//! Are two triangles surely apart? Cheap answers in plain arithmetic, for the pairs that need no exact ones.
//!
//! Each looks for a plane with one triangle strictly on either side. "Surely" means: by more than all rounding errors. Where the
//! answer is no they may still be apart.

use glam::DVec3;

/// A triangle in space, not degenerate.
pub(crate) type Triangle = [DVec3; 3];

/// Bounds the rounding error of a scalar product of a vector with a difference of positions (4 roundings of 1.1e-16), as a share
/// of the sum of the absolute values of its terms.
const PRODUCT_ERROR: f64 = 1e-15;
/// The same for a product of two cross products of differences (11 roundings).
const CROSS_ERROR: f64 = 4e-15;
/// Products below this may have lost digits by underflow.
const LEAST_PRODUCT: f64 = 1e-100;

/// Triangles without a common corner: along one of the directions in the plane of one of them, across one of its edges.
pub(crate) fn are_apart(t: &Triangle, u: &Triangle) -> bool {
    beyond_an_edge(t, u) || beyond_an_edge(u, t)
}

/// Whether a plane through an edge of `t`, upright on it, has `u` on its far side.
fn beyond_an_edge(t: &Triangle, u: &Triangle) -> bool {
    let [own, other] = [t, u].map(|triangle| triangle.map(|p| p - t[0]));
    let normal = own[1].cross(own[2]);
    let size = other.iter().fold(own[1].abs().max(own[2].abs()), |size, d| size.max(d.abs()));
    [own[1], own[2] - own[1], -own[2]].into_iter().any(|edge| {
        let inwards = normal.cross(edge);
        let error = PRODUCT_ERROR * inwards.abs().dot(size) + LEAST_PRODUCT;
        let along = |d: DVec3| inwards.dot(d);
        let nearest = along(own[1]).min(along(own[2])).min(0.0);
        other.iter().all(|&d| along(d) + 2.0 * error < nearest)
    })
}

/// Triangles with the one common corner `[0]`: a plane through it lies between the other corners.
pub(crate) fn are_apart_beyond_corner(t: &Triangle, u: &Triangle) -> bool {
    let [t, u] = [t, u].map(|triangle| [triangle[1] - triangle[0], triangle[2] - triangle[0]]);
    let middle = |d: [DVec3; 2]| (d[0] + d[1]).normalize_or_zero();
    let across = middle(t) - middle(u);
    let is_ahead = |d: DVec3| across.dot(d) > PRODUCT_ERROR * across.abs().dot(d.abs()) + LEAST_PRODUCT;
    is_ahead(t[0]) && is_ahead(t[1]) && is_ahead(-u[0]) && is_ahead(-u[1])
}

/// Triangles with the common edge from `t[0]` to `t[1]`, of the other one the third corner: the dihedral angle is not 0.
pub(crate) fn are_apart_beyond_edge(t: &Triangle, apex: DVec3) -> bool {
    let [edge, to_own, to_apex] = [t[1], t[2], apex].map(|p| p - t[0]);
    let absolute_cross = |a: DVec3, b: DVec3| {
        let (a, b) = (a.abs(), b.abs());
        DVec3::new(a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x)
    };
    let product = edge.cross(to_own).dot(edge.cross(to_apex));
    let size = absolute_cross(edge, to_own).dot(absolute_cross(edge, to_apex));
    product < -CROSS_ERROR * size && size > LEAST_PRODUCT
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An equilateral triangle of a grid in the plane z = 0, from a corner of the grid, facing up.
    fn in_grid(i: f64, j: f64, upright: bool) -> Triangle {
        let at = |i: f64, j: f64| DVec3::new(i + 0.5 * j, 0.75f64.sqrt() * j, 0.0);
        let [a, b, c, d] = [at(i, j), at(i + 1.0, j), at(i, j + 1.0), at(i + 1.0, j + 1.0)];
        if upright { [a, b, c] } else { [b, d, c] }
    }

    #[test]
    fn all_triangles_of_a_flat_grid_are_told_apart() {
        let t = in_grid(0.0, 0.0, true);
        let places = (-3..=3).flat_map(|i| (-3..=3).map(move |j| (f64::from(i), f64::from(j))));
        let mut told = [0; 3];
        for u in places.flat_map(|(i, j)| [in_grid(i, j, true), in_grid(i, j, false)]) {
            let common: Vec<usize> = (0..3).filter(|&c| u.iter().any(|p| p.distance(t[c]) < 1e-9)).collect();
            let own = |c: usize| u.iter().position(|p| p.distance(t[c]) < 1e-9).unwrap();
            match *common {
                [] => assert!(are_apart(&t, &u), "{u:?}"),
                [c] => {
                    let k = own(c);
                    let turned = [t[c], t[(c + 1) % 3], t[(c + 2) % 3]];
                    assert!(are_apart_beyond_corner(&turned, &[t[c], u[(k + 1) % 3], u[(k + 2) % 3]]), "{u:?}");
                }
                [a, b] => {
                    let apex = 3 - own(a) - own(b);
                    let own_apex = 3 - a - b;
                    assert!(are_apart_beyond_edge(&[t[a], t[b], t[own_apex]], u[apex]), "{u:?}");
                }
                _ => continue,
            }
            told[common.len()] += 1;
        }
        assert_eq!(told, [85, 9, 3]);
    }

    #[test]
    fn what_touches_is_never_told_apart() {
        let t = in_grid(0.0, 0.0, true);
        // From every point of the border of one triangle another one goes outwards.
        for k in 0..=20 {
            let share = f64::from(k) / 20.0;
            for c in 0..3 {
                let on = t[c].lerp(t[(c + 1) % 3], share);
                for out in [DVec3::new(0.3, 0.1, 1.0), DVec3::new(-0.2, 0.4, 0.0), DVec3::new(0.2, -0.4, -1e-9)] {
                    assert!(!are_apart(&t, &[on, on + out, on + out.cross(DVec3::new(0.3, 0.2, 0.9))]), "{c} {share} {out}");
                }
            }
        }
        let [a, b, c] = t;
        assert!(!are_apart_beyond_edge(&t, c) && !are_apart_beyond_edge(&t, a.lerp(c, 2.0)));
        assert!(!are_apart_beyond_corner(&t, &[a, b.lerp(c, 0.5), DVec3::Z]));
        assert!(!are_apart_beyond_corner(&t, &[a, b, DVec3::Z]));
    }
}
