//! A new base vertex in the middle of an edge.

use super::coarse::{BaseFace, Change, Coarse};
use crate::corner_normal::CornerNormal;
use crate::freedom::{ArcNeighbour, Freedom, OnArc};
use crate::placed_vertex::PlacedVertex;
use mesh_core::{Id as _, VertexId};
use region_map::BaseEdit;

/// Vertices that a split makes at most.
pub(super) const NEW_VERTICES: usize = 4;

/// The split of an edge. Its middle becomes a base vertex; the middles of the new edges get numbers from `first` on. `None` where there is no
/// such edge, or one of its faces has all three edges on arcs.
pub(super) fn split(coarse: &Coarse, [a, b]: [VertexId; 2], first: usize) -> Option<Change> {
    let sides = [(coarse.face_at(a, b), [a, b]), (coarse.face_at(b, a), [b, a])];
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
        let target = coarse.placed[middle].position.midpoint(coarse.placed[c].position);
        change.moved.push((across, coarse.start_near(target, &[middle, c, ca, bc])?, Freedom::Sheet));
    }
    halve(coarse, middle, [(a, to_a), (b, to_b)], &mut change);
    Some(change)
}

/// Places the middles of the halves of an edge, between its own middle and its two ends.
fn halve(coarse: &Coarse, middle: VertexId, halves: [(VertexId, VertexId); 2], change: &mut Change) {
    let placed = coarse.placed[middle];
    let Freedom::Arc(on_arc) = coarse.freedoms[middle] else {
        for (end, half) in halves {
            let way = 0.5 * (coarse.placed[end].position - placed.position);
            change.moved.push((half, coarse.domain.walked(&placed, way), Freedom::Sheet));
        }
        return;
    };
    // Arc lengths of the halves are counted as those of the middle.
    let here = |vertex: VertexId| ArcNeighbour { vertex, shift: 0.0 };
    let half_at = |end: ArcNeighbour| halves.iter().find(|h| h.0 == end.vertex).map_or(end.vertex, |h| h.1);
    let (behind, ahead) = (half_at(on_arc.behind), half_at(on_arc.ahead));
    let [longest_gap, shortest_gap] = [on_arc.longest_gap, on_arc.shortest_gap].map(|gap| 0.5 * gap);
    let between = [
        (behind, on_arc.behind, OnArc { ahead: here(middle), longest_gap, shortest_gap, ..on_arc }),
        (ahead, on_arc.ahead, OnArc { behind: here(middle), longest_gap, shortest_gap, ..on_arc }),
    ];
    for (half, end, on_arc) in between {
        let t = 0.5 * (placed.t + coarse.placed[end.vertex].t + end.shift);
        change.moved.push((half, coarse.domain.placed_on_arc(&on_arc, t), Freedom::Arc(on_arc)));
        change.meet(coarse, end.vertex, middle, here(half));
    }
    let on_arc = OnArc { behind: here(behind), ahead: here(ahead), longest_gap, shortest_gap, ..on_arc };
    change.moved.push((middle, placed, Freedom::Arc(on_arc)));
}

impl Change {
    /// Another neighbour for a vertex on an arc in the place of `old`, from whose arc lengths it differs by `new.shift`.
    pub(super) fn meet(&mut self, coarse: &Coarse, v: VertexId, old: VertexId, new: ArcNeighbour) {
        let (placed, freedom): (PlacedVertex, Freedom) = self.state(coarse, v);
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
