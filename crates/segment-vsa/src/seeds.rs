//! First seeds: the parts of the surface that face the six sides of a box (Jong et al., the paper's \[12\]).

use crate::axes::principal_axes;
use crate::measured::Measured;
use crate::proxy::Proxy;
use glam::DVec3;
use mesh_core::{FaceId, IdVec};
use region_map::PatchId;

/// Parts with less area than this share of a mean patch give no seed: on a scan there are thousands.
const LEAST_PART: f64 = 0.2;

/// One proxy for each connected part of a sheet whose faces look to the same side of the box, at the face nearest to that side's
/// normal and the middle of the part. The box is that of the principal axes, or results would turn with the model; where they are
/// not distinct, six farthest points of the surface take its place.
pub(crate) fn first_proxies(surface: &Measured, n_patches: usize) -> IdVec<PatchId, Proxy> {
    let least_area = LEAST_PART * surface.total_area / n_patches.max(1) as f64;
    match principal_axes(surface) {
        Some(axes) => box_parts(surface, axes, least_area),
        None => farthest_points(surface, 6.min(n_patches)),
    }
}

fn box_parts(surface: &Measured, axes: [DVec3; 3], least_area: f64) -> IdVec<PatchId, Proxy> {
    let side = |n: DVec3| {
        let along = axes.map(|a| n.dot(a));
        (0..6).max_by(|&i, &j| sign(i, along).total_cmp(&sign(j, along))).unwrap_or(0)
    };
    let sides: IdVec<FaceId, usize> = surface.normals.iter().map(|&n| side(n)).collect();
    let topology = surface.topology;
    let (part_of, n) = topology.regions(|e| match topology.edge_faces(e) {
        (f, Some(g)) => !surface.network.is_barrier(e) && sides[f] == sides[g],
        _ => false,
    });
    let mut parts = vec![(0.0, DVec3::ZERO); n];
    for (f, &part) in part_of.enumerate() {
        let (area, moment) = &mut parts[part as usize];
        *area += surface.areas[f];
        *moment += surface.areas[f] * surface.centroids[f];
    }
    let mut best: Vec<Option<(f64, FaceId)>> = vec![None; n];
    for (f, &part) in part_of.enumerate() {
        let (area, moment) = parts[part as usize];
        let normal = if sides[f].is_multiple_of(2) { axes[sides[f] / 2] } else { -axes[sides[f] / 2] };
        let cost = surface.normals[f].distance_squared(normal) + surface.centroids[f].distance_squared(moment / area) / area;
        let best = &mut best[part as usize];
        if area >= least_area && area > 0.0 && best.is_none_or(|(least, _)| cost < least) {
            *best = Some((cost, f));
        }
    }
    best.into_iter().flatten().map(|(_, f)| Proxy::at(surface, f)).collect()
}

/// The component along side `i` of a box: +0, -0, +1, -1, +2, -2.
fn sign(i: usize, along: [f64; 3]) -> f64 {
    if i.is_multiple_of(2) { along[i / 2] } else { -along[i / 2] }
}

/// `n` faces, each the farthest from those before, the first one the farthest from the middle.
fn farthest_points(surface: &Measured, n: usize) -> IdVec<PatchId, Proxy> {
    let centre = surface.centroids.iter().zip(&surface.areas).map(|(&c, &a)| a * c).sum::<DVec3>() / surface.total_area;
    let mut distance: IdVec<FaceId, f64> = surface.centroids.iter().map(|c| c.distance_squared(centre)).collect();
    let mut proxies = IdVec::new();
    for _ in 0..n {
        let Some((f, d)) = distance.enumerate().max_by(|(i, a), (j, b)| a.total_cmp(b).then(j.cmp(i))) else { break };
        if *d <= 0.0 {
            break;
        }
        let here = surface.centroids[f];
        if proxies.is_empty() {
            distance = IdVec::filled(f64::INFINITY, distance.len());
        }
        proxies.push(Proxy::at(surface, f));
        distance.iter_mut().zip(&surface.centroids).for_each(|(d, c)| *d = d.min(c.distance_squared(here)));
    }
    proxies
}
