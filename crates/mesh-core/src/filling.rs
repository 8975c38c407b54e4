//! The cheapest triangulation of a polygon (Klincsek, *Minimal triangulations of polygonal domains*, 1980).

/// Polygons with more corners are not triangulated.
const MOST_CORNERS: usize = 8192;

/// Triangulates a polygon with `n` corners, counter-clockwise, so that the sum of the costs of its triangles is least. `may_be` says whether
/// a chord is allowed. Costs are not negative, `None` for a triangle that may not be; without any triangulation the result is `None`,
/// too, as it is for more than 8192 corners: time rises with the third power of them. Triangles come with their corners in rising
/// order.
pub fn cheapest_filling(
    n: usize,
    may_be: impl Fn(usize, usize) -> bool,
    cost: impl Fn([usize; 3]) -> Option<f64>,
) -> Option<Vec<[usize; 3]>> {
    if n > MOST_CORNERS {
        return None;
    }
    // For every chord from i to j the least cost on its left, and the third corner of the triangle there.
    let at = |i: usize, j: usize| i * n + j;
    let mut best = vec![Some((0.0, 0)); n * n];
    for gap in 2..n {
        for i in 0..n - gap {
            let j = i + gap;
            let mut least = None;
            let is_allowed = gap == n - 1 || may_be(i, j);
            for k in (i + 1..j).filter(|_| is_allowed) {
                let (Some((left, _)), Some((right, _))) = (best[at(i, k)], best[at(k, j)]) else { continue };
                let is_less = |sum: f64| least.is_none_or(|(cost, _)| sum < cost);
                // Without the triangle it costs less already, or never will.
                if is_less(left + right)
                    && let Some(sum) = cost([i, k, j]).map(|cost| left + right + cost)
                    && is_less(sum)
                {
                    least = Some((sum, k));
                }
            }
            best[at(i, j)] = least;
        }
    }
    best.get(n.checked_sub(1)?).copied().flatten()?;
    let (mut triangles, mut chords) = (Vec::new(), vec![(0, n - 1)]);
    while let Some((i, j)) = chords.pop() {
        if j - i < 2 {
            continue;
        }
        let (_, k) = best[at(i, j)]?;
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
        // Triangles cost their longest step: the best filling is the inner triangle, and one at each of its sides.
        let cost = |t: [usize; 3]| {
            let step = |a: usize, b: usize| (a.abs_diff(b)).min(6 - a.abs_diff(b));
            Some(step(t[0], t[1]).max(step(t[1], t[2])).max(step(t[2], t[0])) as f64)
        };
        let mut triangles = cheapest_filling(6, |_, _| true, cost).unwrap();
        triangles.sort();
        let total: f64 = triangles.iter().map(|&t| cost(t).unwrap()).sum();
        assert_eq!((triangles.len(), total), (4, 8.0));
    }

    #[test]
    fn forbidden_chords_and_triangles_are_avoided() {
        // A square whose diagonal from 0 to 2 may not be, or neither triangle beside it.
        let mut by_chord = cheapest_filling(4, |i, j| (i, j) != (0, 2), |_| Some(1.0)).unwrap();
        let cost = |t: [usize; 3]| (t != [0, 1, 2] && t != [0, 2, 3]).then_some(1.0);
        let mut by_triangles = cheapest_filling(4, |_, _| true, cost).unwrap();
        by_chord.sort();
        by_triangles.sort();
        assert_eq!(by_chord, [[0, 1, 3], [1, 2, 3]]);
        assert_eq!(by_triangles, by_chord);
        assert_eq!(cheapest_filling(4, |_, _| true, |_| None), None);
        assert_eq!(cheapest_filling(4, |_, _| false, |_| Some(1.0)), None);
        assert_eq!(cheapest_filling(3, |_, _| false, |_| Some(1.0)), Some(vec![[0, 1, 2]]));
        assert_eq!(cheapest_filling(0, |_, _| true, |_| Some(1.0)), None);
        assert_eq!(cheapest_filling(usize::MAX, |_, _| true, |_| Some(1.0)), None);
    }
}
