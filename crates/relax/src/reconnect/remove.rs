//! A base vertex taken away, its star filled with the triangles of the best shape.

use super::coarse::{BaseFace, Change, Coarse, FaceIndex};
use crate::corner_normal::CornerNormal;
use crate::freedom::{ArcNeighbour, Freedom, OnArc};
use mesh_core::{VertexId, cheapest_filling};
use region_map::{BaseEdit, SheetId};

/// What taking `v` away does. `None` for a corner, and where no filling makes a simplicial mesh.
pub(super) fn removal(coarse: &Coarse, v: VertexId) -> Option<Change> {
    let mut change = Change {
        edit: BaseEdit::Remove { vertex: v, filling: vec![] },
        corners: vec![],
        old: coarse.stars[v].clone(),
        new: vec![],
        moved: vec![],
    };
    let sides = sides(coarse, v);
    match coarse.freedoms[v] {
        Freedom::Fixed => return None,
        Freedom::Sheet if sides.len() != 1 => return None,
        Freedom::Sheet => {}
        Freedom::Arc(on_arc) => join(coarse, v, &on_arc, &mut change)?,
    }
    let mut chords = Vec::new();
    for side in &sides {
        change.corners.extend(side.corners.iter().map(|c| c.0));
        side.fill(coarse, v, &mut change, &mut chords)?;
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
    /// Middles of the edges from each corner to the next, and the normals there. That from the last to the first is to come on an arc.
    edges: Vec<(VertexId, CornerNormal)>,
    /// Middles of the spokes inside the sheet, for new edges.
    spokes: Vec<VertexId>,
    normal: CornerNormal,
    sheet: SheetId,
}

/// The faces round `v`, in order, cut at arcs.
fn sides(coarse: &Coarse, v: VertexId) -> Vec<Side> {
    let star: Vec<(FaceIndex, BaseFace)> = coarse.stars[v].iter().filter_map(|&f| Some((f, coarse.face(f)?.from(v)))).collect();
    let on_arc = |f: &&(FaceIndex, BaseFace)| coarse.is_on_arc(f.1.middles[0]);
    let mut starts: Vec<BaseFace> = star.iter().filter(on_arc).map(|f| f.1).collect();
    if starts.is_empty() {
        starts.extend(star.first().map(|f| f.1));
    }
    let next = |face: &BaseFace| star.iter().map(|f| f.1).find(|f| f.corners[1] == face.corners[2]);
    let side = |first: BaseFace| {
        let mut fan = vec![first];
        let is_closed = !coarse.is_on_arc(first.middles[0]);
        while let Some(last) = fan.last().filter(|f| !coarse.is_on_arc(f.middles[2]))
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
        let spokes = fan.iter().map(|f| f.middles[0]).filter(|&m| !coarse.is_on_arc(m)).collect();
        Side { corners, edges, spokes, normal, sheet: first.sheet }
    };
    starts.into_iter().map(side).collect()
}

impl Side {
    /// Adds the triangles of the best shape over the polygon, and lists its chords.
    fn fill(&self, coarse: &Coarse, v: VertexId, change: &mut Change, chords: &mut Vec<[VertexId; 2]>) -> Option<()> {
        let n = self.corners.len();
        let corner = |i: usize| self.corners[i].0;
        // The edge from corner i to corner j, if they are neighbours on the polygon.
        let edge = |i: usize, j: usize| ((i + 1) % n == j).then_some(i).or(((j + 1) % n == i).then_some(j));
        let may_be = |i: usize, j: usize| edge(i, j).is_some() || !coarse.is_edge(corner(i), corner(j));
        let is_ear = |i: usize, j: usize, k: usize| match (edge(i, j), edge(j, k)) {
            (Some(e), Some(f)) => coarse.is_ear(corner(j), [e, f].map(|e| self.edges[e].0)),
            _ => false,
        };
        let is_taken = |t: [usize; 3]| {
            n == 3
                && coarse.stars[corner(t[0])]
                    .iter()
                    .filter_map(|&f| coarse.face(f))
                    .any(|f| t.iter().all(|&i| f.corners.contains(&corner(i))))
        };
        let cost = |[i, j, k]: [usize; 3]| {
            let is_ear = is_ear(i, j, k) || is_ear(j, k, i) || is_ear(k, i, j);
            (!is_taken([i, j, k]) && !is_ear).then(|| self.inverse_mean_ratio(coarse, v, [i, j, k]))
        };
        let triangles = cheapest_filling(n, may_be, cost)?;
        let mut inner: Vec<([usize; 2], VertexId)> = Vec::new();
        for t in &triangles {
            for (i, j) in [(t[0], t[1]), (t[1], t[2]), (t[0], t[2])] {
                if edge(i, j).is_none() && !inner.iter().any(|c| c.0 == [i, j]) {
                    let middle = *self.spokes.get(inner.len())?;
                    inner.push(([i, j], middle));
                    let target = coarse.placed[corner(i)].position.midpoint(coarse.placed[corner(j)].position);
                    change.moved.push((middle, coarse.start_near(target, &self.spokes)?, Freedom::Sheet));
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
    fn inverse_mean_ratio(&self, coarse: &Coarse, v: VertexId, t: [usize; 3]) -> f64 {
        let normal = coarse.placed[v].normals[usize::from(matches!(self.normal, CornerNormal::Right))];
        mesh_core::inverse_mean_ratio(t.map(|i| coarse.placed[self.corners[i].0].position), normal)
    }
}

/// Joins the neighbours of `v` on its arc: it becomes the middle of the edge between them. `None` where one joins them already.
fn join(coarse: &Coarse, v: VertexId, on_arc: &OnArc, change: &mut Change) -> Option<()> {
    // Between two base vertices there is a middle.
    let beyond = |end: ArcNeighbour, ahead: bool| match coarse.freedoms[end.vertex] {
        Freedom::Arc(r) => {
            let (far, near) = if ahead { (r.ahead, r.behind) } else { (r.behind, r.ahead) };
            Some((ArcNeighbour { vertex: far.vertex, shift: far.shift + end.shift }, end.vertex, near.shift))
        }
        _ => None,
    };
    let (behind, ahead) = (beyond(on_arc.behind, false)?, beyond(on_arc.ahead, true)?);
    if behind.0.vertex == ahead.0.vertex || coarse.is_edge(behind.0.vertex, ahead.0.vertex) {
        return None;
    }
    let ends = [behind, ahead].map(|(end, _, _)| coarse.placed[end.vertex].t + end.shift);
    let joined = OnArc { behind: behind.0, ahead: ahead.0, longest_gap: 2.0 * on_arc.longest_gap, ..*on_arc };
    change.moved.push((v, coarse.domain.placed_on_arc(&joined, 0.5 * (ends[0] + ends[1])), Freedom::Arc(joined)));
    for (end, middle, back) in [behind, ahead] {
        change.meet(coarse, end.vertex, middle, ArcNeighbour { vertex: v, shift: back });
    }
    Some(())
}
