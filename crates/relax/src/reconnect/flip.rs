//! The flip of a base edge.

use super::coarse::{BaseFace, Change, Coarse};
use crate::corner_normal::CornerNormal;
use crate::freedom::Freedom;
use glam::DVec3;
use mesh_core::VertexId;
use region_map::BaseEdit;

/// The flip of an edge. `None` where it lies on an arc or another edge joins the opposite corners, where a
/// corner would be left with two edges, or a face would have two edges on one arc that goes on between them.
pub(super) fn flip(coarse: &Coarse, [a, b]: [VertexId; 2]) -> Option<Change> {
    let ((f, left), (g, right)) = (coarse.face_at(a, b)?, coarse.face_at(b, a)?);
    let (middle, c, d) = (left.middles[0], left.corners[2], right.corners[2]);
    if coarse.is_on_arc(middle) || c == d || coarse.is_edge(c, d) || [a, b].iter().any(|&v| coarse.stars[v].len() <= 3) {
        return None;
    }
    let [[na, nb, nc], [_, nbc, nca]] = left.normals;
    let [[_, _, nd], [_, nad, ndb]] = right.normals;
    let ([_, bc, ca], [_, ad, db]) = (left.middles, right.middles);
    if coarse.is_ear(a, [ad, ca]) || coarse.is_ear(b, [db, bc]) {
        return None;
    }
    let n = CornerNormal::Left;
    let sheet = left.sheet;
    let new = vec![
        BaseFace { corners: [a, d, c], middles: [ad, middle, ca], normals: [[na, nd, nc], [nad, n, nca]], sheet },
        BaseFace { corners: [d, b, c], middles: [db, bc, middle], normals: [[nd, nb, nc], [ndb, nbc, n]], sheet },
    ];
    let centre = [c, d, ad, ca, db, bc].iter().map(|&v| coarse.placed[v].position).sum::<DVec3>() / 6.0;
    let placed = &coarse.placed[middle];
    let moved = vec![(middle, coarse.domain.walked(placed, centre - placed.position), Freedom::Sheet)];
    Some(Change { edit: BaseEdit::Flip([a, b]), corners: vec![a, b, c, d], old: vec![f, g], new, moved })
}
