//! The verb of this crate.

use crate::Vector;
use rayon::prelude::*;

/// Unknowns that one task works on. Sums are taken block by block and then in order, so that they don't depend on the number of threads.
const BLOCK: usize = 2048;

/// Solves `A x = right` for a symmetric positive `A`, from `x = 0`.
///
/// `row(x, i)` is row `i` of `A x`. `precondition(r, i)` is about what `x[i]` has to change by when its equation lacks `r`: `r` times the
/// inverse of a positive block on the diagonal of `A`, or `r` itself.
///
/// Stops when the residual, in the metric of the preconditioner, has fallen to the share `tolerance` of the first one, or after `most`
/// iterations with what it has then. Where `A` turns out not to be positive, or something is not finite, it stops as well. Unknowns without
/// an equation (0 in the row, the column and `right`) stay 0 if their preconditioned residual is 0.
pub fn solve<V: Vector>(
    right: Vec<V>,
    row: impl Fn(&[V], usize) -> V + Sync,
    precondition: impl Fn(V, usize) -> V + Sync,
    tolerance: f64,
    most: usize,
) -> Vec<V> {
    let n = right.len();
    let mut x = vec![V::ZERO; n];
    let mut residual = right;
    let mut direction = each(n, |i| precondition(residual[i], i));
    let mut rho = dot(&residual, &direction);
    let goal = rho * tolerance * tolerance;
    for _ in 0..most {
        if rho <= goal {
            break;
        }
        let image = each(n, |i| row(&direction, i));
        let curvature = dot(&direction, &image);
        if curvature.is_nan() || curvature <= 0.0 {
            break;
        }
        let step = rho / curvature;
        change(&mut x, |x, i| *x += direction[i] * step);
        change(&mut residual, |r, i| *r += image[i] * -step);
        let z = each(n, |i| precondition(residual[i], i));
        let next = dot(&residual, &z);
        let turn = next / rho;
        change(&mut direction, |d, i| *d = z[i] + *d * turn);
        rho = next;
    }
    x
}

fn each<V: Send>(n: usize, value: impl Fn(usize) -> V + Sync) -> Vec<V> {
    (0..n).into_par_iter().with_min_len(BLOCK).map(&value).collect()
}

fn change<V: Send>(values: &mut [V], change: impl Fn(&mut V, usize) + Sync) {
    values.par_iter_mut().with_min_len(BLOCK).enumerate().for_each(|(i, value)| change(value, i));
}

fn dot<V: Vector>(x: &[V], y: &[V]) -> f64 {
    let blocks = x.par_chunks(BLOCK).zip(y.par_chunks(BLOCK));
    let sums: Vec<f64> = blocks.map(|(x, y)| x.iter().zip(y).map(|(&x, &y)| x.dot(y)).sum()).collect();
    sums.into_iter().sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DMat2, DVec2, DVec3};

    /// A chain whose ends are held: 2 on the diagonal, -1 beside it.
    fn chain<V: Vector>(x: &[V], i: usize) -> V {
        let at = |i: usize| x.get(i).copied().unwrap_or(V::ZERO);
        x[i] * 2.0 + (at(i.wrapping_sub(1)) + at(i + 1)) * -1.0
    }

    /// Two blocks that are not the identity, coupled; the solution by hand from `A (x, y) = (right)`.
    #[test]
    fn a_small_system() {
        let (own, coupling) = (DMat2::from_cols_array(&[4.0, 1.0, 1.0, 3.0]), DMat2::from_cols_array(&[0.0, 1.0, 0.5, 0.0]));
        let row = |x: &[DVec2], i: usize| own * x[i] + if i == 0 { coupling * x[1] } else { coupling.transpose() * x[0] };
        let wanted = [DVec2::new(1.0, -2.0), DVec2::new(0.5, 3.0)];
        let right = vec![row(&wanted, 0), row(&wanted, 1)];
        // (4 - 2 + 1.5, 1 - 6 + 0.5).
        assert_eq!(right[0], DVec2::new(3.5, -4.5));
        let found = solve(right, row, |r, _| own.inverse() * r, 1e-14, 10);
        assert!(found.iter().zip(wanted).all(|(a, b)| a.distance(b) < 1e-12), "{found:?}");
    }

    /// With the inverse of the matrix as preconditioner one iteration is enough.
    #[test]
    fn a_perfect_preconditioner_takes_one_iteration() {
        let right: Vec<DVec3> = (0..5).map(|i| DVec3::new(1.0, i as f64, -2.0)).collect();
        let stiffness = |i: usize| 1.0 + i as f64;
        let found = solve(right.clone(), |x, i| x[i] * stiffness(i), |r, i| r / stiffness(i), 1e-12, 1);
        assert!((0..5).all(|i| found[i].distance(right[i] / stiffness(i)) < 1e-14), "{found:?}");
    }

    /// Three different stiffnesses take three iterations: two leave a residual, and come back with it.
    #[test]
    fn stops_at_the_most_iterations() {
        let row = |x: &[f64], i: usize| x[i] * (1.0 + i as f64);
        let lacking = |most| {
            let found = solve(vec![1.0; 3], row, |r, _| r, 1e-12, most);
            (0..3).map(|i| (1.0 - row(&found, i)).abs()).fold(0.0, f64::max)
        };
        assert_eq!(lacking(0), 1.0);
        assert!(lacking(2) > 1e-3 && lacking(3) < 1e-12, "{} {}", lacking(2), lacking(3));
    }

    /// A tolerance of a half stops once the residual has halved, and no sooner.
    #[test]
    fn stops_at_the_tolerance() {
        let right: Vec<f64> = (0..50).map(|i| (i as f64).sin()).collect();
        let size = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
        let left = |most: usize| {
            let found = solve(right.clone(), chain, |r, _| r, 0.5, most);
            size(&(0..50).map(|i| right[i] - chain(&found, i)).collect::<Vec<_>>()) / size(&right)
        };
        let first = (0..50).find(|&most| left(most) <= 0.5).unwrap();
        assert!(first > 0);
        assert_eq!(left(first), left(100));
    }

    #[test]
    fn nothing_is_solved_by_nothing() {
        assert_eq!(solve(vec![DVec3::ZERO; 4], chain, |r, _| r, 1e-9, 10), [DVec3::ZERO; 4]);
        assert_eq!(solve(vec![], chain::<f64>, |r, _| r, 1e-9, 10), []);
    }

    /// A matrix that is not positive is left where its first wrong direction shows; what is not finite ends it too.
    #[test]
    fn stops_where_the_matrix_is_not_positive() {
        assert_eq!(solve(vec![1.0; 3], |x, i| -x[i], |r, _| r, 1e-9, 10), [0.0; 3]);
        assert_eq!(solve(vec![f64::NAN; 3], |x, i| x[i], |r, _| r, 1e-9, 10), [0.0; 3]);
    }

    /// The second unknown, and the second coordinate of all, have no equation.
    #[test]
    fn unknowns_without_an_equation_stay_0() {
        let only_x = |i: usize| if i == 1 { DVec2::ZERO } else { DVec2::X };
        let row = |x: &[DVec2], i: usize| only_x(i) * 4.0 * x[i];
        let found = solve(vec![DVec2::X, DVec2::ZERO, DVec2::X], row, |r, i| r * only_x(i), 1e-12, 10);
        assert_eq!(found, [DVec2::new(0.25, 0.0), DVec2::ZERO, DVec2::new(0.25, 0.0)]);
    }

    #[test]
    fn any_number_of_threads_gives_the_same_bytes() {
        let right: Vec<DVec3> = (0..5 * BLOCK + 7).map(|i| DVec3::new((i as f64).sin(), 1.0 / (1 + i) as f64, 0.1)).collect();
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| solve(right.clone(), chain, |r, _| r * 0.5, 1e-6, 30))
        };
        let bits = |x: Vec<DVec3>| x.iter().flat_map(|x| x.to_array().map(f64::to_bits)).collect::<Vec<_>>();
        let one = bits(on(1));
        assert!(one == bits(on(2)) && one == bits(on(3)));
    }
}
