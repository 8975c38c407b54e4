//! The edges of any faces, manifold or not: the one connectivity that the checks here stand on.

use mesh_core::{FaceId, IdVec, VertexId};
use rayon::prelude::*;

/// One face's side of an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Side {
    /// The lower end, then the higher one.
    pub(crate) ends: [VertexId; 2],
    /// The face.
    pub(crate) face: FaceId,
    corner: u8,
    /// Whether the face runs from the lower to the higher end.
    pub(crate) forward: bool,
}

impl Side {
    /// The corner of the face that the side starts at.
    pub(crate) fn corner(&self) -> usize {
        self.corner.into()
    }

    /// The corners of the face at the lower and at the higher end.
    pub(crate) fn corners(&self) -> [usize; 2] {
        let (corner, next) = (self.corner(), (self.corner() + 1) % 3);
        if self.forward { [corner, next] } else { [next, corner] }
    }
}

/// All edges in the order of their ends, each with all its sides.
#[derive(Debug)]
pub(crate) struct Edges {
    sides: Vec<Side>,
}

impl Edges {
    /// Collects and sorts the sides of all faces.
    pub(crate) fn of(faces: &IdVec<FaceId, [VertexId; 3]>) -> Self {
        let mut sides = Vec::with_capacity(3 * faces.len());
        for (face, v) in faces.enumerate() {
            for (corner, [a, b]) in (0..).zip([[v[0], v[1]], [v[1], v[2]], [v[2], v[0]]]) {
                sides.push(Side { ends: [a.min(b), a.max(b)], face, corner, forward: a < b });
            }
        }
        sides.par_sort_unstable();
        Self { sides }
    }

    /// The sides of each edge.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &[Side]> {
        self.sides.chunk_by(|a, b| a.ends == b.ends)
    }

    /// The ends of the edges with exactly one face.
    pub(crate) fn border(&self) -> impl Iterator<Item = [VertexId; 2]> {
        self.iter().filter(|sides| sides.len() == 1).map(|sides| sides[0].ends)
    }

    /// Whether every edge with two faces runs once each way.
    pub(crate) fn oriented(&self) -> bool {
        self.iter().all(|sides| sides.len() != 2 || sides[0].forward != sides[1].forward)
    }
}
