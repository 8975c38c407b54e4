//! Principal axes of a surface.

use crate::measured::Measured;
use glam::{DMat3, DVec3};

/// Axes whose second moments differ by less than this factor have no direction of their own.
const DISTINCT: f64 = 1.05;
/// Jacobi sweeps; a 3 by 3 matrix is diagonal to rounding after six.
const SWEEPS: usize = 12;

/// The principal axes of a surface by area, `None` where two moments are nearly equal.
pub(crate) fn principal_axes(surface: &Measured) -> Option<[DVec3; 3]> {
    let weighted = || surface.centroids.iter().zip(&surface.areas);
    let centre = weighted().map(|(&c, &a)| a * c).sum::<DVec3>() / surface.total_area;
    let mut covariance = DMat3::ZERO;
    for (&c, &a) in weighted() {
        let d = c - centre;
        covariance += DMat3::from_cols(a * d.x * d, a * d.y * d, a * d.z * d);
    }
    let (moments, axes) = eigen(covariance);
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| moments[j].total_cmp(&moments[i]));
    let distinct = order.windows(2).all(|w| moments[w[0]] > DISTINCT * moments[w[1]]);
    distinct.then(|| order.map(|i| axes.col(i)))
}

/// Eigenvalues and eigenvectors (as columns) of a symmetric matrix, by Jacobi rotations.
fn eigen(mut m: DMat3) -> (DVec3, DMat3) {
    let mut axes = DMat3::IDENTITY;
    for (p, q) in [(0, 1), (0, 2), (1, 2)].into_iter().cycle().take(3 * SWEEPS) {
        let off = m.col(q)[p];
        if off != 0.0 {
            let angle = 0.5 * (2.0 * off).atan2(m.col(q)[q] - m.col(p)[p]);
            let (s, c) = angle.sin_cos();
            let mut turn = DMat3::IDENTITY;
            turn.col_mut(p)[p] = c;
            turn.col_mut(q)[q] = c;
            turn.col_mut(q)[p] = s;
            turn.col_mut(p)[q] = -s;
            m = turn.transpose() * m * turn;
            axes *= turn;
        }
    }
    (DVec3::new(m.x_axis.x, m.y_axis.y, m.z_axis.z), axes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_symmetric_matrix_is_put_together_again() {
        let m = DMat3::from_cols_array(&[4.0, 1.0, -2.0, 1.0, 3.0, 0.5, -2.0, 0.5, 1.0]);
        let (values, axes) = eigen(m);
        let again = axes * DMat3::from_diagonal(values) * axes.transpose();
        assert!((0..3).all(|i| again.col(i).distance(m.col(i)) < 1e-13));
        assert!((axes.transpose() * axes - DMat3::IDENTITY).to_cols_array().iter().all(|x| x.abs() < 1e-13));
    }
}
