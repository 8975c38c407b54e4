//! [`Level`]: a mesh that is split once, its new vertices predicted in the middles of its edges.
//!
//! New vertices are numbered after those that are there, by the edges, which are numbered in the order in which the faces have them first:
//! edge 0 of face 0 is that from its corner 0 to its corner 1. The crate `subdiv` does the same.

use crate::{DisplacementError, Frame, LevelDisplacement, Residual};
use glam::DVec3;
use mesh_core::{EdgeId, FaceId, HalfedgeId, Topology, TriMesh, VertexId, vector_area};

/// A level with its edges.
pub(crate) struct Level {
    number: u32,
    mesh: TriMesh,
    topology: Topology,
}

/// Where a new vertex is expected, and the frame there.
pub(crate) struct Prediction {
    pub(crate) middle: DVec3,
    pub(crate) frame: Frame,
}

impl Level {
    /// Fails where the faces are no oriented manifold.
    pub(crate) fn new(number: u32, mesh: TriMesh) -> Result<Self, DisplacementError> {
        let topology = Topology::new(mesh.faces(), mesh.n_vertices())
            .map_err(|source| DisplacementError::NotManifold { level: number, source })?;
        Ok(Self { number, mesh, topology })
    }

    pub(crate) fn mesh(&self) -> &TriMesh {
        &self.mesh
    }

    /// How many vertices it has when it is split.
    pub(crate) fn n_finer_vertices(&self) -> usize {
        self.mesh.n_vertices() + self.topology.n_edges()
    }

    /// Of all new vertices, in their order.
    pub(crate) fn predictions(&self) -> impl Iterator<Item = Prediction> {
        self.topology.edge_ids().map(|e| self.prediction(e))
    }

    fn prediction(&self, e: EdgeId) -> Prediction {
        let [v, w] = self.topology.ends(e);
        let [a, b] = [v.min(w), v.max(w)].map(|end| self.mesh.position(end));
        let area = |f: FaceId| vector_area(self.mesh.triangle(f));
        let (f, g) = self.topology.edge_faces(e);
        Prediction { middle: a.midpoint(b), frame: Frame::new([a, b], area(f) + g.map_or(DVec3::ZERO, area)) }
    }

    /// The next level: each face split in four, and the new vertices displaced. Fails where there is not a number for each, or where a new
    /// vertex is not finite.
    pub(crate) fn displaced(&self, by: &LevelDisplacement, residual: Residual) -> Result<TriMesh, DisplacementError> {
        let (level, n) = (self.number + 1, self.topology.n_edges());
        for (what, found, expected) in
            [("scalar displacements", by.scalar.len(), n), ("numbers of residuals", by.residual.len(), 2 * n)]
        {
            if found != expected {
                return Err(DisplacementError::Count { level, what, found, expected });
            }
        }
        let tangential = match residual {
            Residual::Kept => by.residual.values(),
            Residual::Dropped => vec![0.0; 2 * n],
        };
        let mut positions = self.mesh.positions().as_slice().to_vec();
        let numbers = by.scalar.values().into_iter().zip(tangential.chunks_exact(2));
        let new = self.predictions().zip(numbers).map(|(at, (scalar, t))| at.middle + at.frame.vector(scalar, [t[0], t[1]]));
        positions.extend(new);
        TriMesh::new(positions, self.split_faces()).map_err(|source| DisplacementError::NoMesh { level, source })
    }

    /// The four children of every face, as the crate `subdiv` has them.
    fn split_faces(&self) -> Vec<[u32; 3]> {
        let n = self.mesh.n_vertices() as u32;
        let middle = |h: HalfedgeId| n + self.topology.edge(h).0;
        let children = |(f, corners): (FaceId, &[VertexId; 3])| {
            let [ab, bc, ca] = self.topology.halfedges(f).map(middle);
            let [a, b, c] = corners.map(|v| v.0);
            [[a, ab, ca], [b, bc, ab], [c, ca, bc], [bc, ca, ab]]
        };
        self.topology.faces().enumerate().flat_map(children).collect()
    }
}
