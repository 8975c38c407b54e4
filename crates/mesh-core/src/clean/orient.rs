//! Making neighbours face the same way.

use super::edges::edge_groups;
use super::editable_mesh::EditableMesh;
use crate::{FaceId, IdVec};
use glam::DVec3;
use std::collections::VecDeque;

/// Turns faces so that they agree across every edge of exactly two faces; across some edges of a one-sided surface they cannot.
///
/// In each part connected by such edges most faces stay as they are, but a closed part in which any has to be turned is
/// made to face outwards.
pub(super) fn orient(mesh: &mut EditableMesh) {
    let sides = Sides::of(mesh);
    let mut turn = IdVec::<FaceId, Option<bool>>::filled(None, mesh.faces.len());
    for start in mesh.faces.ids() {
        if turn[start].is_some() {
            continue;
        }
        let part = sides.flood(start, &mut turn);
        sides.shorten_cut(mesh, &part, &mut turn);
        let turned = part.iter().filter(|&&f| turn[f] == Some(true)).count();
        // Turn the others instead?
        let invert = if turned > 0 && sides.closed(&part) { volume(mesh, &part, &turn) < 0.0 } else { 2 * turned > part.len() };
        for f in part {
            if turn[f] != Some(invert) {
                mesh.turn(f);
            }
        }
    }
}

/// For every halfedge of an edge of two faces: the other face, and whether the two disagree.
struct Sides {
    neighbours: IdVec<FaceId, [Option<(FaceId, bool)>; 3]>,
}

impl Sides {
    fn of(mesh: &EditableMesh) -> Self {
        let mut neighbours = IdVec::<FaceId, _>::filled([None; 3], mesh.faces.len());
        for uses in edge_groups(&mesh.faces).iter() {
            if let &[(_, g), (_, h)] = uses {
                let disagree = mesh.from(g) == mesh.from(h);
                neighbours[g.face()][g.corner()] = Some((h.face(), disagree));
                neighbours[h.face()][h.corner()] = Some((g.face(), disagree));
            }
        }
        Self { neighbours }
    }

    /// The part of `start`, with a choice of who turns that leaves `start` as it is. Goes breadth first, so that where a
    /// one-sided surface must be cut the cut lies opposite the start and runs across it.
    fn flood(&self, start: FaceId, turn: &mut IdVec<FaceId, Option<bool>>) -> Vec<FaceId> {
        let mut part = vec![start];
        let mut queue = VecDeque::from([(start, false)]);
        turn[start] = Some(false);
        while let Some((f, turned)) = queue.pop_front() {
            for &(g, disagree) in self.neighbours[f].iter().flatten() {
                if turn[g].is_none() {
                    turn[g] = Some(turned != disagree);
                    queue.push_back((g, turned != disagree));
                    part.push(g);
                }
            }
        }
        part
    }

    /// Where a one-sided surface is cut: turns single faces as long as that makes the cut shorter. Without it the cut is as jagged
    /// as the front of the flood. Ends, as every turn leaves a shorter cut.
    fn shorten_cut(&self, mesh: &EditableMesh, part: &[FaceId], turn: &mut IdVec<FaceId, Option<bool>>) {
        /// Rounding must not turn a face to and fro.
        const SHORTER: f64 = 1.0 - 1e-9;
        let mut again = true;
        while again {
            again = false;
            for &f in part {
                let (mut cut, mut whole) = (0.0, 0.0);
                for (c, &side) in self.neighbours[f].iter().enumerate() {
                    let Some((g, disagree)) = side else { continue };
                    let ends = [c, (c + 1) % 3].map(|i| mesh.positions[mesh.faces[f][i]]);
                    let is_cut = (turn[f] != turn[g]) != disagree;
                    *if is_cut { &mut cut } else { &mut whole } += ends[0].distance(ends[1]);
                }
                if whole < SHORTER * cut {
                    turn[f] = turn[f].map(|t| !t);
                    again = true;
                }
            }
        }
    }

    fn closed(&self, part: &[FaceId]) -> bool {
        part.iter().all(|&f| self.neighbours[f].iter().all(Option::is_some))
    }
}

/// Volume inside a closed part after turning, positive when it then faces outwards.
fn volume(mesh: &EditableMesh, part: &[FaceId], turn: &IdVec<FaceId, Option<bool>>) -> f64 {
    let origin: DVec3 = mesh.triangle(part[0])[0];
    let six_times = |f: FaceId| {
        let [a, b, c] = mesh.triangle(f).map(|p| p - origin);
        let sign = if turn[f] == Some(true) { -1.0 } else { 1.0 };
        sign * a.dot(b.cross(c))
    };
    part.iter().map(|&f| six_times(f)).sum()
}
