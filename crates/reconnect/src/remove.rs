//! A base vertex taken away, its star filled with the triangles of the best shape.

use crate::base_face::BaseFace;
use crate::change::Change;
use crate::editable_base::{EditableBase, FaceIndex};
use mesh_core::{VertexId, cheapest_filling};
use region_map::{BaseEdit, SheetId};
use relax::parts::{ArcNeighbour, CornerNormal, Freedom, OnArc};

/// What taking `v` away does. `None` for a corner, and where no filling makes a simplicial mesh.
pub(crate) fn removal(base: &EditableBase, v: VertexId) -> Option<Change> {
    let mut change = Change {
        edit: BaseEdit::Remove { vertex: v, filling: vec![] },
        corners: vec![],
        old: base.stars[v].clone(),
        new: vec![],
        moved: vec![],
    };
    let sides = sides(base, v);
    match base.freedoms[v] {
        Freedom::Fixed => return None,
        Freedom::Sheet if sides.len() != 1 => return None,
        Freedom::Sheet => {}
        Freedom::Arc(on_arc) => join(base, v, &on_arc, &mut change)?,
    }
    let mut chords = Vec::new();
    for side in &sides {
        change.corners.extend(side.corners.iter().map(|c| c.0));
        side.fill(base, v, &mut change, &mut chords)?;
    }
    chords.sort_unstable();
    let filling = change.new.iter().map(|f| f.corners).collect();
    change.edit = BaseEdit::Remove { vertex: v, filling };
    // Both sides of an arc may meet in the same two vertices.
    chords.windows(2).all(|w| w[0] != w[1]).then_some(change)
}

/// The polygon of neighbours on one side of a vertex on an arc, or all round one inside a sheet, counter-clockwise.
struct Side {
    /// Corners, and the normals that faces take there.
    corners: Vec<(VertexId, CornerNormal)>,
    /// Middles of the edges from each corner to the next, and the normals there. That from the last to the first is to come on an
    /// arc.
    edges: Vec<(VertexId, CornerNormal)>,
    /// Middles of the spokes inside the sheet, for new edges.
    spokes: Vec<VertexId>,
    normal: CornerNormal,
    sheet: SheetId,
}

/// The faces round `v`, in order, cut at arcs.
fn sides(base: &EditableBase, v: VertexId) -> Vec<Side> {
    let star: Vec<(FaceIndex, BaseFace)> = base.stars[v].iter().filter_map(|&f| Some((f, base.face(f)?.from(v)))).collect();
    let on_arc = |f: &&(FaceIndex, BaseFace)| base.is_on_arc(f.1.middles[0]);
    let mut starts: Vec<BaseFace> = star.iter().filter(on_arc).map(|f| f.1).collect();
    if starts.is_empty() {
        starts.extend(star.first().map(|f| f.1));
    }
    let next = |face: &BaseFace| star.iter().map(|f| f.1).find(|f| f.corners[1] == face.corners[2]);
    let side = |first: BaseFace| {
        let mut fan = vec![first];
        let is_closed = !base.is_on_arc(first.middles[0]);
        while let Some(last) = fan.last().filter(|f| !base.is_on_arc(f.middles[2]))
            && let Some(face) = next(last).filter(|f| f.corners[1] != first.corners[1])
            && fan.len() < star.len()
        {
            fan.push(face);
        }
        let mut corners: Vec<_> = fan.iter().map(|f| (f.corners[1], f.normals[0][1])).collect();
        let mut edges: Vec<_> = fan.iter().map(|f| (f.middles[1], f.normals[1][1])).collect();
        let normal = first.normals[0][0];
        if let (false, Some(last)) = (is_closed, fan.last()) {
            corners.push((last.corners[2], last.normals[0][2]));
            edges.push((v, normal));
        }
        let spokes = fan.iter().map(|f| f.middles[0]).filter(|&m| !base.is_on_arc(m)).collect();
        Side { corners, edges, spokes, normal, sheet: first.sheet }
    };
    starts.into_iter().map(side).collect()
}

impl Side {
    /// Adds the triangles of the best shape over the polygon, and lists its chords.
    fn fill(&self, base: &EditableBase, v: VertexId, change: &mut Change, chords: &mut Vec<[VertexId; 2]>) -> Option<()> {
        let n = self.corners.len();
        let corner = |i: usize| self.corners[i].0;
        // The edge from corner i to corner j, if they are neighbours on the polygon.
        let edge = |i: usize, j: usize| ((i + 1) % n == j).then_some(i).or(((j + 1) % n == i).then_some(j));
        let may_be = |i: usize, j: usize| edge(i, j).is_some() || !base.is_edge(corner(i), corner(j));
        let has_two_on_arc = |i: usize, j: usize, k: usize| match (edge(i, j), edge(j, k)) {
            (Some(e), Some(f)) => base.has_two_edges_on_arc(corner(j), [e, f].map(|e| self.edges[e].0)),
            _ => false,
        };
        let is_taken = |t: [usize; 3]| {
            n == 3
                && base.stars[corner(t[0])]
                    .iter()
                    .filter_map(|&f| base.face(f))
                    .any(|f| t.iter().all(|&i| f.corners.contains(&corner(i))))
        };
        let cost = |[i, j, k]: [usize; 3]| {
            let may_not_be = has_two_on_arc(i, j, k) || has_two_on_arc(j, k, i) || has_two_on_arc(k, i, j);
            (!is_taken([i, j, k]) && !may_not_be).then(|| self.inverse_mean_ratio(base, v, [i, j, k]))
        };
        let triangles = cheapest_filling(n, may_be, cost)?;
        let mut inner: Vec<([usize; 2], VertexId)> = Vec::new();
        for t in &triangles {
            for (i, j) in [(t[0], t[1]), (t[1], t[2]), (t[0], t[2])] {
                if edge(i, j).is_none() && !inner.iter().any(|c| c.0 == [i, j]) {
                    let middle = *self.spokes.get(inner.len())?;
                    inner.push(([i, j], middle));
                    let target = base.placed[corner(i)].position().midpoint(base.placed[corner(j)].position());
                    change.moved.push((middle, base.start_near(target, &self.spokes)?, Freedom::Sheet));
                    chords.push([corner(i).min(corner(j)), corner(i).max(corner(j))]);
                }
            }
        }
        let middle = |i: usize, j: usize| match edge(i, j) {
            Some(e) => Some(self.edges[e]),
            None => inner.iter().find(|c| c.0 == [i.min(j), i.max(j)]).map(|c| (c.1, CornerNormal::Left)),
        };
        for &[i, j, k] in &triangles {
            let [a, b, c] = [i, j, k].map(|i| self.corners[i]);
            let [ab, bc, ca] = [middle(i, j)?, middle(j, k)?, middle(k, i)?];
            change.new.push(BaseFace {
                corners: [a.0, b.0, c.0],
                middles: [ab.0, bc.0, ca.0],
                normals: [[a.1, b.1, c.1], [ab.1, bc.1, ca.1]],
                sheet: self.sheet,
            });
        }
        Some(())
    }

    /// By the places that the base vertices have now.
    fn inverse_mean_ratio(&self, base: &EditableBase, v: VertexId, t: [usize; 3]) -> f64 {
        let normal = base.placed[v].normals()[usize::from(matches!(self.normal, CornerNormal::Right))];
        mesh_core::inverse_mean_ratio(t.map(|i| base.placed[self.corners[i].0].position()), normal)
    }
}

/// Joins the neighbours of `v` on its arc: it becomes the middle of the edge between them. `None` where one joins them already.
fn join(base: &EditableBase, v: VertexId, on_arc: &OnArc, change: &mut Change) -> Option<()> {
    // Between two base vertices there is a middle.
    let beyond = |end: ArcNeighbour, ahead: bool| match base.freedoms[end.vertex] {
        Freedom::Arc(r) => {
            let (far, near) = if ahead { (r.ahead, r.behind) } else { (r.behind, r.ahead) };
            Some((ArcNeighbour { vertex: far.vertex, shift: far.shift + end.shift }, end.vertex, near.shift))
        }
        _ => None,
    };
    let (behind, ahead) = (beyond(on_arc.behind, false)?, beyond(on_arc.ahead, true)?);
    if behind.0.vertex == ahead.0.vertex || base.is_edge(behind.0.vertex, ahead.0.vertex) {
        return None;
    }
    let ends = [behind, ahead].map(|(end, _, _)| base.placed[end.vertex].arc_length() + end.shift);
    let mut joined = *on_arc;
    (joined.behind, joined.ahead, joined.longest_gap) = (behind.0, ahead.0, 2.0 * on_arc.longest_gap);
    change.moved.push((v, base.whole.placed_on_arc(&joined, 0.5 * (ends[0] + ends[1]))?, Freedom::Arc(joined)));
    for (end, middle, back) in [behind, ahead] {
        change.meet(base, end.vertex, middle, ArcNeighbour { vertex: v, shift: back });
    }
    Some(())
}
