//! A part of a domain as a domain of its own, its vertices numbered anew: what happens there costs what the part costs.

use crate::ShapeOptions;
use crate::corner_normal::CornerNormal;
use crate::freedom::{ArcNeighbour, Freedom, OnArc};
use crate::measured::Measured;
use crate::movable_domain::MovableDomain;
use crate::placed_vertex::PlacedVertex;
use crate::placement::Placement;
use crate::shape::{costs, optimise_shape};
use mesh_core::{FaceId, Id as _, IdVec, Topology, VertexId};

/// A triangle of a part, with the vertices as they are numbered in the whole.
#[derive(Clone, Copy, Debug)]
pub struct PartFace {
    /// Its corners, counter-clockwise seen from outside.
    pub corners: [VertexId; 3],
    /// The normals that it takes at them.
    pub normals: [CornerNormal; 3],
    /// The area that it shall have, above 0, in squares of the unit of the mesh.
    pub target_area: f64,
}

/// Some triangles of a domain.
pub struct Part<'a> {
    /// The vertices as they are numbered in the whole, in rising order.
    pub(crate) vertices: Vec<VertexId>,
    pub(crate) domain: MovableDomain<'a>,
    /// The areas that the faces shall have.
    pub(crate) targets: IdVec<FaceId, f64>,
}

/// A part, relaxed.
#[derive(Clone, Debug)]
pub struct RelaxedPart {
    /// By how much the shape energy of every face exceeds the least one.
    pub costs: Vec<f64>,
    /// The vertices that were free to move, as they are numbered in the whole and in rising order, and where they are now.
    pub moved: Vec<(VertexId, PlacedVertex)>,
}

impl<'a> Part<'a> {
    /// The part of some triangles, with freedoms given by vertices of the whole. A vertex on an arc is held if one of its
    /// neighbours there is not in the part. `None` where the triangles are no manifold: they meet in a vertex.
    pub(crate) fn new(whole: &MovableDomain<'a>, triangles: &[PartFace], freedom: impl Fn(VertexId) -> Freedom) -> Option<Self> {
        let mut vertices: Vec<VertexId> = triangles.iter().flat_map(|t| t.corners).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let number = |v: VertexId| vertices.binary_search(&v).ok().map(VertexId::new);
        let faces: IdVec<_, [VertexId; 3]> = triangles.iter().map(|t| t.corners.map(|v| number(v).unwrap_or(v))).collect();
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
        let normals = triangles.iter().flat_map(|t| t.normals).collect();
        let targets = triangles.iter().map(|t| t.target_area).collect();
        Some(Self { domain: MovableDomain { topology, freedoms, normals, ..*whole }, vertices, targets })
    }

    /// Optimises the shapes of its triangles, from where `placed` has the vertices of the whole.
    ///
    /// Without the caution of [`relax`](crate::relax): where it leaves triangles inverted, their costs tell. `options` is what
    /// [`ShapeOptions::check`] finds right.
    pub fn relaxed(&self, placed: impl Fn(VertexId) -> PlacedVertex, options: &ShapeOptions) -> RelaxedPart {
        let start = Measured::new(&self.domain, self.placement(placed));
        let (measured, _) = optimise_shape(&self.domain, start, &self.targets, options);
        RelaxedPart { costs: costs(&measured, &self.targets, options), moved: self.moved(measured.placement()) }
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
