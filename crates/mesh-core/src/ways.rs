//! [`ways_around`]: where a vertex may be tried without derivatives.

use glam::DVec3;
use std::f64::consts::TAU;

/// Displacements of a vertex, given those to its neighbours: to their middle first, then in so many directions across `up` as far as each of `reaches`,
/// shares of the mean distance of the neighbours.
pub fn ways_around(to_neighbours: &[DVec3], up: DVec3, directions: usize, reaches: &[f64]) -> Vec<DVec3> {
    let n = to_neighbours.len().max(1) as f64;
    let reach = to_neighbours.iter().map(|way| way.length()).sum::<f64>() / n;
    let (x, y) = up.try_normalize().unwrap_or(DVec3::Z).any_orthonormal_pair();
    let direction = |i: usize| {
        let (sin, cos) = (i as f64 * TAU / directions as f64).sin_cos();
        cos * x + sin * y
    };
    let around = reaches.iter().flat_map(|share| (0..directions).map(move |i| *share * reach * direction(i)));
    std::iter::once(to_neighbours.iter().sum::<DVec3>() / n).chain(around).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ways_lead_to_the_middle_and_all_around() {
        let ways = ways_around(&[3.0 * DVec3::X, DVec3::Y], 2.0 * DVec3::Z, 4, &[0.5, 1.0]);
        assert_eq!(ways[0], DVec3::new(1.5, 0.5, 0.0));
        let lengths: Vec<f64> = ways[1..].iter().map(|way| way.length()).collect();
        assert!(lengths.iter().zip([1.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 2.0]).all(|(l, wanted)| (l - wanted).abs() < 1e-12));
        assert!(ways[1..].iter().all(|way| way.z == 0.0) && ways[1..].iter().sum::<DVec3>().length() < 1e-12);
        assert_eq!(ways_around(&[], DVec3::ZERO, 4, &[1.0]), [DVec3::ZERO; 5]);
    }
}
