//! The flip of a base edge.

use crate::base_face::BaseFace;
use crate::change::Change;
use crate::editable_base::EditableBase;
use glam::DVec3;
use mesh_core::VertexId;
use region_map::BaseEdit;
use relax::parts::{CornerNormal, Freedom};

/// The flip of an edge. `None` where it lies on an arc or another edge joins the opposite corners, where a
/// corner would be left with two edges, or a face would have two edges on one arc that goes on between them.
pub(crate) fn flip(base: &EditableBase, [a, b]: [VertexId; 2]) -> Option<Change> {
    let ((f, left), (g, right)) = (base.face_at(a, b)?, base.face_at(b, a)?);
    let (middle, c, d) = (left.middles[0], left.corners[2], right.corners[2]);
    if base.is_on_arc(middle) || c == d || base.is_edge(c, d) || [a, b].iter().any(|&v| base.stars[v].len() <= 3) {
        return None;
    }
    let [[na, nb, nc], [_, nbc, nca]] = left.normals;
    let [[_, _, nd], [_, nad, ndb]] = right.normals;
    let ([_, bc, ca], [_, ad, db]) = (left.middles, right.middles);
    if base.has_two_edges_on_arc(a, [ad, ca]) || base.has_two_edges_on_arc(b, [db, bc]) {
        return None;
    }
    let n = CornerNormal::Left;
    let sheet = left.sheet;
    let new = vec![
        BaseFace { corners: [a, d, c], middles: [ad, middle, ca], normals: [[na, nd, nc], [nad, n, nca]], sheet },
        BaseFace { corners: [d, b, c], middles: [db, bc, middle], normals: [[nd, nb, nc], [ndb, nbc, n]], sheet },
    ];
    let centre = [c, d, ad, ca, db, bc].iter().map(|&v| base.placed[v].position()).sum::<DVec3>() / 6.0;
    let placed = &base.placed[middle];
    let moved = vec![(middle, base.whole.walked(placed, centre - placed.position()), Freedom::Sheet)];
    Some(Change { edit: BaseEdit::Flip([a, b]), corners: vec![a, b, c, d], old: vec![f, g], new, moved })
}

#[cfg(test)]
mod tests {
    use super::*;
    use region_map::{Domain, Surface};
    use relax::ShapeOptions;
    use relax::parts::Whole;

    /// Of a cylinder with one middle on each lid: the edges on the rims can't be flipped, those of the side can.
    #[test]
    fn an_edge_on_an_arc_is_not_flipped() {
        let base = Surface::with_creases(fixtures::cylinder(0.5, 1.5, 12), 40.0).unwrap();
        let subdivided = subdiv::subdivide(&Domain::identity(&base), 1).unwrap().domain.mesh;
        let surface = Surface::with_creases(subdivided, 40.0).unwrap();
        let domain = Domain::identity(&surface);
        let whole = Whole::new(&surface, &domain).unwrap();
        let base = EditableBase::new(&whole, &domain, &ShapeOptions::default()).unwrap();
        let middle = |[a, b]: [VertexId; 2]| base.face_at(a, b).unwrap().1.middles[0];
        let (on_arcs, others): (Vec<_>, Vec<_>) = base.edges().into_iter().partition(|&e| base.is_on_arc(middle(e)));
        assert_eq!(on_arcs.len(), 24);
        assert!(on_arcs.iter().all(|&e| flip(&base, e).is_none()));
        assert!(others.iter().filter(|&&e| flip(&base, e).is_some()).count() >= 24);
    }
}
