//! The cheapest triangulation of a polygon (Klincsek, *Minimal triangulations of polygonal domains*, 1980).

/// Triangulates a polygon with `n` corners, counter-clockwise, so that the sum of the costs of its triangles is least. `None` for a
/// triangle that may not be; without any triangulation the result is `None`, too. Triangles come with their corners in rising order.
pub fn cheapest_filling(n: usize, cost: impl Fn([usize; 3]) -> Option<f64>) -> Option<Vec<[usize; 3]>> {
    // For every chord from i to j the least cost on its left, and the third corner of the triangle there.
    let mut best = vec![vec![Some((0.0, 0)); n]; n];
    for gap in 2..n {
        for i in 0..n - gap {
            let j = i + gap;
            let through = |k: usize| {
                let (left, right) = (best[i][k]?, best[k][j]?);
                Some((left.0 + right.0 + cost([i, k, j])?, k))
            };
            best[i][j] = (i + 1..j).filter_map(through).min_by(|a: &(f64, usize), b| a.0.total_cmp(&b.0));
        }
    }
    best.first()?.last().copied().flatten()?;
    let (mut triangles, mut chords) = (Vec::new(), vec![(0, n - 1)]);
    while let Some((i, j)) = chords.pop() {
        if j - i < 2 {
            continue;
        }
        let (_, k) = best[i][j]?;
        triangles.push([i, k, j]);
        chords.extend([(i, k), (k, j)]);
    }
    Some(triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hexagon_is_cut_at_its_cheapest_chords() {
        // Triangles cost their longest step: the best filling is the inner triangle with three ears.
        let cost = |t: [usize; 3]| {
            let step = |a: usize, b: usize| (a.abs_diff(b)).min(6 - a.abs_diff(b));
            Some(step(t[0], t[1]).max(step(t[1], t[2])).max(step(t[2], t[0])) as f64)
        };
        let mut triangles = cheapest_filling(6, cost).unwrap();
        triangles.sort();
        let total: f64 = triangles.iter().map(|&t| cost(t).unwrap()).sum();
        assert_eq!((triangles.len(), total), (4, 8.0));
    }

    #[test]
    fn forbidden_triangles_are_avoided() {
        // A square whose diagonal from 0 to 2 may not be.
        let cost = |t: [usize; 3]| (t != [0, 1, 2] && t != [0, 2, 3]).then_some(1.0);
        let mut triangles = cheapest_filling(4, cost).unwrap();
        triangles.sort();
        assert_eq!(triangles, [[0, 1, 3], [1, 2, 3]]);
        assert_eq!(cheapest_filling(4, |_| None), None);
        assert_eq!(cheapest_filling(3, |_| Some(1.0)), Some(vec![[0, 1, 2]]));
    }
}
