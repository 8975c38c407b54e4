//! Triangles without area.

use super::CleanReport;
use super::draft::Draft;
use crate::exact::collinear;
use crate::partition::Partition;
use crate::{FaceId, IdVec, VertexId};
use rustc_hash::FxHashMap;

/// Mends the faces whose corners lie exactly on one line. Such a face fills a T-junction: one corner is on the edge between the
/// two others. Flipping that edge brings the corner into the neighbour. At a border, where there is no neighbour, the face is
/// dropped, and so is every component that has no area at all. What no flip mends is dropped, too: that opens the surface along a
/// line, by no width; kept, it would be triangles that face nowhere in every mesh made of this one.
///
/// Takes and leaves a manifold but for vertices between dropped faces; returns true when faces were dropped.
pub(super) fn mend_zero_area(draft: &mut Draft, report: &mut CleanReport) -> bool {
    if !draft.faces.ids().any(|f| is_flat(draft, f)) {
        return false;
    }
    let mut dropped = draft.drop_faces(&without_area(draft));
    let flat = draft.faces.ids().filter(|&f| is_flat(draft, f)).collect();
    let mut mender = Mender::new(draft);
    mender.run(flat, report);
    let mut drop = mender.dropped;
    for f in draft.faces.ids().filter(|&f| is_flat(draft, f)) {
        report.zero_area_opened += usize::from(!std::mem::replace(&mut drop[f], true));
    }
    // What is dropped may leave parts behind that were joined to a surface by it alone.
    dropped += draft.drop_faces(&drop) + draft.drop_faces(&without_area(draft));
    report.zero_area_dropped += dropped - report.zero_area_opened;
    dropped > 0
}

/// True when the corners of a face lie exactly on one line.
pub(super) fn is_flat(draft: &Draft, f: FaceId) -> bool {
    let [a, b, c] = draft.triangle(f);
    collinear(a, b, c)
}

/// The faces of components of which every face is flat.
fn without_area(draft: &Draft) -> IdVec<FaceId, bool> {
    let mut parts = Partition::<VertexId>::of_singles(draft.positions.len());
    for &[a, b, c] in &draft.faces {
        parts.join(a, b);
        parts.join(b, c);
    }
    let mut has_area = IdVec::<VertexId, bool>::filled(false, draft.positions.len());
    for (f, v) in draft.faces.enumerate() {
        if !is_flat(draft, f) {
            has_area[parts.part(v[0])] = true;
        }
    }
    draft.faces.iter().map(|v| !has_area[parts.part(v[0])]).collect()
}

struct Mender<'a> {
    draft: &'a mut Draft,
    /// The face of every directed edge.
    face_of: FxHashMap<[VertexId; 2], FaceId>,
    dropped: IdVec<FaceId, bool>,
}

impl<'a> Mender<'a> {
    fn new(draft: &'a mut Draft) -> Self {
        let dropped = IdVec::filled(false, draft.faces.len());
        let mut mender = Self { draft, face_of: FxHashMap::default(), dropped };
        for f in mender.draft.faces.ids() {
            mender.enter(f);
        }
        mender
    }

    /// Goes over the flat faces until nothing changes. Ends: a change never makes more flat faces, and one that leaves as many
    /// makes an edge shorter.
    fn run(&mut self, mut flat: Vec<FaceId>, report: &mut CleanReport) {
        loop {
            let mut changed = false;
            flat.retain(|&f| !self.dropped[f] && is_flat(self.draft, f));
            for &f in &flat {
                if self.dropped[f] || !is_flat(self.draft, f) {
                    continue;
                }
                match self.mend(f) {
                    Mended::Not => continue,
                    Mended::Dropped => {}
                    Mended::Flipped => report.zero_area_flipped += 1,
                }
                changed = true;
            }
            if !changed {
                return;
            }
        }
    }

    fn mend(&mut self, f: FaceId) -> Mended {
        let [a, b, c] = self.longest_edge_first(f);
        let Some(&g) = self.face_of.get(&[b, a]) else {
            self.leave(f);
            self.dropped[f] = true;
            return Mended::Dropped;
        };
        let Some(d) = self.draft.faces[g].into_iter().find(|&v| v != a && v != b) else { return Mended::Not };
        let free = !self.face_of.contains_key(&[c, d]) && !self.face_of.contains_key(&[d, c]);
        if c == d || !free || !self.gains([a, b, c, d], is_flat(self.draft, g)) {
            return Mended::Not;
        }
        self.leave(f);
        self.leave(g);
        self.draft.faces[f] = [c, a, d];
        self.draft.faces[g] = [d, b, c];
        // The flat face took up nothing of the surface: both halves lie in the neighbour.
        self.draft.source_face[f] = self.draft.source_face[g];
        self.draft.turned[f] = self.draft.turned[g];
        self.enter(f);
        self.enter(g);
        Mended::Flipped
    }

    /// True when the flip of a flat face's edge `ab` to `cd` is progress. It always is beside a face with area, but where products
    /// of coordinates underflow; there flips would go round in circles.
    fn gains(&self, [a, b, c, d]: [VertexId; 4], neighbour_is_flat: bool) -> bool {
        let flat = |corners: [VertexId; 3]| {
            let [p, q, r] = corners.map(|v| self.draft.positions[v]);
            collinear(p, q, r)
        };
        let before = 1 + usize::from(neighbour_is_flat);
        let after = usize::from(flat([c, a, d])) + usize::from(flat([d, b, c]));
        after < before || (after == before && self.length(c, d) < self.length(a, b))
    }

    fn longest_edge_first(&self, f: FaceId) -> [VertexId; 3] {
        let [a, b, c] = self.draft.faces[f];
        let (ab, bc, ca) = (self.length(a, b), self.length(b, c), self.length(c, a));
        if ab >= bc && ab >= ca {
            [a, b, c]
        } else if bc >= ca {
            [b, c, a]
        } else {
            [c, a, b]
        }
    }

    fn length(&self, a: VertexId, b: VertexId) -> f64 {
        self.draft.positions[a].distance(self.draft.positions[b])
    }

    fn enter(&mut self, f: FaceId) {
        let [a, b, c] = self.draft.faces[f];
        for edge in [[a, b], [b, c], [c, a]] {
            self.face_of.insert(edge, f);
        }
    }

    fn leave(&mut self, f: FaceId) {
        let [a, b, c] = self.draft.faces[f];
        for edge in [[a, b], [b, c], [c, a]] {
            self.face_of.remove(&edge);
        }
    }
}

enum Mended {
    Not,
    Dropped,
    Flipped,
}
