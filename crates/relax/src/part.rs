//! A part of a domain as a domain of its own, its vertices numbered anew: what happens there costs what the part costs.

use crate::domain::{CornerNormal, Domain, Freedom, Rail, RailEnd};
use crate::placement::{Placement, Spot};
use mesh_core::{HalfedgeId, Id as _, IdVec, Topology, VertexId};

/// Corners of a triangle, and the normals that it takes at them.
pub(crate) type Corners = ([VertexId; 3], [CornerNormal; 3]);

/// Some triangles of a domain.
pub(crate) struct Part {
    /// The vertices as they are numbered in the whole, in rising order.
    pub(crate) vertices: Vec<VertexId>,
    topology: Topology,
    freedoms: IdVec<VertexId, Freedom>,
    normals: IdVec<HalfedgeId, CornerNormal>,
}

impl Part {
    /// The part of some triangles, with freedoms given by vertices of the whole. A vertex on an arc is held if one of its neighbours there
    /// is not in the part. `None` where the triangles are no manifold: they meet in a vertex.
    pub(crate) fn new(triangles: &[Corners], freedom: impl Fn(VertexId) -> Freedom) -> Option<Self> {
        let mut vertices: Vec<VertexId> = triangles.iter().flat_map(|t| t.0).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let number = |v: VertexId| vertices.binary_search(&v).ok().map(VertexId::new);
        let faces: IdVec<_, [VertexId; 3]> = triangles.iter().map(|t| t.0.map(|v| number(v).unwrap_or(v))).collect();
        let topology = Topology::new(&faces, vertices.len()).ok()?;
        let local = |end: RailEnd| Some(RailEnd { vertex: number(end.vertex)?, ..end });
        let local_freedom = |&v: &VertexId| match freedom(v) {
            Freedom::Rail(rail) => match (local(rail.behind), local(rail.ahead)) {
                (Some(behind), Some(ahead)) => Freedom::Rail(Rail { behind, ahead, ..rail }),
                _ => Freedom::Fixed,
            },
            freedom => freedom,
        };
        let freedoms = vertices.iter().map(local_freedom).collect();
        let normals = triangles.iter().flat_map(|t| t.1).collect();
        Some(Self { vertices, topology, freedoms, normals })
    }

    /// The part as a domain of its own.
    pub(crate) fn domain<'a>(&'a self, whole: &Domain<'a>) -> Domain<'a> {
        let Self { topology, freedoms, normals, .. } = self;
        Domain { topology, freedoms: freedoms.clone(), normals: normals.clone(), ..*whole }
    }

    /// The places of its vertices, given by those of the whole.
    pub(crate) fn placement(&self, spot: impl Fn(VertexId) -> Spot) -> Placement {
        Placement(self.vertices.iter().map(|&v| spot(v)).collect())
    }

    /// The vertices that may move as they are numbered in the whole, and where a placement of the part has them.
    pub(crate) fn moved(&self, placement: &Placement) -> Vec<(VertexId, Spot)> {
        let numbered = self.vertices.iter().enumerate().map(|(i, &v)| (VertexId::new(i), v));
        numbered.filter(|(i, _)| !matches!(self.freedoms[*i], Freedom::Fixed)).map(|(i, v)| (v, placement[i])).collect()
    }
}
