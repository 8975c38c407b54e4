//! A new base vertex in the middle of an edge.

use crate::base_face::BaseFace;
use crate::change::Change;
use crate::editable_base::EditableBase;
use mesh_core::{Id as _, VertexId};
use region_map::BaseEdit;
use relax::parts::{ArcNeighbour, CornerNormal, Freedom};

/// Vertices that a split makes at most.
pub(crate) const NEW_VERTICES: usize = 4;

/// The split of an edge. Its middle becomes a base vertex; the middles of the new edges get numbers from `first` on. `None` where
/// there is no such edge, or one of its faces has all three edges on arcs.
pub(crate) fn split(base: &EditableBase, [a, b]: [VertexId; 2], first: usize) -> Option<Change> {
    let sides = [(base.face_at(a, b), [a, b]), (base.face_at(b, a), [b, a])];
    let middle = sides.iter().find_map(|(side, _)| Some(side.as_ref()?.1.middles[0]))?;
    let [to_a, to_b, to_left, to_right] = [0, 1, 2, 3].map(|i| VertexId::new(first + i));
    let mut change = Change { edit: BaseEdit::Split([a, b]), corners: vec![a, b], old: vec![], new: vec![], moved: vec![] };
    for ((side, [from, to]), across) in sides.into_iter().zip([to_left, to_right]) {
        let Some((f, BaseFace { corners, middles, normals, sheet })) = side else { continue };
        let [[na, nb, nc], [nm, nbc, nca]] = normals;
        let ([_, _, c], [_, bc, ca]) = (corners, middles);
        let (behind, ahead) = if from == a { (to_a, to_b) } else { (to_b, to_a) };
        let n = CornerNormal::Left;
        let part = |corners, middles, normals| BaseFace { corners, middles, normals, sheet };
        change.new.push(part([from, middle, c], [behind, across, ca], [[na, nm, nc], [nm, n, nca]]));
        change.new.push(part([middle, to, c], [ahead, bc, across], [[nm, nb, nc], [nm, nbc, n]]));
        change.old.push(f);
        change.corners.push(c);
        let target = base.placed[middle].position().midpoint(base.placed[c].position());
        change.moved.push((across, base.start_near(target, &[middle, c, ca, bc])?, Freedom::Sheet));
    }
    halve(base, middle, [(a, to_a), (b, to_b)], &mut change)?;
    Some(change)
}

/// Places the middles of the halves of an edge, between its own middle and its two ends.
fn halve(base: &EditableBase, middle: VertexId, halves: [(VertexId, VertexId); 2], change: &mut Change) -> Option<()> {
    let placed = base.placed[middle];
    let Freedom::Arc(mut on_arc) = base.freedoms[middle] else {
        for (end, half) in halves {
            let way = 0.5 * (base.placed[end].position() - placed.position());
            change.moved.push((half, base.whole.walked(&placed, way), Freedom::Sheet));
        }
        return Some(());
    };
    // Arc lengths of the halves are counted as those of the middle.
    let here = |vertex: VertexId| ArcNeighbour { vertex, shift: 0.0 };
    let half_at = |end: ArcNeighbour| halves.iter().find(|h| h.0 == end.vertex).map_or(end.vertex, |h| h.1);
    let ends = [on_arc.behind, on_arc.ahead];
    on_arc.longest_gap *= 0.5;
    on_arc.shortest_gap *= 0.5;
    let (mut behind, mut ahead) = (on_arc, on_arc);
    (behind.ahead, ahead.behind) = (here(middle), here(middle));
    for (end, half_on_arc) in ends.into_iter().zip([behind, ahead]) {
        let t = 0.5 * (placed.arc_length() + base.placed[end.vertex].arc_length() + end.shift);
        change.moved.push((half_at(end), base.whole.placed_on_arc(&half_on_arc, t)?, Freedom::Arc(half_on_arc)));
        change.meet(base, end.vertex, middle, here(half_at(end)));
    }
    [on_arc.behind, on_arc.ahead] = ends.map(|end| here(half_at(end)));
    change.moved.push((middle, placed, Freedom::Arc(on_arc)));
    Some(())
}
