//! Needles that hang on a surface.

use super::editable_mesh::EditableMesh;
use super::report::CleanReport;
use crate::{FaceId, IdVec, VertexId};
use rustc_hash::FxHashMap;

/// Height over length of a needle. A corner on the opposite side that was written with 7 decimals is off it by 5e-8 at most, so that
/// sides of 0.05 and more are told; the flattest triangle that we met in a meant surface (office_chair) has 1.5e-5.
const NEEDLE: f64 = 1e-6;

/// Drops the needles that hang on other faces by one side at most, again and again. There is no surface on them to be lost, but
/// with them their edge would be one of three faces, where neighbours can't tell who goes on into whom. A needle that holds
/// two sides together stays: it fills a T-junction.
pub(super) fn drop_hanging(mesh: &mut EditableMesh, report: &mut CleanReport) {
    let mut queue: Vec<FaceId> = mesh.faces.ids().filter(|&f| is_needle(mesh, f)).collect();
    if queue.is_empty() {
        return;
    }
    let mut around = Sides::of(mesh, &queue);
    let mut drop = IdVec::<FaceId, bool>::filled(false, mesh.faces.len());
    while let Some(f) = queue.pop() {
        let sides = sides(mesh.faces[f]);
        if !drop[f] && is_needle(mesh, f) && sides.iter().filter(|&side| around.is_shared(side)).count() <= 1 {
            drop[f] = true;
            sides.iter().for_each(|side| around.leave(side, &mut queue));
        }
    }
    report.zero_area_dropped += mesh.drop_faces(&drop);
}

fn is_needle(mesh: &EditableMesh, f: FaceId) -> bool {
    let [a, b, c] = mesh.triangle(f);
    let longest = (b - a).length().max((c - b).length()).max((a - c).length());
    (b - a).cross(c - a).length() <= NEEDLE * longest * longest
}

type Side = [VertexId; 2];

fn sides([a, b, c]: [VertexId; 3]) -> [Side; 3] {
    [[a.min(b), a.max(b)], [b.min(c), b.max(c)], [c.min(a), c.max(a)]]
}

/// How many faces are left at the sides of needles, and which there were.
struct Sides {
    at: FxHashMap<Side, (usize, Vec<FaceId>)>,
}

impl Sides {
    fn of(mesh: &EditableMesh, needles: &[FaceId]) -> Self {
        let mut at: FxHashMap<Side, (usize, Vec<FaceId>)> = FxHashMap::default();
        for side in needles.iter().flat_map(|&f| sides(mesh.faces[f])) {
            at.entry(side).or_default();
        }
        for (f, &corners) in mesh.faces.enumerate() {
            for side in sides(corners) {
                if let Some((left, faces)) = at.get_mut(&side) {
                    *left += 1;
                    faces.push(f);
                }
            }
        }
        Self { at }
    }

    fn is_shared(&self, side: &Side) -> bool {
        self.at.get(side).is_some_and(|(left, _)| *left > 1)
    }

    /// A face goes; where one alone is left, all are queued, as it may hang now.
    fn leave(&mut self, side: &Side, queue: &mut Vec<FaceId>) {
        if let Some((left, faces)) = self.at.get_mut(side) {
            *left -= 1;
            if *left == 1 {
                queue.extend_from_slice(faces);
            }
        }
    }
}
