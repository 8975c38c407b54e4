//! A part of a domain as a domain of its own, its vertices numbered anew: what happens there costs what the part costs.

use crate::corner_normal::CornerNormal;
use crate::freedom::{ArcNeighbour, Freedom, OnArc};
use crate::movable_domain::MovableDomain;
use crate::placed_vertex::PlacedVertex;
use crate::placement::Placement;
use mesh_core::{Id as _, IdVec, Topology, VertexId};

/// Corners of a triangle, and the normals that it takes at them.
pub(crate) type Corners = ([VertexId; 3], [CornerNormal; 3]);

/// Some triangles of a domain.
pub(crate) struct Part<'a> {
    /// The vertices as they are numbered in the whole, in rising order.
    pub(crate) vertices: Vec<VertexId>,
    pub(crate) domain: MovableDomain<'a>,
}

impl<'a> Part<'a> {
    /// The part of some triangles, with freedoms given by vertices of the whole. A vertex on an arc is held if one of its neighbours there
    /// is not in the part. `None` where the triangles are no manifold: they meet in a vertex.
    pub(crate) fn new(whole: &MovableDomain<'a>, triangles: &[Corners], freedom: impl Fn(VertexId) -> Freedom) -> Option<Self> {
        let mut vertices: Vec<VertexId> = triangles.iter().flat_map(|t| t.0).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let number = |v: VertexId| vertices.binary_search(&v).ok().map(VertexId::new);
        let faces: IdVec<_, [VertexId; 3]> = triangles.iter().map(|t| t.0.map(|v| number(v).unwrap_or(v))).collect();
        let topology = Topology::new(&faces, vertices.len()).ok()?.into();
        let local = |end: ArcNeighbour| Some(ArcNeighbour { vertex: number(end.vertex)?, ..end });
        let local_freedom = |&v: &VertexId| match freedom(v) {
            Freedom::Arc(on_arc) => match (local(on_arc.behind), local(on_arc.ahead)) {
                (Some(behind), Some(ahead)) => Freedom::Arc(OnArc { behind, ahead, ..on_arc }),
                _ => Freedom::Fixed,
            },
            freedom => freedom,
        };
        let freedoms = vertices.iter().map(local_freedom).collect();
        let normals = triangles.iter().flat_map(|t| t.1).collect();
        Some(Self { domain: MovableDomain { topology, freedoms, normals, ..*whole }, vertices })
    }

    /// The places of its vertices, given by those of the whole.
    pub(crate) fn placement(&self, placed: impl Fn(VertexId) -> PlacedVertex) -> Placement {
        Placement(self.vertices.iter().map(|&v| placed(v)).collect())
    }

    /// The vertices that may move as they are numbered in the whole, and where a placement of the part has them.
    pub(crate) fn moved(&self, placement: &Placement) -> Vec<(VertexId, PlacedVertex)> {
        let numbered = self.vertices.iter().enumerate().map(|(i, &v)| (VertexId::new(i), v));
        let is_free = |i: VertexId| !matches!(self.domain.freedoms[i], Freedom::Fixed);
        numbered.filter(|(i, _)| is_free(*i)).map(|(i, v)| (v, placement[i])).collect()
    }
}
