//! Lloyd relaxation of the sites inside one patch (eq. 5, by area), with the border sites fixed.

use crate::candidates::Candidate;
use glam::DVec3;
use mesh_core::SurfacePoint;

/// `n` sites among the candidates, first far from each other and from the border, then at the centroids of their Voronoi cells.
///
/// Ends when no site moves, when the energy no longer falls (rounding could cycle), or after `max_steps`.
pub(crate) fn relaxed_sites(candidates: &[Candidate], border: &[DVec3], n: usize, max_steps: usize) -> Vec<SurfacePoint> {
    let mut sites = farthest(candidates, border, n);
    let mut energy = f64::INFINITY;
    for _ in 0..max_steps {
        let (next, next_energy) = step(candidates, border, &sites);
        if next == sites || next_energy >= energy {
            break;
        }
        (sites, energy) = (next, next_energy);
    }
    sites.iter().map(|&c| candidates[c].point).collect()
}

/// Indices of candidates, each the farthest from the border and all before it, in units of the local edge length.
fn farthest(candidates: &[Candidate], border: &[DVec3], n: usize) -> Vec<usize> {
    let mut gap: Vec<f64> = candidates
        .iter()
        .map(|c| border.iter().map(|b| b.distance_squared(c.position)).fold(f64::INFINITY, f64::min) * c.weight.sqrt())
        .collect();
    let mut sites = Vec::with_capacity(n);
    for _ in 0..n.min(candidates.len()) {
        let Some(best) = (0..gap.len()).max_by(|&a, &b| gap[a].total_cmp(&gap[b]).then(b.cmp(&a))) else { break };
        sites.push(best);
        let position = candidates[best].position;
        for (g, c) in gap.iter_mut().zip(candidates) {
            *g = g.min(c.position.distance_squared(position) * c.weight.sqrt());
        }
    }
    sites
}

/// One Lloyd step: the candidates nearest to the centroids of the cells, and the energy of the sites that it began with.
fn step(candidates: &[Candidate], border: &[DVec3], sites: &[usize]) -> (Vec<usize>, f64) {
    let positions: Vec<DVec3> = sites.iter().map(|&s| candidates[s].position).collect();
    let mut centroids = vec![(DVec3::ZERO, 0.0); sites.len()];
    let mut energy = 0.0;
    let mut cell = vec![usize::MAX; candidates.len()];
    for (c, owner) in candidates.iter().zip(&mut cell) {
        let to_border = border.iter().map(|b| b.distance_squared(c.position)).fold(f64::INFINITY, f64::min);
        let mut nearest = to_border;
        for (s, p) in positions.iter().enumerate() {
            let d = p.distance_squared(c.position);
            if d < nearest {
                (nearest, *owner) = (d, s);
            }
        }
        energy += c.weight * nearest;
        if let Some((sum, weight)) = centroids.get_mut(*owner) {
            *sum += c.weight * c.position;
            *weight += c.weight;
        }
    }
    let centroids: Vec<DVec3> =
        centroids.iter().zip(&positions).map(|((sum, w), &p)| if *w > 0.0 { *sum / *w } else { p }).collect();
    let mut next: Vec<(f64, usize)> = sites.iter().map(|&s| (f64::INFINITY, s)).collect();
    for (i, (c, &owner)) in candidates.iter().zip(&cell).enumerate() {
        if let Some(best) = next.get_mut(owner) {
            let d = c.position.distance_squared(centroids[owner]);
            if d < best.0 {
                *best = (d, i);
            }
        }
    }
    (next.into_iter().map(|(_, i)| i).collect(), energy)
}
