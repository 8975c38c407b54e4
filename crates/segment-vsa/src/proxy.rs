//! The metric (paper, eq. 1, with the norm squared) and the proxies (eq. 2).

use crate::disk::PatchOf;
use crate::measured::Measured;
use glam::DVec3;
use mesh_core::{FaceId, IdVec};
use region_map::PatchId;

/// What a patch strives for: a normal and a place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Proxy {
    /// Where the patch starts to grow.
    pub(crate) seed: FaceId,
    /// Unit normal N(P).
    pub(crate) normal: DVec3,
    /// Middle of the patch.
    pub(crate) centre: DVec3,
}

impl Proxy {
    /// The proxy of a patch that is one face.
    pub(crate) fn at(surface: &Measured, seed: FaceId) -> Self {
        Self { seed, normal: surface.normals[seed], centre: surface.centroids[seed] }
    }
}

/// The cost of a face: `|N(t) - N(P)|^2` (eq. 1 without the area, which sorts the queue by size) and its distance from the middle
/// of the patch, relative to the mean size of a patch.
pub(crate) struct Metric {
    per_squared_distance: f64,
}

impl Metric {
    pub(crate) fn new(surface: &Measured, n_patches: usize, compactness: f64) -> Self {
        let mean_area = surface.total_area / n_patches.max(1) as f64;
        Self { per_squared_distance: compactness / mean_area.max(f64::MIN_POSITIVE) }
    }

    pub(crate) fn cost(&self, surface: &Measured, f: FaceId, proxy: &Proxy) -> f64 {
        surface.normals[f].distance_squared(proxy.normal)
            + self.per_squared_distance * surface.centroids[f].distance_squared(proxy.centre)
    }
}

/// Sums over the faces of a patch.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Moments {
    pub(crate) area: f64,
    /// Sum of `A(t) N(t)`, the numerator of eq. 2.
    pub(crate) normal: DVec3,
    centroid: DVec3,
}

impl Moments {
    /// The sums of all patches.
    pub(crate) fn of_patches(surface: &Measured, patch_of: &PatchOf, n: usize) -> IdVec<PatchId, Self> {
        let mut moments = IdVec::filled(Self::default(), n);
        for (f, p) in patch_of.enumerate() {
            if let Some(p) = *p {
                moments[p] = moments[p].plus(&Self::of_face(surface, f));
            }
        }
        moments
    }

    fn of_face(surface: &Measured, f: FaceId) -> Self {
        let area = surface.areas[f];
        Self { area, normal: area * surface.normals[f], centroid: area * surface.centroids[f] }
    }

    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self { area: self.area + other.area, normal: self.normal + other.normal, centroid: self.centroid + other.centroid }
    }

    /// The error of the patch with the best normal: the sum of `|N(t) - N(P)|^2 A(t)` is `2 (A - |sum A(t) N(t)|)`.
    pub(crate) fn error(&self) -> f64 {
        2.0 * (self.area - self.normal.length()).max(0.0)
    }

    /// The spread of the normals in degrees: the half angle of the spherical cap with the same mean error.
    pub(crate) fn spread(&self) -> f64 {
        if self.area > 0.0 { (1.0 - self.error() / self.area).clamp(-1.0, 1.0).acos().to_degrees() } else { 0.0 }
    }

    /// Unit normal by eq. 2, and centroid; `None` where they are undefined.
    pub(crate) fn normal_and_centre(&self) -> Option<(DVec3, DVec3)> {
        let normal = self.normal.try_normalize()?;
        (self.area > 0.0).then(|| (normal, self.centroid / self.area))
    }
}

/// Proxies of grown patches by eq. 2, each with the face of least cost as its new seed.
pub(crate) fn refit(surface: &Measured, metric: &Metric, patch_of: &PatchOf, n: usize) -> IdVec<PatchId, Proxy> {
    let moments = Moments::of_patches(surface, patch_of, n);
    let mut best: IdVec<PatchId, Option<(f64, Proxy)>> = IdVec::filled(None, n);
    for (f, p) in patch_of.enumerate() {
        let Some(p) = *p else { continue };
        let mut proxy = Proxy::at(surface, f);
        if let Some((normal, centre)) = moments[p].normal_and_centre() {
            (proxy.normal, proxy.centre) = (normal, centre);
        }
        let cost = metric.cost(surface, f, &proxy);
        if best[p].is_none_or(|(least, _)| cost < least) {
            best[p] = Some((cost, proxy));
        }
    }
    best.iter().flatten().map(|&(_, proxy)| proxy).collect()
}

/// The face of every patch whose cost is greatest.
pub(crate) fn worst_faces(
    surface: &Measured,
    metric: &Metric,
    patch_of: &PatchOf,
    proxies: &IdVec<PatchId, Proxy>,
) -> IdVec<PatchId, FaceId> {
    let mut worst: IdVec<PatchId, (f64, FaceId)> = proxies.iter().map(|p| (0.0, p.seed)).collect();
    for (f, p) in patch_of.enumerate() {
        let Some(p) = *p else { continue };
        let cost = metric.cost(surface, f, &proxies[p]);
        if cost > worst[p].0 {
            worst[p] = (cost, f);
        }
    }
    worst.iter().map(|&(_, f)| f).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use region_map::Surface;

    /// Without compactness the cost is that of eq. 1: 2 between sides of a cube that meet, 4 between opposite ones, wherever the patch is.
    #[test]
    fn without_compactness_the_cost_is_that_of_the_normals() {
        let surface = Surface::with_creases(fixtures::cube(2), 40.0).unwrap();
        let surface = Measured::new(&surface);
        let metric = Metric::new(&surface, 6, 0.0);
        let proxy = Proxy::at(&surface, FaceId(0));
        for (f, n) in surface.normals.enumerate() {
            let expected = 2.0 - 2.0 * n.dot(proxy.normal);
            assert!((metric.cost(&surface, f, &proxy) - expected).abs() < 1e-12);
        }
        let (far, near) = (Metric::new(&surface, 6, 0.3), surface.centroids[FaceId(0)]);
        let squared_distance = surface.centroids[FaceId(1)].distance_squared(near);
        // The mean area of six patches is that of a side.
        let expected = 0.3 * squared_distance / (surface.total_area / 6.0);
        assert!((far.cost(&surface, FaceId(1), &proxy) - metric.cost(&surface, FaceId(1), &proxy) - expected).abs() < 1e-12);
    }
}
