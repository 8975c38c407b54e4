//! Points in a k-d tree (Bentley 1975), for searches of what is near.
//!
//! Measured: 500 sites in one patch 0.2 s in place of 0.7 s.

use glam::DVec3;
use mesh_core::Bounds;

/// A balanced tree without pointers: the middle of a range is its node, split along `axis`; the halves are its children.
pub(crate) struct KdTree {
    nodes: Vec<Node>,
}

struct Node {
    position: DVec3,
    index: usize,
    axis: usize,
}

impl KdTree {
    pub(crate) fn new(points: impl Iterator<Item = DVec3>) -> Self {
        let mut nodes: Vec<Node> = points.enumerate().map(|(index, position)| Node { position, index, axis: 0 }).collect();
        arrange(&mut nodes);
        Self { nodes }
    }

    /// Visits the points that are not farther from `at` than the reach, roughly from near to far. The reach is a *squared* distance; `visit`
    /// takes an index and returns the reach from then on.
    pub(crate) fn search(&self, at: DVec3, reach: f64, mut visit: impl FnMut(usize) -> f64) {
        descend(&self.nodes, at, reach, &mut visit);
    }
}

fn arrange(nodes: &mut [Node]) {
    let Some(bounds) = Bounds::of(nodes.iter().map(|n| n.position)) else { return };
    let axis = (bounds.max - bounds.min).max_position();
    let middle = nodes.len() / 2;
    nodes.select_nth_unstable_by(middle, |a, b| a.position[axis].total_cmp(&b.position[axis]).then(a.index.cmp(&b.index)));
    nodes[middle].axis = axis;
    let (below, rest) = nodes.split_at_mut(middle);
    arrange(below);
    arrange(&mut rest[1..]);
}

/// Searches a range and returns the reach.
fn descend(nodes: &[Node], at: DVec3, mut reach: f64, visit: &mut impl FnMut(usize) -> f64) -> f64 {
    let Some(node) = nodes.get(nodes.len() / 2) else { return reach };
    let (below, rest) = nodes.split_at(nodes.len() / 2);
    let gap = at[node.axis] - node.position[node.axis];
    let (near, far) = if gap < 0.0 { (below, &rest[1..]) } else { (&rest[1..], below) };
    reach = descend(near, at, reach, visit);
    if gap * gap <= reach {
        if node.position.distance_squared(at) <= reach {
            reach = visit(node.index);
        }
        reach = descend(far, at, reach, visit);
    }
    reach
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    fn points(n: usize) -> Vec<DVec3> {
        let mut random = Pcg64Mcg::seed_from_u64(n as u64);
        // On a coarse lattice, so that many coordinates are equal.
        (0..n).map(|_| DVec3::from_array([0; 3].map(|_| f64::from(random.random_range(0..6))))).collect()
    }

    #[test]
    fn everything_in_reach_is_visited_once() {
        for n in [0, 1, 2, 3, 7, 50, 200] {
            let points = points(n);
            let tree = KdTree::new(points.iter().copied());
            for at in [DVec3::ZERO, DVec3::new(2.0, 3.0, 1.0), DVec3::new(9.0, -1.0, 2.5)] {
                for reach in [0.0, 1.0, 5.0, f64::INFINITY] {
                    let mut seen = Vec::new();
                    tree.search(at, reach, |i| {
                        seen.push(i);
                        reach
                    });
                    seen.sort_unstable();
                    let expected = (0..n).filter(|&i| points[i].distance_squared(at) <= reach);
                    assert!(seen.into_iter().eq(expected), "{n} {at} {reach}");
                }
            }
        }
    }

    #[test]
    fn a_shrinking_reach_finds_the_nearest_and_looks_at_few() {
        let points = points(200);
        let tree = KdTree::new(points.iter().copied());
        for at in (0..6).map(|i| DVec3::new(f64::from(i), 5.3 - f64::from(i), 2.4)) {
            let (mut nearest, mut looks) = (f64::INFINITY, 0);
            tree.search(at, f64::INFINITY, |i| {
                looks += 1;
                nearest = nearest.min(points[i].distance_squared(at));
                nearest
            });
            assert_eq!(nearest, points.iter().map(|p| p.distance_squared(at)).fold(f64::INFINITY, f64::min));
            assert!(looks < 40, "{looks}");
        }
    }
}
