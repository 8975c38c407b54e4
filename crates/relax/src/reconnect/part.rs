//! A part of the base mesh, relaxed on its own while all around it is held.

use super::coarse::{BaseFace, Change, Coarse, FaceIndex};
use crate::ShapeOptions;
use crate::domain::{CornerNormal, Domain, Freedom, Rail, RailEnd};
use crate::placement::{Placement, Spot};
use crate::shape::{costs, optimise_shape};
use mesh_core::{HalfedgeId, Id as _, IdVec, Topology, VertexId};

/// A region after a change, relaxed.
#[derive(Clone, Debug)]
pub(crate) struct RelaxedPart {
    /// The cost of every face: those of the region that stay, in order, then the new ones.
    pub(crate) costs: Vec<f64>,
    /// The places of all vertices that were free.
    pub(crate) placed: Vec<(VertexId, Spot)>,
}

/// Relaxes a region (faces in rising order) after a change, with all held that faces outside have too. `None` where the region is no
/// manifold: it meets itself in a vertex.
pub(crate) fn relaxed(coarse: &Coarse, region: &[FaceIndex], change: &Change, options: &ShapeOptions) -> Option<RelaxedPart> {
    let faces: Vec<BaseFace> = coarse.after(region, change).copied().collect();
    let Part { vertices, topology, freedoms, normals, start, targets } = Part::new(coarse, region, &faces, change)?;
    let &Domain { surface, longest_move, .. } = coarse.domain;
    let domain = Domain::free(surface, &topology, freedoms, normals, longest_move);
    let (placement, _) = optimise_shape(&domain, start, &targets, options);
    let costs = costs(&domain, &placement, &targets, options).chunks(4).map(|parts| parts.iter().sum()).collect();
    let numbered = vertices.into_iter().enumerate().map(|(i, v)| (VertexId::new(i), v));
    let free = numbered.filter(|(i, _)| !matches!(domain.freedoms[*i], Freedom::Fixed));
    let placed = free.map(|(i, v)| (v, placement[i])).collect();
    Some(RelaxedPart { costs, placed })
}

/// A domain of its own, with its vertices numbered anew.
struct Part {
    vertices: Vec<VertexId>,
    topology: Topology,
    freedoms: IdVec<VertexId, Freedom>,
    normals: IdVec<HalfedgeId, CornerNormal>,
    start: Placement,
    targets: IdVec<mesh_core::FaceId, f64>,
}

impl Part {
    fn new(coarse: &Coarse, region: &[FaceIndex], faces: &[BaseFace], change: &Change) -> Option<Self> {
        let mut vertices: Vec<VertexId> = faces.iter().flat_map(BaseFace::vertices).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let number = |v: VertexId| vertices.binary_search(&v).ok().map(VertexId::new);
        let parts = || faces.iter().flat_map(BaseFace::parts);
        let triangles: IdVec<_, [VertexId; 3]> = parts().map(|(t, _)| t.map(|v| number(v).unwrap_or(v))).collect();
        let topology = Topology::new(&triangles, vertices.len()).ok()?;
        let held = held(coarse, region);
        let local = |end: RailEnd| Some(RailEnd { vertex: number(end.vertex)?, ..end });
        let freedom = |v: &VertexId| match change.state(coarse, *v).1 {
            _ if held.binary_search(v).is_ok() => Freedom::Fixed,
            Freedom::Rail(rail) => match (local(rail.behind), local(rail.ahead)) {
                (Some(behind), Some(ahead)) => Freedom::Rail(Rail { behind, ahead, ..rail }),
                _ => Freedom::Fixed,
            },
            freedom => freedom,
        };
        Some(Self {
            freedoms: vertices.iter().map(freedom).collect(),
            normals: parts().flat_map(|(_, normals)| normals).collect(),
            start: Placement(vertices.iter().map(|&v| change.state(coarse, v).0).collect()),
            targets: faces.iter().flat_map(|f| [coarse.targets[f.sheet.index()]; 4]).collect(),
            vertices,
            topology,
        })
    }
}

/// The vertices of a region that faces outside of it have too, in rising order.
fn held(coarse: &Coarse, region: &[FaceIndex]) -> Vec<VertexId> {
    let is_outside = |f: &FaceIndex| region.binary_search(f).is_err();
    let corners = region.iter().filter_map(|&f| coarse.face(f)).flat_map(|f| f.corners);
    let mut around: Vec<FaceIndex> = corners.flat_map(|v| coarse.stars[v].iter().copied()).filter(is_outside).collect();
    around.sort_unstable();
    around.dedup();
    let mut held: Vec<VertexId> = around.into_iter().filter_map(|f| coarse.face(f)).flat_map(BaseFace::vertices).collect();
    held.sort_unstable();
    held.dedup();
    held
}
