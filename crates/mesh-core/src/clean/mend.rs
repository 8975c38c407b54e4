//! Triangles without area.

use super::editable_mesh::EditableMesh;
use super::report::CleanReport;
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
pub(super) fn mend_zero_area(mesh: &mut EditableMesh, report: &mut CleanReport) -> bool {
    if !mesh.faces.ids().any(|f| is_flat(mesh, f)) {
        return false;
    }
    let mut dropped = mesh.drop_faces(&without_area(mesh));
    let flat = mesh.faces.ids().filter(|&f| is_flat(mesh, f)).collect();
    let mut mender = Mender::new(mesh);
    mender.run(flat, report);
    let mut drop = mender.dropped;
    for f in mesh.faces.ids().filter(|&f| is_flat(mesh, f)) {
        report.zero_area_opened += usize::from(!std::mem::replace(&mut drop[f], true));
    }
    // What is dropped may leave parts behind that were joined to a surface by it alone.
    dropped += mesh.drop_faces(&drop) + mesh.drop_faces(&without_area(mesh));
    report.zero_area_dropped += dropped - report.zero_area_opened;
    dropped > 0
}

/// True when the corners of a face lie exactly on one line.
pub(super) fn is_flat(mesh: &EditableMesh, f: FaceId) -> bool {
    let [a, b, c] = mesh.triangle(f);
    collinear(a, b, c)
}

/// The faces of components of which every face is flat.
fn without_area(mesh: &EditableMesh) -> IdVec<FaceId, bool> {
    let mut parts = Partition::<VertexId>::of_singles(mesh.positions.len());
    for &[a, b, c] in &mesh.faces {
        parts.join(a, b);
        parts.join(b, c);
    }
    let mut has_area = IdVec::<VertexId, bool>::filled(false, mesh.positions.len());
    for (f, v) in mesh.faces.enumerate() {
        if !is_flat(mesh, f) {
            has_area[parts.part(v[0])] = true;
        }
    }
    mesh.faces.iter().map(|v| !has_area[parts.part(v[0])]).collect()
}

struct Mender<'a> {
    mesh: &'a mut EditableMesh,
    /// The face of every directed edge.
    face_of: FxHashMap<[VertexId; 2], FaceId>,
    dropped: IdVec<FaceId, bool>,
}

impl<'a> Mender<'a> {
    fn new(mesh: &'a mut EditableMesh) -> Self {
        let dropped = IdVec::filled(false, mesh.faces.len());
        let mut mender = Self { mesh, face_of: FxHashMap::default(), dropped };
        for f in mender.mesh.faces.ids() {
            mender.enter(f);
        }
        mender
    }

    /// Goes over the flat faces until nothing changes. Ends: a change never makes more flat faces, and one that leaves as many
    /// makes an edge shorter.
    fn run(&mut self, mut flat: Vec<FaceId>, report: &mut CleanReport) {
        loop {
            let mut changed = false;
            flat.retain(|&f| !self.dropped[f] && is_flat(self.mesh, f));
            for &f in &flat {
                if self.dropped[f] || !is_flat(self.mesh, f) {
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
        let Some(d) = self.mesh.faces[g].into_iter().find(|&v| v != a && v != b) else { return Mended::Not };
        let free = !self.face_of.contains_key(&[c, d]) && !self.face_of.contains_key(&[d, c]);
        if c == d || !free || !self.gains([a, b, c, d], is_flat(self.mesh, g)) {
            return Mended::Not;
        }
        self.leave(f);
        self.leave(g);
        self.mesh.faces[f] = [c, a, d];
        self.mesh.faces[g] = [d, b, c];
        // The flat face took up nothing of the surface: both halves lie in the neighbour.
        self.mesh.source_face[f] = self.mesh.source_face[g];
        self.mesh.turned[f] = self.mesh.turned[g];
        self.enter(f);
        self.enter(g);
        Mended::Flipped
    }

    /// True when the flip of a flat face's edge `ab` to `cd` is progress. It always is beside a face with area, but where products
    /// of coordinates underflow; there flips would go round in circles.
    fn gains(&self, [a, b, c, d]: [VertexId; 4], neighbour_is_flat: bool) -> bool {
        let flat = |corners: [VertexId; 3]| {
            let [p, q, r] = corners.map(|v| self.mesh.positions[v]);
            collinear(p, q, r)
        };
        let before = 1 + usize::from(neighbour_is_flat);
        let after = usize::from(flat([c, a, d])) + usize::from(flat([d, b, c]));
        after < before || (after == before && self.length(c, d) < self.length(a, b))
    }

    fn longest_edge_first(&self, f: FaceId) -> [VertexId; 3] {
        let [a, b, c] = self.mesh.faces[f];
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
        self.mesh.positions[a].distance(self.mesh.positions[b])
    }

    fn enter(&mut self, f: FaceId) {
        let [a, b, c] = self.mesh.faces[f];
        for edge in [[a, b], [b, c], [c, a]] {
            self.face_of.insert(edge, f);
        }
    }

    fn leave(&mut self, f: FaceId) {
        let [a, b, c] = self.mesh.faces[f];
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
