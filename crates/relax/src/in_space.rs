//! The paper's relaxation as it is printed (section 4.3): vertices inside sheets leave the surface, and a second projection brings them back.

use crate::quadric::{LEAST_GAIN, MOST_IDLE, plane_centroid_minimiser};
use crate::weights::vertex_weights;
use crate::{QuadricOptions, RelaxError};
use glam::DVec3;
use mesh_core::{FaceId, HalfedgeId, IdVec, VertexId, aspect_ratio, normal};
use rayon::prelude::*;
use region_map::{Attachment, Domain, Surface};

/// A domain that was relaxed in space.
#[derive(Clone, Debug)]
pub struct RelaxedInSpace {
    /// The domain with its vertices in their new positions, near the surface. Its region map is as it was: project it again.
    pub domain: Domain,
    /// Iterations that were run.
    pub iterations: usize,
    /// Mean quality (AR) at the start and at the end, 0 to 1, whichever way triangles face.
    pub ar_mean: [f64; 2],
}

/// Relaxes as the paper prints it: every vertex inside a sheet goes to the minimum of eq. 7, in space.
///
/// Unlike [`relax`](crate::relax) it reads the positions of the domain's mesh, takes the normals of that mesh, and has no guard against triangles
/// that turn over. Vertices at corners and on arcs stay: the second projection would bring them back to where they are. It ends at the target
/// quality, after three iterations without a gain, or at the cap; the best positions met are returned.
///
/// Fails where the domain does not fit the surface ([`Domain::check`]), for an option out of its range, and where a position is no longer finite.
pub fn relax_in_space(surface: &Surface, domain: &Domain, options: &QuadricOptions) -> Result<RelaxedInSpace, RelaxError> {
    options.check()?;
    domain.check(surface.network())?;
    let weights = vertex_weights(surface, domain, options.weights);
    let mut now: IdVec<VertexId, DVec3> = domain.mesh.positions().clone();
    let start = mean_quality(domain, &now);
    let (mut best, mut best_quality) = (now.clone(), start);
    let (mut idle, mut iterations) = (0, 0);
    while iterations < options.iterations && idle < MOST_IDLE && best_quality < options.target_quality {
        if surface.interrupt().is_set() {
            break;
        }
        let positions = now.as_slice().par_iter().enumerate();
        let moved = positions.map(|(i, &p)| p + step(domain, &now, &weights, options.plane_weight, VertexId(i as u32)));
        now = IdVec::from_vec(moved.collect());
        iterations += 1;
        let quality = mean_quality(domain, &now);
        idle = if quality > best_quality + LEAST_GAIN { 0 } else { idle + 1 };
        if quality > best_quality {
            (best, best_quality) = (now.clone(), quality);
        }
    }
    let domain = Domain { mesh: domain.mesh.with_positions(best.into_vec())?, ..domain.clone() };
    Ok(RelaxedInSpace { domain, iterations, ar_mean: [start, best_quality] })
}

/// The way of a vertex to the minimum of eq. 7, with the plane of eq. 8 by the sum of the normals of its triangles.
fn step(domain: &Domain, now: &IdVec<VertexId, DVec3>, weights: &IdVec<VertexId, f64>, plane_weight: f64, v: VertexId) -> DVec3 {
    let topology = &domain.topology;
    if !matches!(domain.region.attachments[v], Attachment::Sheet(_)) {
        return DVec3::ZERO;
    }
    let (sum, total) =
        topology.one_ring(v).fold((DVec3::ZERO, 0.0), |(sum, total), w| (sum + weights[w] * now[w], total + weights[w]));
    if total <= 0.0 {
        return DVec3::ZERO;
    }
    let of_face = |h: HalfedgeId| normal(topology.face(h.face()).map(|w| now[w]));
    let up = topology.fan(v).map(of_face).sum::<DVec3>().normalize_or_zero();
    plane_centroid_minimiser(up, plane_weight, sum / total - now[v])
}

fn mean_quality(domain: &Domain, positions: &IdVec<VertexId, DVec3>) -> f64 {
    let faces = domain.topology.faces();
    let quality = |f: FaceId| aspect_ratio(faces[f].map(|v| positions[v]));
    let ratios: Vec<f64> = (0..faces.len() as u32).into_par_iter().map(|f| quality(FaceId(f))).collect();
    ratios.iter().sum::<f64>() / ratios.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use mesh_core::TriMesh;

    /// A fan of six triangles round vertex 0, its rim a regular hexagon in the plane z = 0.
    fn fan(middle: [f64; 3]) -> Surface {
        let rim = (0..6).map(|i| (f64::from(i) * std::f64::consts::FRAC_PI_3).sin_cos()).map(|(sin, cos)| [cos, sin, 0.0]);
        let positions: Vec<[f64; 3]> = std::iter::once(middle).chain(rim).collect();
        let faces: Vec<[u32; 3]> = (0..6).map(|i| [0, 1 + i, 1 + (i + 1) % 6]).collect();
        Surface::smooth(TriMesh::from_slices(&positions, &faces).unwrap()).unwrap()
    }

    fn middle_after(surface: &Surface, options: &QuadricOptions) -> (DVec3, RelaxedInSpace) {
        let relaxed = relax_in_space(surface, &Domain::identity(surface), options).unwrap();
        (relaxed.domain.mesh.position(VertexId(0)), relaxed)
    }

    /// In a plane the minimum of eq. 7 is the centroid, and one step is there.
    #[test]
    fn in_a_plane_a_vertex_goes_to_the_centroid_and_the_border_stays() {
        let surface = fan([0.3, -0.2, 0.0]);
        let (middle, relaxed) = middle_after(&surface, &QuadricOptions::default());
        assert!(middle.length() < 1e-15 && (relaxed.ar_mean[1] - 1.0).abs() < 1e-12 && relaxed.ar_mean[0] < 0.9);
        assert_eq!(relaxed.domain.mesh.positions().as_slice()[1..], surface.mesh().positions().as_slice()[1..]);
    }

    /// Above the middle the way to the centroid is all along the normal: a plane of weight 1 leaves a half of it, one of weight 3 a quarter.
    #[test]
    fn the_plane_holds_a_vertex_off_the_centroid() {
        for (plane_weight, left) in [(0.0, 0.0), (1.0, 0.5), (3.0, 0.75)] {
            let options = QuadricOptions { iterations: 1, plane_weight, ..QuadricOptions::default() };
            let (middle, relaxed) = middle_after(&fan([0.0, 0.0, 1.0]), &options);
            assert!(middle.distance(DVec3::new(0.0, 0.0, left)) < 1e-12 && relaxed.iterations == 1, "{middle}");
        }
    }

    #[test]
    fn it_ends_at_the_target_and_without_a_gain() {
        let iterations = |options| middle_after(&fan([0.3, -0.2, 0.0]), &options).1.iterations;
        assert_eq!(iterations(QuadricOptions { target_quality: 0.5, ..QuadricOptions::default() }), 0);
        assert_eq!(iterations(QuadricOptions { target_quality: 0.999, ..QuadricOptions::default() }), 1);
        // Nothing is better than equilateral.
        assert_eq!(iterations(QuadricOptions { iterations: 100, ..QuadricOptions::default() }), 1);
    }
}
