//! First sites, far from each other and from the border (Gonzalez 1985): each is the candidate with the greatest gap.
//!
//! Candidates are in a tree of boxes, so that a new site looks only at those that it may come nearest to; with
//! hundreds of sites in a patch, looking at all candidates for each would take longer than all of Lloyd's steps.

use crate::candidates::Candidate;
use glam::DVec3;
use mesh_core::Bounds;

/// Boxes with at most so many candidates are not cut further. More make the search slower, fewer the tree larger.
const LEAF: usize = 8;

/// Indices of candidates, each the farthest from the border and all before it, in units of the local edge length; of equal ones the
/// first. `to_border` has the squared distance of every candidate from the border.
pub(crate) fn farthest(candidates: &[Candidate], to_border: &[f64], n: usize) -> Vec<usize> {
    let mut tree = Tree::new(candidates, to_border);
    let mut sites = Vec::with_capacity(n.min(candidates.len()));
    while sites.len() < n.min(candidates.len()) {
        let Some(root) = tree.nodes.last() else { break };
        let best = root.widest.index;
        sites.push(best);
        tree.put_site(tree.nodes.len() - 1, candidates[best].position);
    }
    sites
}

/// A candidate with its gap: its squared distance from the nearest site, times the factor of its place.
struct Item {
    position: DVec3,
    /// Gaps are in squared units of the local edge length: this is one over its square.
    factor: f64,
    gap: Gap,
}

/// A gap, and the index of the candidate that has it.
#[derive(Clone, Copy)]
struct Gap {
    width: f64,
    index: usize,
}

impl Gap {
    /// The wider one; of equal ones that of the first candidate.
    fn wider(self, other: Self) -> Self {
        if self.width.total_cmp(&other.width).then(other.index.cmp(&self.index)).is_ge() { self } else { other }
    }
}

/// A box of candidates: a range of the items.
struct Node {
    bounds: Bounds,
    least_factor: f64,
    widest: Gap,
    first: usize,
    end: usize,
    /// The nodes of both halves, `None` in a leaf.
    halves: Option<[usize; 2]>,
}

/// The root is the last node. Without candidates there is none.
struct Tree {
    items: Vec<Item>,
    nodes: Vec<Node>,
}

impl Tree {
    fn new(candidates: &[Candidate], to_border: &[f64]) -> Self {
        let item = |(index, (c, d)): (usize, (&Candidate, &f64))| {
            let factor = c.weight.sqrt();
            Item { position: c.position, factor, gap: Gap { width: d * factor, index } }
        };
        let mut tree = Self { items: candidates.iter().zip(to_border).enumerate().map(item).collect(), nodes: Vec::new() };
        tree.build(0, candidates.len());
        tree
    }

    /// Builds the nodes of a range and returns the last one, which has the whole range; `None` for an empty one.
    fn build(&mut self, first: usize, end: usize) -> Option<usize> {
        let items = &mut self.items[first..end];
        let bounds = Bounds::of(items.iter().map(|i| i.position))?;
        let widest = items.iter().map(|i| i.gap).reduce(Gap::wider)?;
        let least_factor = items.iter().map(|i| i.factor).fold(f64::INFINITY, f64::min);
        let mut halves = None;
        if items.len() > LEAF {
            let axis = (bounds.max - bounds.min).max_position();
            let middle = items.len() / 2;
            items.select_nth_unstable_by(middle, |a, b| {
                a.position[axis].total_cmp(&b.position[axis]).then(a.gap.index.cmp(&b.gap.index))
            });
            halves = self.build(first, first + middle).zip(self.build(first + middle, end)).map(|(a, b)| [a, b]);
        }
        self.nodes.push(Node { bounds, least_factor, widest, first, end, halves });
        Some(self.nodes.len() - 1)
    }

    /// Narrows the gaps of a node's candidates to what a new site leaves.
    fn put_site(&mut self, node: usize, site: DVec3) {
        let Node { bounds, least_factor, widest, first, end, halves } = &self.nodes[node];
        let outside = (bounds.min - site).max(site - bounds.max).max(DVec3::ZERO);
        // No candidate of the box is nearer than the box: rounding is monotone, so this holds to the last bit.
        if outside.length_squared() * least_factor >= widest.width {
            return;
        }
        let widest = match *halves {
            Some([a, b]) => {
                self.put_site(a, site);
                self.put_site(b, site);
                self.nodes[a].widest.wider(self.nodes[b].widest)
            }
            None => {
                let items = &mut self.items[*first..*end];
                for item in items.iter_mut() {
                    item.gap.width = item.gap.width.min(item.position.distance_squared(site) * item.factor);
                }
                items.iter().map(|i| i.gap).reduce(Gap::wider).unwrap_or(*widest)
            }
        };
        self.nodes[node].widest = widest;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::candidates::spread;
    use region_map::Sizing;

    /// What the tree must give: all gaps looked at for every site.
    fn by_looking_at_all(candidates: &[Candidate], to_border: &[f64], n: usize) -> Vec<usize> {
        let mut gap: Vec<f64> = candidates.iter().zip(to_border).map(|(c, d)| d * c.weight.sqrt()).collect();
        let mut sites = Vec::new();
        for _ in 0..n.min(candidates.len()) {
            let best = (0..gap.len()).max_by(|&a, &b| gap[a].total_cmp(&gap[b]).then(b.cmp(&a))).unwrap();
            sites.push(best);
            let position = candidates[best].position;
            for (g, c) in gap.iter_mut().zip(candidates) {
                *g = g.min(c.position.distance_squared(position) * c.weight.sqrt());
            }
        }
        sites
    }

    #[test]
    fn sites_are_those_of_looking_at_all() {
        let mesh = fixtures::part(4);
        let faces: Vec<_> = mesh.faces().ids().collect();
        let graded = Sizing { relative: mesh.positions().iter().map(|p| 1.0 + 0.5 * p.x.sin()).collect() };
        for sizing in [Sizing::uniform(&mesh), graded] {
            for n in [0, 1, LEAF, LEAF + 1, 700] {
                let candidates = spread(&mesh, &faces, &sizing, n, 3);
                let border = [mesh.position(mesh_core::VertexId(0))];
                let to_border: Vec<f64> = candidates.iter().map(|c| c.position.distance_squared(border[0])).collect();
                for n_sites in [0, 1, 2, 60, 1000] {
                    let sites = farthest(&candidates, &to_border, n_sites);
                    assert_eq!(sites, by_looking_at_all(&candidates, &to_border, n_sites), "{n} candidates, {n_sites} sites");
                }
            }
        }
    }

    #[test]
    fn of_equal_gaps_the_first_is_taken() {
        // Candidates on a lattice, some of them at one place, without a border: most gaps have many equals.
        let at = |i: usize| {
            let lattice = DVec3::new((i % 7) as f64, (i / 7 % 5) as f64, 0.0);
            let point = mesh_core::SurfacePoint::at_corner(mesh_core::FaceId(0), 0);
            Candidate { point, position: lattice, weight: 1.0 }
        };
        let candidates: Vec<Candidate> = (0..80).map(at).collect();
        for to_border in [vec![f64::INFINITY; 80], vec![4.0; 80]] {
            let expected = by_looking_at_all(&candidates, &to_border, 80);
            assert_eq!(farthest(&candidates, &to_border, 80), expected);
            assert_eq!(expected[0], 0);
        }
    }
}
