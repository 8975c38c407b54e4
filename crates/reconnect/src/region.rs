//! A part of the base mesh, relaxed on its own while all around it is held.

use crate::base_face::BaseFace;
use crate::change::Change;
use crate::editable_base::{EditableBase, FaceIndex};
use mesh_core::{Id as _, VertexId};
use relax::ShapeOptions;
use relax::parts::{Freedom, PartFace, PlacedVertex};

/// A region after a change, relaxed.
#[derive(Clone, Debug)]
pub(crate) struct RelaxedRegion {
    /// The cost of every face: those of the region that stay, in order, then the new ones.
    pub(crate) costs: Vec<f64>,
    /// The places of all vertices that were free.
    pub(crate) moved: Vec<(VertexId, PlacedVertex)>,
}

/// Relaxes a region (faces in rising order) after a change, with all held that faces outside have too. `None` where the region is
/// no manifold: it meets itself in a vertex.
pub(crate) fn relaxed(
    base: &EditableBase,
    region: &[FaceIndex],
    change: &Change,
    options: &ShapeOptions,
) -> Option<RelaxedRegion> {
    let faces: Vec<PartFace> = change.after(base, region).flat_map(|face| face.parts(base.whole.mean_area(face.sheet))).collect();
    let held = held(base, region);
    let is_held = |v| held.binary_search(&v).is_ok();
    let part = base.whole.part(&faces, |v| if is_held(v) { Freedom::Fixed } else { change.state(base, v).1 })?;
    let relaxed = part.relaxed(|v| change.state(base, v).0, options);
    let costs = relaxed.costs.chunks(4).map(|parts| parts.iter().sum()).collect();
    Some(RelaxedRegion { costs, moved: relaxed.moved })
}

/// The vertices of a region that faces outside of it have too, in rising order.
fn held(base: &EditableBase, region: &[FaceIndex]) -> Vec<VertexId> {
    let is_outside = |f: &FaceIndex| region.binary_search(f).is_err();
    let corners = region.iter().filter_map(|&f| base.face(f)).flat_map(|f| f.corners);
    let mut around: Vec<FaceIndex> = corners.flat_map(|v| base.stars[v].iter().copied()).filter(is_outside).collect();
    around.sort_unstable();
    around.dedup();
    let mut held: Vec<VertexId> = around.into_iter().filter_map(|f| base.face(f)).flat_map(BaseFace::vertices).collect();
    held.sort_unstable();
    held.dedup();
    held
}

impl RelaxedRegion {
    /// Carries a change out, with the costs and the places that were found for its region.
    pub(crate) fn apply(&self, base: &mut EditableBase, region: &[FaceIndex], change: &Change) {
        let kept = region.iter().filter(|f| !change.old.contains(f)).copied();
        let new = base.faces.len()..base.faces.len() + change.new.len();
        base.costs.resize(new.end, 0.0);
        for (f, &cost) in kept.chain(new).zip(&self.costs) {
            base.costs[f] = cost;
        }
        for &f in &change.old {
            if let Some(face) = base.faces[f].take() {
                face.corners.iter().for_each(|&v| base.stars[v].retain(|&g| g != f));
            }
        }
        for &(v, placed, freedom) in &change.moved {
            while base.placed.len() <= v.index() {
                base.placed.push(placed);
                base.freedoms.push(freedom);
                base.stars.push(Vec::new());
            }
            (base.placed[v], base.freedoms[v]) = (placed, freedom);
        }
        for face in &change.new {
            face.corners.iter().for_each(|&v| base.stars[v].push(base.faces.len()));
            base.faces.push(Some(*face));
        }
        for &(v, placed) in &self.moved {
            base.placed[v] = placed;
        }
    }
}
