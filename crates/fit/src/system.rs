//! The least squares problem of a round: one displacement for every vertex, found by conjugate gradients.
//!
//! The matrix is kept as 3x3 blocks for each pair of corners of each face. A product gathers by vertices, each from its fan in
//! order, so it is the same on any number of threads.

use conjugate_gradients::solve;
use glam::{DMat3, DVec3};
use mesh_core::{FaceId, HalfedgeId, Id, IdVec, Topology, VertexId};
use rayon::prelude::*;

/// Faces or vertices that one task works on.
const BLOCK: usize = 2048;

/// In which directions a vertex may move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Freedom {
    /// In none.
    Fixed,
    /// Along this unit vector, both ways.
    Along(DVec3),
    /// In all.
    Free,
}

impl Freedom {
    fn project(self, x: DVec3) -> DVec3 {
        match self {
            Self::Fixed => DVec3::ZERO,
            Self::Along(n) => x.dot(n) * n,
            Self::Free => x,
        }
    }

    /// The inverse of a positive block on what is free.
    fn inverse(self, block: DMat3) -> DMat3 {
        match self {
            Self::Fixed => DMat3::ZERO,
            Self::Along(n) => {
                let stiffness = n.dot(block * n);
                let scaled = if stiffness > 0.0 { n / stiffness } else { DVec3::ZERO };
                DMat3::from_cols(n.x * scaled, n.y * scaled, n.z * scaled)
            }
            Self::Free => block.inverse_or_zero(),
        }
    }
}

/// What one face adds: the blocks of corner `k` with itself and with the next corner, and the right side.
#[derive(Clone, Copy)]
pub(crate) struct Element {
    own: [DMat3; 3],
    next: [DMat3; 3],
    right: [DVec3; 3],
}

impl Element {
    pub(crate) const ZERO: Self = Self { own: [DMat3::ZERO; 3], next: [DMat3::ZERO; 3], right: [DVec3::ZERO; 3] };

    /// Asks a point of the face, given by weights of its corners, to move by `way` along the unit vector `normal`.
    pub(crate) fn ask(&mut self, weights: DVec3, normal: DVec3, way: f64, weight: f64) {
        let plane = DMat3::from_cols(normal.x * normal, normal.y * normal, normal.z * normal);
        for k in 0..3 {
            self.own[k] += weight * weights[k] * weights[k] * plane;
            self.next[k] += weight * weights[k] * weights[(k + 1) % 3] * plane;
            self.right[k] += weight * weights[k] * way * normal;
        }
    }

    /// Holds the vertices, which have moved so far already: with the weight `shape` against any difference of two, with `hold`
    /// against each by itself.
    pub(crate) fn hold(&mut self, moved: [DVec3; 3], shape: f64, hold: f64) {
        let mean = (moved[0] + moved[1] + moved[2]) / 3.0;
        for (k, moved) in moved.into_iter().enumerate() {
            self.own[k] += (2.0 * shape + hold) * DMat3::IDENTITY;
            self.next[k] -= shape * DMat3::IDENTITY;
            self.right[k] -= 3.0 * shape * (moved - mean) + hold * moved;
        }
    }
}

/// `A x = b` on what the vertices are free to do.
pub(crate) struct System<'a> {
    topology: &'a Topology,
    freedoms: IdVec<VertexId, Freedom>,
    elements: IdVec<FaceId, Element>,
}

impl<'a> System<'a> {
    /// The sum of the elements of all faces.
    pub(crate) fn new(
        topology: &'a Topology,
        freedoms: IdVec<VertexId, Freedom>,
        element: impl Fn(FaceId) -> Element + Sync,
    ) -> Self {
        let elements = (0..topology.n_faces()).into_par_iter().with_min_len(BLOCK).map(|f| element(FaceId::new(f)));
        Self { topology, freedoms, elements: IdVec::from_vec(elements.collect()) }
    }

    /// Solves until the residual, in the metric of the inverse blocks on the diagonal, has fallen to the share `tolerance`, or
    /// for `most` iterations.
    pub(crate) fn solve(&self, tolerance: f64, most: usize) -> IdVec<VertexId, DVec3> {
        let inverse = self.each(|v| {
            let own = self.topology.fan(v).map(|h| self.elements[h.face()].own[h.corner()]);
            self.freedoms[v].inverse(own.fold(DMat3::ZERO, |sum, block| sum + block))
        });
        let right = self.each(|v| {
            let right = self.topology.fan(v).map(|h| self.elements[h.face()].right[h.corner()]);
            self.freedoms[v].project(right.sum())
        });
        IdVec::from_vec(solve(right, |x, i| self.row(x, VertexId::new(i)), |r, i| inverse[i] * r, tolerance, most))
    }

    /// The row of a vertex of `A x`.
    fn row(&self, x: &[DVec3], v: VertexId) -> DVec3 {
        let at = |h: HalfedgeId| x[self.topology.from(h).index()];
        let part = |h: HalfedgeId| {
            let (element, k) = (&self.elements[h.face()], h.corner());
            element.own[k] * at(h) + element.next[k] * at(h.next()) + element.next[(k + 2) % 3] * at(h.prev())
        };
        self.freedoms[v].project(self.topology.fan(v).map(part).sum())
    }

    fn each<T: Send>(&self, value: impl Fn(VertexId) -> T + Sync) -> Vec<T> {
        (0..self.freedoms.len()).into_par_iter().with_min_len(BLOCK).map(|i| value(VertexId::new(i))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> Topology {
        Topology::new(&[[0, 1, 2], [0, 2, 3]].map(|f| f.map(VertexId)).into_iter().collect(), 4).unwrap()
    }

    /// Ways asked of points that come from displacements of the corners, along three directions: the displacements are found.
    #[test]
    fn finds_the_displacements_that_ways_come_from() {
        let (topology, wanted) = (square(), [DVec3::X, DVec3::new(0.3, -2.0, 1.0), DVec3::ZERO, 3.0 * DVec3::Z]);
        let element = |f: FaceId| {
            let v = topology.face(f);
            let mut element = Element::ZERO;
            for weights in [DVec3::new(0.6, 0.2, 0.2), DVec3::new(0.1, 0.8, 0.1), DVec3::new(0.3, 0.3, 0.4)] {
                let moved: DVec3 = (0..3).map(|c| weights[c] * wanted[v[c].index()]).sum();
                for normal in [DVec3::X, DVec3::Y, DVec3::new(0.6, 0.0, 0.8)] {
                    element.ask(weights, normal, moved.dot(normal), 0.7);
                }
            }
            element
        };
        let found = System::new(&topology, IdVec::filled(Freedom::Free, 4), element).solve(1e-13, 100);
        assert!(found.iter().zip(wanted).all(|(a, b)| a.distance(b) < 1e-8), "{found:?}");
    }

    /// All corners asked to move by 1 along z, one fixed, one free only across, one along a slope: the rest get there.
    #[test]
    fn vertices_move_only_as_they_are_free_to() {
        let topology = square();
        let freedoms = [Freedom::Free, Freedom::Fixed, Freedom::Along(DVec3::X), Freedom::Along(DVec3::new(0.0, 0.6, 0.8))];
        let element = |_| {
            let mut element = Element::ZERO;
            DVec3::AXES.into_iter().for_each(|corner| element.ask(corner, DVec3::Z, 1.0, 1.0));
            element.hold([DVec3::ZERO; 3], 0.0, 1e-9);
            element
        };
        let found = System::new(&topology, freedoms.into_iter().collect(), element).solve(1e-12, 20);
        let expected = [DVec3::Z, DVec3::ZERO, DVec3::ZERO, DVec3::new(0.0, 0.75, 1.0)];
        assert!(found.iter().zip(expected).all(|(a, b)| a.distance(b) < 1e-6), "{found:?}");
    }

    /// What has moved all together goes back when it is held by itself, and stays when only its shape is held.
    #[test]
    fn holding_takes_back_what_has_moved() {
        let topology = square();
        let solve = |shape: f64, hold: f64| {
            let element = |_| {
                let mut element = Element::ZERO;
                element.hold([DVec3::Z; 3], shape, hold);
                element
            };
            System::new(&topology, IdVec::filled(Freedom::Free, 4), element).solve(1e-13, 50)
        };
        assert!(solve(1.0, 0.5).iter().all(|x| x.distance(-DVec3::Z) < 1e-9));
        assert!(solve(1.0, 0.0).iter().all(|x| x.length() < 1e-9));
    }
}
