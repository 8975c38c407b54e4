//! The paper's quadric relaxation (section 4.3, eqs. 7 to 9), corrected.
//!
//! Every vertex goes to the least of `lambda D(x, plane)^2 + |x - c|^2`: the squared distance to the tangent plane at its old
//! place, and to the weighted centroid `c` of its neighbours. With a unit normal the solution `-A^-1 b` (the paper's print has
//! lost the sign) is closed: of the way to the centroid the part along the normal is divided by `1 + lambda`.

use crate::QuadricOptions;
use crate::measured::Measured;
use crate::movable_domain::MovableDomain;
use crate::placement::Placement;
use crate::quality::Quality;
use glam::DVec3;
use mesh_core::{IdVec, VertexId};

/// A gain in the mean AR below this counts as none. Less lets the relaxation go on for longer.
pub(crate) const LEAST_GAIN: f64 = 1e-4;
/// This many iterations in a row without a gain end the relaxation. More lets it get over a standstill, and costs time.
pub(crate) const MOST_IDLE: usize = 3;

/// Relaxes until the target quality, no gain or the cap. Returns the best placement met and the number of iterations.
///
/// `weights` are those of the vertices in the centroids of their neighbours.
pub(crate) fn relax_quadric(
    domain: &MovableDomain,
    start: Measured,
    weights: &IdVec<VertexId, f64>,
    options: &QuadricOptions,
) -> (Measured, usize) {
    let (mut best, mut best_quality) = (start.clone(), Quality::of(&start, domain));
    let (mut now, mut idle, mut iterations) = (start, 0, 0);
    while iterations < options.iterations && idle < MOST_IDLE && best_quality.ar_mean < options.target_quality {
        if domain.is_interrupted() {
            break;
        }
        let step = |v: VertexId| quadric_step(domain, now.placement(), weights, options.plane_weight, v);
        let mut next = Measured::new(domain, now.placement().displaced(domain, step));
        next.hold_upright(domain, &now);
        now = next;
        iterations += 1;
        let quality = Quality::of(&now, domain);
        let gains = quality.inverted < best_quality.inverted || quality.ar_mean > best_quality.ar_mean + LEAST_GAIN;
        idle = if gains { 0 } else { idle + 1 };
        if quality.is_better_than(&best_quality) {
            (best, best_quality) = (now.clone(), quality);
        }
    }
    (best, iterations)
}

/// The way of vertex `v` to the minimum of eq. 7.
fn quadric_step(
    domain: &MovableDomain,
    placement: &Placement,
    weights: &IdVec<VertexId, f64>,
    plane_weight: f64,
    v: VertexId,
) -> DVec3 {
    let (mut sum, mut total) = (DVec3::ZERO, 0.0);
    for w in domain.topology.one_ring(v) {
        sum += weights[w] * placement[w].position;
        total += weights[w];
    }
    if total <= 0.0 {
        return DVec3::ZERO;
    }
    let to_centroid = sum / total - placement[v].position;
    let normal = (placement[v].normals[0] + placement[v].normals[1]).normalize_or_zero();
    plane_centroid_minimiser(normal, plane_weight, to_centroid)
}

/// The minimiser of `lambda (n.x)^2 + |x - c|^2` for a unit normal (or 0): `-A^-1 b` with `A = lambda n n^T + I`, `b = -c`.
pub(crate) fn plane_centroid_minimiser(n: DVec3, lambda: f64, c: DVec3) -> DVec3 {
    c - lambda / (1.0 + lambda) * n.dot(c) * n
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat3;

    #[test]
    fn the_closed_form_solves_the_paper_s_system() {
        let (n, c) = (DVec3::new(1.0, -2.0, 0.5).normalize(), DVec3::new(0.3, 0.7, -1.1));
        for lambda in [0.0, 1.0, 7.5] {
            let a = DMat3::from_cols(n.x * n, n.y * n, n.z * n) * lambda + DMat3::IDENTITY;
            assert!(plane_centroid_minimiser(n, lambda, c).distance(a.inverse() * c) < 1e-14);
        }
    }
}
