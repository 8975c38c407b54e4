//! Shape of the triangles of a mesh: the paper's section 5 figures, and with them the variation of the areas.

use crate::topology::n_vertices;
use crate::weld::Welded;
use mesh_core::{Id, TriMesh, angles, aspect_ratio};
use std::collections::BTreeMap;

/// A triangle of lower aspect ratio is degenerate: it has angles of less than about half a degree.
pub const DEGENERATE_ASPECT_RATIO: f64 = 0.01;

/// Shape of the triangles of a mesh. All figures are 0 for a mesh without faces.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Quality {
    /// Mean aspect ratio ([`mesh_core::aspect_ratio`], 1 = equilateral).
    pub ar_mean: f64,
    /// 1st percentile of the aspect ratio, interpolated linearly between ranks.
    pub ar_p01: f64,
    /// Least aspect ratio.
    pub ar_min: f64,
    /// Mean of |interior angle - 60|, degrees (eq. 10).
    pub agl: f64,
    /// Least interior angle, degrees.
    pub angle_min: f64,
    /// Greatest interior angle, degrees.
    pub angle_max: f64,
    /// Standard deviation of the areas over their mean.
    pub area_cv: f64,
    /// Greatest area over the least one; infinite beside a face without area.
    pub area_ratio: f64,
    /// Triangles of an aspect ratio below [`DEGENERATE_ASPECT_RATIO`].
    pub degenerate: usize,
    /// Number of inner vertices of each valence, of the welded mesh.
    pub valences: BTreeMap<usize, usize>,
}

impl Quality {
    /// Share of the inner vertices whose valence is not 6; 0 without inner vertices.
    pub fn irregular(&self) -> f64 {
        let all: usize = self.valences.values().sum();
        let regular = self.valences.get(&6).copied().unwrap_or(0);
        if all == 0 { 0.0 } else { (all - regular) as f64 / all as f64 }
    }
}

/// Measures the triangles of a mesh.
pub fn quality(mesh: &TriMesh) -> Quality {
    with_welded(mesh, &Welded::of(mesh))
}

/// The same with the welded mesh at hand.
pub(crate) fn with_welded(mesh: &TriMesh, welded: &Welded) -> Quality {
    if mesh.n_faces() == 0 {
        return Quality::default();
    }
    let triangles = || mesh.faces().ids().map(|f| mesh.triangle(f));
    let mut ratios: Vec<f64> = triangles().map(aspect_ratio).collect();
    ratios.sort_unstable_by(f64::total_cmp);
    let degrees: Vec<f64> = triangles().flat_map(angles).map(f64::to_degrees).collect();
    let areas = mesh.areas();
    let area_mean = mean(areas.iter().copied());
    let area_variance = mean(areas.iter().map(|a| (a - area_mean).powi(2)));
    Quality {
        ar_mean: mean(ratios.iter().copied()),
        ar_p01: percentile(&ratios, 0.01),
        ar_min: ratios[0],
        agl: mean(degrees.iter().map(|a| (a - 60.0).abs())),
        angle_min: least(&degrees),
        angle_max: greatest(&degrees),
        area_cv: area_variance.sqrt() / area_mean,
        area_ratio: greatest(areas.as_slice()) / least(areas.as_slice()),
        degenerate: ratios.partition_point(|&q| q < DEGENERATE_ASPECT_RATIO),
        valences: valences(welded),
    }
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let n = values.len() as f64;
    values.sum::<f64>() / n
}

fn least(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}

fn greatest(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

/// The value below which the share `q` of sorted values lies, linear between the two nearest ranks (numpy's default).
fn percentile(sorted: &[f64], q: f64) -> f64 {
    let rank = q * (sorted.len() - 1) as f64;
    let below = rank.floor() as usize;
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (rank - below as f64) * (sorted[above] - sorted[below])
}

fn valences(welded: &Welded) -> BTreeMap<usize, usize> {
    let edges = welded.edges();
    let n = n_vertices(welded.mesh().faces());
    let mut valence = vec![0; n];
    for end in edges.iter().flat_map(|sides| sides[0].ends) {
        valence[end.index()] += 1;
    }
    let mut inner = vec![true; n];
    for end in edges.border().flatten() {
        inner[end.index()] = false;
    }
    let mut histogram = BTreeMap::new();
    for (valence, _) in valence.into_iter().zip(inner).filter(|&(_, inner)| inner) {
        *histogram.entry(valence).or_insert(0) += 1;
    }
    histogram
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_shapes::{icosahedron, mesh, subdivide};

    #[test]
    fn an_icosahedron_is_equilateral() {
        let q = quality(&icosahedron());
        for (value, expected) in [(q.ar_mean, 1.0), (q.ar_min, 1.0), (q.ar_p01, 1.0), (q.area_ratio, 1.0)] {
            assert!((value - expected).abs() < 1e-12);
        }
        assert!(q.agl < 1e-12 && q.area_cv < 1e-12);
        assert_eq!((q.degenerate, q.irregular()), (0, 1.0));
        assert_eq!(quality(&subdivide(&icosahedron())).irregular(), 12.0 / 42.0);
    }

    #[test]
    fn two_triangles_of_known_shape() {
        // A right isosceles one of area 1/2 and a needle of area 0.0005.
        let m = mesh(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.001, 0.0]], &[[0, 1, 2], [0, 3, 1]]);
        let q = quality(&m);
        assert_eq!(q.degenerate, 1);
        assert!((q.area_ratio - 1000.0).abs() < 1e-6);
        assert!((q.area_cv - 0.499_5 / 0.500_5).abs() < 1e-12);
        assert!((q.ar_p01 - (0.99 * q.ar_min + 0.01 * (2.0 * q.ar_mean - q.ar_min))).abs() < 1e-12);
        assert!(q.valences.is_empty());
    }

    #[test]
    fn percentile_is_linear_between_ranks() {
        assert_eq!(percentile(&[3.0], 0.01), 3.0);
        assert_eq!(percentile(&[0.0, 10.0, 20.0], 0.25), 5.0);
        assert_eq!(percentile(&[0.0, 10.0, 20.0], 1.0), 20.0);
    }

    #[test]
    fn no_faces_no_figures() {
        assert_eq!(quality(&mesh(&[], &[])), Quality::default());
    }
}
