//! Points spread evenly over surfaces and lines, the same ones on every run.

use glam::DVec3;
use mesh_core::{FaceId, Id, TriMesh};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Seed of all samples: a measure of the same mesh must not change from run to run.
const SEED: u64 = 7;

/// `n` points by area. None on a mesh without area.
pub(crate) fn on_faces(mesh: &TriMesh, n: usize) -> Vec<DVec3> {
    let mut rng = Pcg64Mcg::seed_from_u64(SEED);
    let picked = stratified(mesh.areas().as_slice(), n, &mut rng);
    let mut point = |(face, fraction): (usize, f64)| {
        // Uniform in a triangle: Osada et al., Shape distributions, 2002, section 4.1.
        let [a, b, c] = mesh.triangle(FaceId::new(face));
        let (s, t) = (fraction.sqrt(), rng.random::<f64>());
        (1.0 - s) * a + s * (1.0 - t) * b + s * t * c
    };
    picked.into_iter().map(&mut point).collect()
}

/// `n` points by length. None where all segments have length 0.
pub(crate) fn on_segments(segments: &[[DVec3; 2]], n: usize) -> Vec<DVec3> {
    let lengths: Vec<f64> = segments.iter().map(|[a, b]| a.distance(*b)).collect();
    let mut rng = Pcg64Mcg::seed_from_u64(SEED);
    let picked = stratified(&lengths, n, &mut rng);
    picked.into_iter().map(|(i, fraction)| segments[i][0].lerp(segments[i][1], fraction)).collect()
}

/// Lays the weights end to end, draws one point in each of `n` equal parts of the whole, and gives for each the index of the
/// weight that it falls into and how far along that it lies (0..1).
fn stratified(weights: &[f64], n: usize, rng: &mut Pcg64Mcg) -> Vec<(usize, f64)> {
    let total: f64 = weights.iter().sum();
    if !(total > 0.0 && total.is_finite()) {
        return Vec::new();
    }
    let mut picked = Vec::with_capacity(n);
    let (mut i, mut before) = (0, 0.0);
    for k in 0..n {
        let goal = (k as f64 + rng.random::<f64>()) / n as f64 * total;
        while before + weights[i] <= goal && i + 1 < weights.len() {
            before += weights[i];
            i += 1;
        }
        // Rounding of the sums can carry the last point past the end, where the last weight may be 0.
        let fraction = if weights[i] > 0.0 { ((goal - before) / weights[i]).clamp(0.0, 1.0) } else { 0.0 };
        picked.push((i, fraction));
    }
    picked
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_shapes::mesh;

    #[test]
    fn every_weight_gets_its_share() {
        let mut rng = Pcg64Mcg::seed_from_u64(1);
        let picked = stratified(&[0.0, 1.0, 0.0, 3.0], 400, &mut rng);
        let times = |i| picked.iter().filter(|p| p.0 == i).count();
        assert_eq!([times(0), times(1), times(2), times(3)], [0, 100, 0, 300]);
        for (k, (_, fraction)) in picked[..100].iter().enumerate() {
            assert!((fraction * 100.0 - k as f64 - 0.5).abs() <= 0.5, "one in each part");
        }
    }

    #[test]
    fn points_are_uniform_in_a_triangle() {
        let triangle = mesh(&[[0., 0., 0.], [3., 0., 0.], [0., 3., 0.]], &[[0, 1, 2]]);
        let points = on_faces(&triangle, 40_000);
        let mean = points.iter().sum::<DVec3>() / 40_000.0;
        assert!(mean.distance(DVec3::new(1.0, 1.0, 0.0)) < 0.01);
        let in_tip = points.iter().filter(|p| p.x > 2.0).count() as f64 / 40_000.0;
        assert!((in_tip - 1.0 / 9.0).abs() < 0.005);
    }

    #[test]
    fn nothing_to_sample_gives_nothing() {
        assert!(on_segments(&[[DVec3::X, DVec3::X]], 10).is_empty());
        assert!(on_segments(&[], 10).is_empty());
    }
}
