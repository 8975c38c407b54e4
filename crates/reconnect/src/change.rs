//! What an edit changes in a base mesh.

use crate::base_face::BaseFace;
use crate::editable_base::{EditableBase, FaceIndex};
use mesh_core::VertexId;
use region_map::BaseEdit;
use relax::ShapeOptions;
use relax::parts::{ArcNeighbour, Freedom, PlacedVertex};

/// What an edit changes.
#[derive(Clone, Debug)]
pub(crate) struct Change {
    /// The edit, in the numbers of [`EditableBase`].
    pub(crate) edit: BaseEdit,
    /// The base vertices of all faces that change.
    pub(crate) corners: Vec<VertexId>,
    /// Faces that go.
    pub(crate) old: Vec<FaceIndex>,
    /// Faces that come.
    pub(crate) new: Vec<BaseFace>,
    /// Vertices that are new or have new neighbours on their arc: where to begin, and what they are free to do.
    pub(crate) moved: Vec<(VertexId, PlacedVertex, Freedom)>,
}

impl Change {
    /// Place and freedom of a vertex after the change.
    pub(crate) fn state(&self, base: &EditableBase, v: VertexId) -> (PlacedVertex, Freedom) {
        let moved = self.moved.iter().find(|m| m.0 == v);
        moved.map_or_else(|| (base.placed[v], base.freedoms[v]), |&(_, placed, freedom)| (placed, freedom))
    }

    /// The faces of a region after the change: those that stay, then the new ones.
    pub(crate) fn after<'c>(&'c self, base: &'c EditableBase, region: &'c [FaceIndex]) -> impl Iterator<Item = &'c BaseFace> {
        region.iter().filter(|f| !self.old.contains(f)).filter_map(|&f| base.face(f)).chain(&self.new)
    }

    /// What the faces that come cost before anything moves.
    pub(crate) fn cost_at_start(&self, base: &EditableBase, options: &ShapeOptions) -> f64 {
        let parts = self.new.iter().flat_map(|face| face.parts(base.whole.mean_area(face.sheet)));
        parts.map(|part| base.whole.cost(&part, |v| self.state(base, v).0, options)).sum()
    }

    /// Another neighbour for a vertex on an arc in the place of `old`, from whose arc lengths it differs by `new.shift`.
    pub(crate) fn meet(&mut self, base: &EditableBase, v: VertexId, old: VertexId, new: ArcNeighbour) {
        let (placed, freedom): (PlacedVertex, Freedom) = self.state(base, v);
        let Freedom::Arc(mut on_arc) = freedom else { return };
        for end in [&mut on_arc.behind, &mut on_arc.ahead] {
            if end.vertex == old {
                *end = ArcNeighbour { vertex: new.vertex, shift: end.shift + new.shift };
            }
        }
        self.moved.retain(|m| m.0 != v);
        self.moved.push((v, placed, Freedom::Arc(on_arc)));
    }
}
