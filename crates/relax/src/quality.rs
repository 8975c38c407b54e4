//! How good the triangles of a placement are.

use crate::measured::Measured;
use crate::movable_domain::MovableDomain;
use mesh_core::{FaceId, aspect_ratio};

/// The quality of the triangles of a domain.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Quality {
    /// Mean AR, where an inverted triangle counts 0.
    pub ar_mean: f64,
    /// Least AR, 0 with an inverted triangle.
    pub ar_min: f64,
    /// Triangles that face against the surface or have no area.
    pub inverted: usize,
}

impl Quality {
    /// That of all faces of a placement.
    pub(crate) fn of(measured: &Measured, domain: &MovableDomain) -> Self {
        let ratio = |f: FaceId| aspect_ratio(measured.placement().triangle(domain, f));
        let upright = |f: FaceId| (measured.faces()[f].signed_area > 0.0).then(|| ratio(f));
        let ratios = domain.of_faces(upright);
        let (mut sum, mut least, mut inverted) = (0.0, 1.0f64, 0);
        for ratio in &ratios {
            inverted += usize::from(ratio.is_none());
            sum += ratio.unwrap_or(0.0);
            least = least.min(ratio.unwrap_or(0.0));
        }
        let ar_mean = sum / ratios.len().max(1) as f64;
        Self { ar_mean, ar_min: least, inverted }
    }

    /// Fewer inverted triangles, or as many and a better mean.
    pub(crate) fn is_better_than(&self, other: &Self) -> bool {
        self.inverted < other.inverted || (self.inverted == other.inverted && self.ar_mean > other.ar_mean)
    }
}
