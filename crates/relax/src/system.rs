//! A symmetric positive system of 2x2 blocks over the edges of a mesh, and its solution by conjugate gradients.

use conjugate_gradients::solve;
use glam::{DMat2, DVec2};
use mesh_core::{HalfedgeId, Id as _, IdVec, Topology, VertexId};

/// Where each unknown's row and each face's entries are. Made once for a domain.
pub(crate) struct Pattern {
    /// Start of every row in `columns`, and the end of the last.
    starts: Vec<usize>,
    columns: Vec<u32>,
    /// For every halfedge the entries (from, to) and (to, from).
    entries: IdVec<HalfedgeId, [usize; 2]>,
}

impl Pattern {
    /// The pattern of a mesh with an unknown at every vertex.
    pub(crate) fn new(topology: &Topology) -> Self {
        let mut starts = Vec::with_capacity(topology.n_vertices() + 1);
        let mut columns = Vec::with_capacity(2 * topology.n_edges());
        starts.push(0);
        for v in (0..topology.n_vertices()).map(VertexId::new) {
            columns.extend(topology.one_ring(v).map(|w| w.0));
            starts.push(columns.len());
        }
        let entry = |v: VertexId, w: VertexId| {
            let row = starts[v.index()]..starts[v.index() + 1];
            // Every neighbour is in its row.
            row.start + columns[row].iter().position(|&c| c == w.0).unwrap_or(0)
        };
        let entries = |h: HalfedgeId| {
            let (v, w) = (topology.from(h), topology.to(h));
            [entry(v, w), entry(w, v)]
        };
        let entries = topology.faces().ids().flat_map(|f| topology.halfedges(f)).map(entries).collect();
        Self { starts, columns, entries }
    }
}

/// A symmetric positive system `H x = b`.
pub(crate) struct System<'a> {
    pattern: &'a Pattern,
    diagonal: Vec<DMat2>,
    blocks: Vec<DMat2>,
    right: Vec<DVec2>,
}

/// What one triangle adds: blocks and right side of its corners.
pub(crate) struct Element {
    pub(crate) diagonal: [DMat2; 3],
    /// Block (corner k, corner k + 1).
    pub(crate) off_diagonal: [DMat2; 3],
    pub(crate) right: [DVec2; 3],
}

impl<'a> System<'a> {
    /// The sum of all elements, one for each face.
    pub(crate) fn assemble(pattern: &'a Pattern, topology: &Topology, elements: &[Element]) -> Self {
        let n = pattern.starts.len() - 1;
        let mut system = Self {
            pattern,
            diagonal: vec![DMat2::ZERO; n],
            blocks: vec![DMat2::ZERO; pattern.columns.len()],
            right: vec![DVec2::ZERO; n],
        };
        for (f, element) in topology.faces().ids().zip(elements) {
            for (k, h) in topology.halfedges(f).into_iter().enumerate() {
                let v = topology.from(h).index();
                system.diagonal[v] += element.diagonal[k];
                system.right[v] += element.right[k];
                let [there, back] = pattern.entries[h];
                system.blocks[there] += element.off_diagonal[k];
                system.blocks[back] += element.off_diagonal[k].transpose();
            }
        }
        system
    }

    /// Solves by conjugate gradients with the inverse of the diagonal blocks as preconditioner, until the residual (in that
    /// metric) has fallen to the share `tolerance`, or for `most` iterations. Unknowns without an equation stay 0.
    pub(crate) fn solve(&self, tolerance: f64, most: usize) -> Vec<DVec2> {
        let inverse: Vec<DMat2> = self.diagonal.iter().map(|&d| pseudo_inverse(d)).collect();
        solve(self.right.clone(), |x, v| self.row(x, v), |r, v| inverse[v] * r, tolerance, most)
    }

    /// Row `v` of `H x`.
    fn row(&self, x: &[DVec2], v: usize) -> DVec2 {
        let Pattern { starts, columns, .. } = self.pattern;
        let row = starts[v]..starts[v + 1];
        let off_diagonal: DVec2 = columns[row.clone()].iter().zip(&self.blocks[row]).map(|(&w, &b)| b * x[w as usize]).sum();
        self.diagonal[v] * x[v] + off_diagonal
    }
}

/// The inverse of a symmetric block; only of the entries on its diagonal that are not 0 where it has none.
fn pseudo_inverse(d: DMat2) -> DMat2 {
    let inverse = d.inverse();
    if d.determinant() > 1e-14 * d.x_axis.x * d.y_axis.y && inverse.is_finite() {
        return inverse;
    }
    let one = |a: f64| if a > 0.0 { 1.0 / a } else { 0.0 };
    DMat2::from_diagonal(DVec2::new(one(d.x_axis.x), one(d.y_axis.y)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Laplacian plus identity on a tetrahedron, whose inverse is known, with one unknown left out.
    #[test]
    fn solves_a_laplacian() {
        let faces = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]].map(|f| f.map(VertexId));
        let topology = Topology::new(&IdVec::from_vec(faces.to_vec()), 4).unwrap();
        let pattern = Pattern::new(&topology);
        // Each edge is in two faces, each vertex in three: diagonal 3 + 1, off the diagonal -1.
        let only_x = DMat2::from_diagonal(DVec2::X);
        let element =
            || Element { diagonal: [only_x * (4.0 / 3.0); 3], off_diagonal: [only_x * -0.5; 3], right: [DVec2::ZERO; 3] };
        let elements: Vec<_> = (0..4).map(|_| element()).collect();
        let mut system = System::assemble(&pattern, &topology, &elements);
        let expected = [1.0, -2.0, 0.5, 3.0].map(|x| DVec2::new(x, 0.0));
        system.right = (0..4).map(|v| system.row(&expected, v)).collect();
        assert_eq!(system.right[0], DVec2::new(4.0 - 1.5, 0.0));
        let x = system.solve(1e-14, 20);
        assert!(x.iter().zip(&expected).all(|(a, b)| a.distance(*b) < 1e-12), "{x:?}");
    }
}
