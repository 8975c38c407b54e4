//! Distance between two surfaces, METRO style: Cignoni, Rocchini, Scopigno, *Metro: measuring error on simplified surfaces*,
//! Computer Graphics Forum 1998.

use glam::DVec3;
use mesh_core::SurfaceIndex;

/// Samples on each of the two surfaces by default: the number of the libigl based judge that these figures are compared with.
/// The mean then has a sampling error of well under 1 %.
pub const DEFAULT_SAMPLES: usize = 200_000;

/// Mean, root mean square and greatest of some distances, in parts of the original's diagonal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stats {
    /// Mean.
    pub mean: f64,
    /// Root of the mean square.
    pub rms: f64,
    /// Greatest.
    pub max: f64,
}

impl Stats {
    /// Of distances, added in their order. All 0 without distances.
    pub(crate) fn of(distances: &[f64]) -> Self {
        let n = distances.len().max(1) as f64;
        Self {
            mean: distances.iter().sum::<f64>() / n,
            rms: (distances.iter().map(|d| d * d).sum::<f64>() / n).sqrt(),
            max: distances.iter().copied().fold(0.0, f64::max),
        }
    }
}

/// Distances between two surfaces in both directions, in parts of the original's diagonal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distance {
    /// From the remeshed surface to the original.
    pub forward: Stats,
    /// From the original to the remeshed surface.
    pub backward: Stats,
}

impl Distance {
    /// The worse direction, figure by figure. Its `max` is the Hausdorff distance, to sampling.
    pub fn worse(&self) -> Stats {
        let (f, b) = (self.forward, self.backward);
        Stats { mean: f.mean.max(b.mean), rms: f.rms.max(b.rms), max: f.max.max(b.max) }
    }
}

/// Distances from one surface to another, over `unit`: from `samples` of it, and for the greatest one from its `vertices` too.
pub(crate) fn one_way(samples: &[DVec3], vertices: &[DVec3], to: &SurfaceIndex, unit: f64) -> Stats {
    let of = |points: &[DVec3]| Stats::of(&to.distances(points).into_iter().map(|d| d / unit).collect::<Vec<_>>());
    let (mut stats, at_vertices) = (of(samples), of(vertices));
    stats.max = stats.max.max(at_vertices.max);
    stats
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling;
    use crate::test_shapes::{moved, sphere, square};
    use mesh_core::TriMesh;

    fn between(a: &TriMesh, b: &TriMesh) -> Distance {
        let from = |from: &TriMesh, to: &TriMesh| {
            let samples = sampling::on_faces(from, 10_000);
            one_way(&samples, from.positions().as_slice(), &SurfaceIndex::new(to), a.diagonal())
        };
        Distance { forward: from(b, a), backward: from(a, b) }
    }

    fn assert_near(value: f64, expected: f64, tolerance: f64) {
        assert!((value - expected).abs() < tolerance, "{value} is not {expected}");
    }

    #[test]
    fn parallel_squares() {
        let d = between(&square(), &moved(&square(), |p| p + 0.1 * DVec3::Z));
        for value in [d.forward.mean, d.backward.mean, d.worse().rms, d.worse().max] {
            assert_near(value, 0.1 / 2f64.sqrt(), 1e-12);
        }
    }

    #[test]
    fn a_square_and_one_twice_as_large() {
        // From a corner at the origin: the points of the larger one beyond x = 1 or y = 1 are away from the smaller one. The
        // mean square of max(x-1, 0) over 0..2 is 1/6, and x and y add.
        let large = moved(&square(), |p| 2.0 * p);
        let d = between(&square(), &large);
        assert!(d.backward.max < 1e-12, "the smaller one lies in the larger one");
        assert_near(d.forward.max, 1.0, 1e-12);
        assert_near(d.forward.rms, (1.0 / 3f64).sqrt() / 2f64.sqrt(), 2e-3);
        assert_eq!(d.worse(), d.forward);
    }

    #[test]
    fn concentric_spheres() {
        let inner = sphere(3);
        let d = between(&inner, &moved(&inner, |p| 1.1 * p));
        let diagonal = inner.diagonal();
        // Facets are up to 1 % inside their sphere.
        assert_near(d.worse().mean, 0.1 / diagonal, 0.01 * 0.1);
        assert_near(d.forward.max, 0.1 / diagonal, 0.01 * 0.1);
    }

    #[test]
    fn the_same_on_any_number_of_threads() {
        let (a, b) = (sphere(2), sphere(1));
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| between(&a, &b))
        };
        assert_eq!(on(1), on(4));
    }
}
