//! Edges joined to runs.

/// Edges joined at vertices where just two of them meet and that are no corner, as the vertices along each run. A closed run ends in the vertex
/// where it starts. Vertices are below `n_vertices`.
pub(super) fn runs(edges: &[[u32; 2]], corners: &[u32], n_vertices: usize) -> Vec<Vec<u32>> {
    let mut edges_at: Vec<Vec<usize>> = vec![Vec::new(); n_vertices];
    for (e, ends) in edges.iter().enumerate() {
        ends.iter().for_each(|&v| edges_at[v as usize].push(e));
    }
    let mut is_end: Vec<bool> = edges_at.iter().map(|edges| edges.len() != 2).collect();
    corners.iter().for_each(|&v| is_end[v as usize] = true);
    let mut is_used = vec![false; edges.len()];
    let mut runs = Vec::new();
    // From ends first; what is left are closed runs, which may start anywhere.
    for from_ends in [true, false] {
        for (e, &[v, w]) in edges.iter().enumerate() {
            for [start, next] in [[v, w], [w, v]] {
                if !is_used[e] && (is_end[start as usize] || !from_ends) {
                    is_used[e] = true;
                    let mut run = vec![start, next];
                    extend(&mut run, edges, &edges_at, &is_end, &mut is_used);
                    runs.push(run);
                }
            }
        }
    }
    runs
}

/// Goes on from the last vertex of a run to an end, or to where all edges are used.
fn extend(run: &mut Vec<u32>, edges: &[[u32; 2]], edges_at: &[Vec<usize>], is_end: &[bool], is_used: &mut [bool]) {
    while let Some(&last) = run.last() {
        let next = edges_at[last as usize].iter().find(|&&e| !is_used[e]).filter(|_| !is_end[last as usize]);
        let Some(&e) = next else { return };
        is_used[e] = true;
        let [v, w] = edges[e];
        run.push(if v == last { w } else { v });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_end_at_corners_and_junctions() {
        // A path 0 1 2 3 with a corner at 2, three edges at 3, and a triangle 6 7 8 by itself.
        let edges = [[1, 0], [1, 2], [3, 2], [3, 4], [5, 3], [7, 6], [7, 8], [6, 8]];
        let expected = vec![vec![0, 1, 2], vec![3, 2], vec![3, 4], vec![5, 3], vec![7, 6, 8, 7]];
        assert_eq!(runs(&edges, &[2], 9), expected);
        assert_eq!(runs(&[], &[], 3), Vec::<Vec<u32>>::new());
        // A closed run with one corner starts and ends there.
        assert_eq!(runs(&[[0, 1], [1, 2], [2, 0]], &[1], 3), [[1, 0, 2, 1]]);
    }
}
