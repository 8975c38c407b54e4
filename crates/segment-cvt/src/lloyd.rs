//! Lloyd relaxation of the sites inside one patch (eq. 5, by area), with the border sites fixed.

use crate::candidates::Candidate;
use crate::farthest::farthest;
use crate::kd_tree::KdTree;
use glam::DVec3;
use mesh_core::SurfacePoint;

/// `n` sites among the candidates, first far from each other and from the border, then at the centroids of their Voronoi cells.
///
/// Ends when no site moves, when the energy no longer falls (rounding could cycle), or after `max_steps`.
pub(crate) fn relaxed_sites(candidates: &[Candidate], border: &[DVec3], n: usize, max_steps: usize) -> Vec<SurfacePoint> {
    let to_border = squared_distances(candidates, border);
    let mut sites = farthest(candidates, &to_border, n);
    let (mut next, mut energy) = step(candidates, &to_border, &sites);
    for _ in 0..max_steps {
        if next == sites {
            break;
        }
        let (after, next_energy) = step(candidates, &to_border, &next);
        if next_energy >= energy {
            break;
        }
        (sites, next, energy) = (next, after, next_energy);
    }
    sites.iter().map(|&c| candidates[c].point).collect()
}

/// The squared distance of every candidate from the nearest border site, infinite without one.
fn squared_distances(candidates: &[Candidate], border: &[DVec3]) -> Vec<f64> {
    let tree = KdTree::new(border.iter().copied());
    let nearest = |c: &Candidate| {
        let mut least = f64::INFINITY;
        tree.search(c.position, least, |b| {
            least = least.min(border[b].distance_squared(c.position));
            least
        });
        least
    };
    candidates.iter().map(nearest).collect()
}

/// One Lloyd step: the candidates nearest to the centroids of the cells, and the energy of the sites that it began with.
fn step(candidates: &[Candidate], to_border: &[f64], sites: &[usize]) -> (Vec<usize>, f64) {
    let positions: Vec<DVec3> = sites.iter().map(|&s| candidates[s].position).collect();
    let tree = KdTree::new(positions.iter().copied());
    let owners: Vec<(f64, Option<usize>)> =
        candidates.iter().zip(to_border).map(|(c, &d)| owner(c.position, d, &positions, &tree)).collect();
    let mut sums = vec![(DVec3::ZERO, 0.0); sites.len()];
    let mut energy = 0.0;
    for (c, &(squared_distance, owner)) in candidates.iter().zip(&owners) {
        energy += c.weight * squared_distance;
        if let Some(s) = owner {
            sums[s].0 += c.weight * c.position;
            sums[s].1 += c.weight;
        }
    }
    let mut next: Vec<(f64, usize)> = sites.iter().map(|&c| (f64::INFINITY, c)).collect();
    for (i, (c, &(_, owner))) in candidates.iter().zip(&owners).enumerate() {
        let Some(s) = owner else { continue };
        let d = c.position.distance_squared(sums[s].0 / sums[s].1);
        if d < next[s].0 {
            next[s] = (d, i);
        }
    }
    (next.into_iter().map(|(_, i)| i).collect(), energy)
}

/// The squared distance of the nearest site, and its index; `None` where the border is nearer. Of equal ones the border wins, then
/// the lowest index.
fn owner(position: DVec3, to_border: f64, sites: &[DVec3], tree: &KdTree) -> (f64, Option<usize>) {
    let mut nearest = (to_border, None);
    tree.search(position, to_border, |s| {
        let found = (sites[s].distance_squared(position), Some(s));
        if found < nearest {
            nearest = found;
        }
        nearest.0
    });
    nearest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::candidates::spread;
    use region_map::Sizing;

    /// A square of two triangles, its candidates, and its corners as border sites.
    fn square(n: usize) -> (Vec<Candidate>, Vec<DVec3>) {
        let mesh = fixtures::plane();
        let faces: Vec<_> = mesh.faces().ids().collect();
        (spread(&mesh, &faces, &Sizing::uniform(&mesh), n, 0), mesh.positions().as_slice().to_vec())
    }

    #[test]
    fn owners_are_those_of_the_full_search() {
        let (candidates, border) = square(3000);
        let to_border = squared_distances(&candidates, &border);
        for (c, &d) in candidates.iter().zip(&to_border) {
            assert_eq!(d, border.iter().map(|b| b.distance_squared(c.position)).fold(f64::INFINITY, f64::min));
        }
        let sites: Vec<DVec3> = farthest(&candidates, &to_border, 40).iter().map(|&c| candidates[c].position).collect();
        let tree = KdTree::new(sites.iter().copied());
        let mut of_border = 0;
        for (c, &d) in candidates.iter().zip(&to_border) {
            let mut expected = (d, None);
            for (s, site) in sites.iter().enumerate() {
                if site.distance_squared(c.position) < expected.0 {
                    expected = (site.distance_squared(c.position), Some(s));
                }
            }
            assert_eq!(owner(c.position, d, &sites, &tree), expected);
            of_border += usize::from(expected.1.is_none());
        }
        assert!(of_border > 0 && of_border < candidates.len());
        // Two sites at one place: the first has it.
        let twice = [sites[0], sites[0]];
        assert_eq!(owner(sites[0], 1.0, &twice, &KdTree::new(twice.iter().copied())), (0.0, Some(0)));
        assert_eq!(owner(sites[0], 0.0, &twice, &KdTree::new(twice.iter().copied())), (0.0, None));
    }

    #[test]
    fn the_energy_falls_and_the_best_sites_are_kept() {
        let (candidates, border) = square(2000);
        let to_border = squared_distances(&candidates, &border);
        let energy = |steps: usize| {
            let sites = relaxed_sites(&candidates, &border, 12, steps);
            let at = |p: &SurfacePoint| candidates.iter().position(|c| c.point == *p).unwrap();
            step(&candidates, &to_border, &sites.iter().map(at).collect::<Vec<_>>()).1
        };
        let energies: Vec<f64> = [0, 1, 2, 5, 10, 60, 1000].map(energy).to_vec();
        assert!(energies.windows(2).all(|w| w[1] <= w[0]), "{energies:?}");
        assert!(energies[5] < 0.9 * energies[0], "{energies:?}");
        assert_eq!(energies[6], energy(2000));
    }

    #[test]
    fn more_sites_than_candidates_are_all_candidates() {
        let (candidates, border) = square(3);
        assert_eq!(relaxed_sites(&candidates, &border, 10, 5).len(), 3);
        assert_eq!(relaxed_sites(&[], &border, 10, 5), []);
    }
}
