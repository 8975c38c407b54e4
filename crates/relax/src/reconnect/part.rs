//! A part of the base mesh, relaxed on its own while all around it is held.

use super::coarse::{BaseFace, Change, Coarse, FaceIndex};
use crate::ShapeOptions;
use crate::freedom::Freedom;
use crate::part::{Corners, Part};
use crate::placed_vertex::PlacedVertex;
use crate::shape::{costs, optimise_shape};
use mesh_core::{Id as _, VertexId};

/// A region after a change, relaxed.
#[derive(Clone, Debug)]
pub(crate) struct RelaxedPart {
    /// The cost of every face: those of the region that stay, in order, then the new ones.
    pub(crate) costs: Vec<f64>,
    /// The places of all vertices that were free.
    pub(crate) placed: Vec<(VertexId, PlacedVertex)>,
}

/// Relaxes a region (faces in rising order) after a change, with all held that faces outside have too. `None` where the region is no
/// manifold: it meets itself in a vertex.
pub(crate) fn relaxed(coarse: &Coarse, region: &[FaceIndex], change: &Change, options: &ShapeOptions) -> Option<RelaxedPart> {
    let faces: Vec<BaseFace> = coarse.after(region, change).copied().collect();
    let triangles: Vec<Corners> = faces.iter().flat_map(BaseFace::parts).collect();
    let held = held(coarse, region);
    let is_held = |v| held.binary_search(&v).is_ok();
    let part = Part::new(coarse.domain, &triangles, |v| if is_held(v) { Freedom::Fixed } else { change.state(coarse, v).1 })?;
    let targets = faces.iter().flat_map(|f| [coarse.targets[f.sheet.index()]; 4]).collect();
    let (placement, _) = optimise_shape(&part.domain, part.placement(|v| change.state(coarse, v).0), &targets, options);
    let costs = costs(&part.domain, &placement, &targets, options).chunks(4).map(|parts| parts.iter().sum()).collect();
    Some(RelaxedPart { costs, placed: part.moved(&placement) })
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
