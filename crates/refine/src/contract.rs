//! Creases so short that no triangle of the result can follow them are contracted.
//!
//! Boolean operations of CAD programs leave corners side by side, a ten thousandth of the part apart. Both would be base vertices, and the
//! arc between them all triangles of a base edge: needles that nothing can mend.

use crate::options::{RefineError, RefineOptions};
use glam::DVec3;
use mesh_core::{FaceId, IdVec, Topology, TriMesh, VertexId};
use rustc_hash::FxHashSet;
use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};

/// A triangle that stays may turn by this much (degrees).
const MOST_TURN: f64 = 20.0;

/// A mesh without short creases.
pub(crate) struct Contracted {
    pub(crate) mesh: TriMesh,
    pub(crate) topology: Topology,
    /// For every face the one that it was.
    pub(crate) source: IdVec<FaceId, FaceId>,
    /// The marked edges that are left.
    pub(crate) marked: Vec<[VertexId; 2]>,
    /// Number of edges contracted.
    pub(crate) contractions: usize,
}

/// Contracts creases, borders and marked edges shorter than `shortest`, as far as the mesh stays a manifold of
/// the same topology. `None` where there are none.
pub(crate) fn contract(
    mesh: &TriMesh,
    topology: &Topology,
    marked: &[[VertexId; 2]],
    options: &RefineOptions,
) -> Result<Option<Contracted>, RefineError> {
    let shortest = options.shortest_edge;
    let length = |[a, b]: [VertexId; 2]| mesh.distance(a, b);
    if !topology.edge_ids().any(|e| length(topology.ends(e)) < shortest) {
        return Ok(None);
    }
    let mut coarse = Coarse::new(mesh, topology, marked, options.crease_angle);
    let mut queue: BinaryHeap<_> = topology
        .edge_ids()
        .map(|e| topology.ends(e))
        .filter(|&e| length(e) < shortest)
        .map(|e| Reverse((length(e).to_bits(), e)))
        .collect();
    let mut contractions = 0;
    while let Some(Reverse((_, [a, b]))) = queue.pop() {
        let Some([keep, gone]) = coarse.may_contract(a, b, shortest) else { continue };
        coarse.contract(keep, gone);
        contractions += 1;
        let edges = coarse.neighbours(keep).into_iter().map(|v| [keep.min(v), keep.max(v)]);
        // What could not be contracted before may be now; this ends, as each contraction takes a vertex away.
        queue.extend(edges.filter(|&e| length(e) < shortest).map(|e| Reverse((length(e).to_bits(), e))));
    }
    if contractions == 0 { Ok(None) } else { coarse.finish(marked, contractions).map(Some) }
}

struct Coarse<'a> {
    mesh: &'a TriMesh,
    /// `None` for faces that are gone.
    faces: IdVec<FaceId, Option<[VertexId; 3]>>,
    /// The faces at every vertex.
    fans: IdVec<VertexId, Vec<FaceId>>,
    /// Where a vertex went.
    merged_into: IdVec<VertexId, VertexId>,
    /// Creases, borders and marked edges, ends rising.
    kept: FxHashSet<[VertexId; 2]>,
    is_border: IdVec<VertexId, bool>,
}

impl<'a> Coarse<'a> {
    fn new(mesh: &'a TriMesh, topology: &Topology, marked: &[[VertexId; 2]], crease_angle: f64) -> Self {
        let mut fans = IdVec::filled(Vec::new(), mesh.n_vertices());
        let mut is_border = IdVec::filled(false, mesh.n_vertices());
        let mut kept: FxHashSet<[VertexId; 2]> = marked.iter().map(|&[a, b]| rising(a, b)).collect();
        for (f, face) in mesh.faces().enumerate() {
            face.iter().for_each(|&v| fans[v].push(f));
        }
        for e in topology.edge_ids() {
            let ([a, b], (f, g)) = (topology.ends(e), topology.edge_faces(e));
            let is_crease = |g| mesh.normal(f).angle_between(mesh.normal(g)) > crease_angle.to_radians();
            if g.is_none_or(is_crease) {
                kept.insert(rising(a, b));
            }
            if g.is_none() {
                (is_border[a], is_border[b]) = (true, true);
            }
        }
        let faces = mesh.faces().iter().copied().map(Some).collect();
        Self { mesh, faces, fans, merged_into: mesh.positions().ids().collect(), kept, is_border }
    }

    /// The vertex to keep and the one to take away, if the edge between the two is there and may go.
    fn may_contract(&self, a: VertexId, b: VertexId, shortest: f64) -> Option<[VertexId; 2]> {
        if !self.kept.contains(&rising(a, b)) {
            return None; // no arc gets shorter by it
        }
        let beside: BTreeSet<VertexId> = self.shared(a, b).into_iter().flat_map(|f| self.face(f)).collect();
        let beside: Vec<VertexId> = beside.into_iter().filter(|&v| v != a && v != b).collect();
        let common = self.neighbours(a).intersection(&self.neighbours(b)).count();
        let is_border_edge = beside.len() == 1;
        let pulls_border = self.is_border[a] && self.is_border[b] && !is_border_edge;
        if beside.is_empty() || common != beside.len() || pulls_border || beside.iter().any(|&v| self.fans[v].len() <= 3) {
            return None;
        }
        let [at_a, at_b] = [a, b].map(|v| self.n_kept(v));
        // Borders stay, then junctions of creases.
        let rank = |v: VertexId, n: usize| (self.is_border[v], n > 2, Reverse(v));
        let [keep, gone] = if rank(a, at_a) > rank(b, at_b) { [a, b] } else { [b, a] };
        let stays = |f: &&FaceId| !self.face(**f).contains(&keep);
        self.fans[gone].iter().filter(stays).all(|&f| self.keeps_its_side(f, gone, keep, shortest)).then_some([keep, gone])
    }

    /// Does a face look the same way with one corner elsewhere? One that is lower than the shortest edge has no say, as long as it does not
    /// turn over.
    fn keeps_its_side(&self, f: FaceId, gone: VertexId, keep: VertexId, shortest: f64) -> bool {
        let before = self.face(f).map(|v| self.mesh.position(v));
        let after = self.face(f).map(|v| self.mesh.position(if v == gone { keep } else { v }));
        let [old, new] = [before, after].map(mesh_core::vector_area);
        let longest = (0..3).map(|i| before[i].distance(before[(i + 1) % 3])).fold(0.0, f64::max);
        let is_low = 2.0 * old.length() < shortest * longest;
        let least = if is_low { 0.0 } else { MOST_TURN.to_radians().cos() };
        new.dot(old) > least * new.length() * old.length() || old == DVec3::ZERO
    }

    fn contract(&mut self, keep: VertexId, gone: VertexId) {
        for v in self.neighbours(gone) {
            if self.kept.remove(&rising(gone, v)) && v != keep {
                self.kept.insert(rising(keep, v));
            }
        }
        for f in std::mem::take(&mut self.fans[gone]) {
            let face = self.face(f);
            if face.contains(&keep) {
                self.faces[f] = None;
                face.into_iter().filter(|&v| v != gone).for_each(|v| self.fans[v].retain(|&g| g != f));
            } else {
                self.faces[f] = Some(face.map(|v| if v == gone { keep } else { v }));
                self.fans[keep].push(f);
            }
        }
        self.merged_into[gone] = keep;
    }

    fn finish(self, marked: &[[VertexId; 2]], contractions: usize) -> Result<Contracted, RefineError> {
        let mut numbers = IdVec::filled(VertexId(0), self.mesh.n_vertices());
        let mut positions = Vec::new();
        for (v, &position) in self.mesh.positions().enumerate().filter(|&(v, _)| self.merged_into[v] == v) {
            numbers[v] = VertexId(positions.len() as u32);
            positions.push(position);
        }
        let left = || self.faces.enumerate().filter_map(|(f, face)| Some((f, (*face)?)));
        let faces: Vec<[u32; 3]> = left().map(|(_, face)| face.map(|v| numbers[v].0)).collect();
        let source = left().map(|(f, _)| f).collect();
        let number = |mut v: VertexId| {
            while self.merged_into[v] != v {
                v = self.merged_into[v];
            }
            numbers[v]
        };
        let marked = marked.iter().map(|edge| edge.map(number)).filter(|[a, b]| a != b).collect();
        let mesh = TriMesh::new(positions, faces)?;
        let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
        Ok(Contracted { mesh, topology, source, marked, contractions })
    }

    /// The corners of a face that is there; those of one that is gone are all the same.
    fn face(&self, f: FaceId) -> [VertexId; 3] {
        self.faces[f].unwrap_or([VertexId(0); 3])
    }

    fn shared(&self, a: VertexId, b: VertexId) -> Vec<FaceId> {
        self.fans[a].iter().copied().filter(|&f| self.face(f).contains(&b)).collect()
    }

    fn neighbours(&self, v: VertexId) -> BTreeSet<VertexId> {
        self.fans[v].iter().flat_map(|&f| self.face(f)).filter(|&w| w != v).collect()
    }

    /// How many creases, borders and marked edges end at a vertex.
    fn n_kept(&self, v: VertexId) -> usize {
        self.neighbours(v).into_iter().filter(|&w| self.kept.contains(&rising(v, w))).count()
    }
}

fn rising(a: VertexId, b: VertexId) -> [VertexId; 2] {
    [a.min(b), a.max(b)]
}
