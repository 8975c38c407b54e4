//! A mesh under edit: edges are flipped and split, and the twins of halfedges are kept up to date.

use glam::DVec3;
use mesh_core::{FaceId, HalfedgeId, IdVec, Place, Topology, TriMesh, VertexId, place};
use rustc_hash::FxHashMap;

/// Where an edge is split that has another vertex in its middle, as shares of it.
const BESIDE: [f64; 4] = [0.46, 0.54, 0.42, 0.58];

/// Positions, faces and twins. Faces and vertices are only added.
pub(crate) struct EditableMesh {
    pub(crate) positions: IdVec<VertexId, DVec3>,
    pub(crate) faces: IdVec<FaceId, [VertexId; 3]>,
    pub(crate) source: IdVec<FaceId, FaceId>,
    twins: IdVec<HalfedgeId, Option<HalfedgeId>>,
    /// Where there are vertices, and between which places those lie that came of a split.
    origins: FxHashMap<Place, Option<[Place; 2]>>,
}

impl EditableMesh {
    /// A mesh whose faces have these sources.
    pub(crate) fn new(mesh: &TriMesh, topology: &Topology, source: IdVec<FaceId, FaceId>) -> Self {
        let halfedges = mesh.faces().ids().flat_map(|f| topology.halfedges(f));
        Self {
            positions: mesh.positions().clone(),
            faces: mesh.faces().clone(),
            source,
            twins: halfedges.map(|h| topology.twin(h)).collect(),
            origins: mesh.positions().iter().map(|&p| (place(p), None)).collect(),
        }
    }

    /// All halfedges; every edge has one or two.
    pub(crate) fn halfedges(&self) -> impl Iterator<Item = HalfedgeId> + use<> {
        self.twins.ids()
    }
    pub(crate) fn twin(&self, h: HalfedgeId) -> Option<HalfedgeId> {
        self.twins[h]
    }
    pub(crate) fn from(&self, h: HalfedgeId) -> VertexId {
        self.faces[h.face()][h.corner()]
    }
    pub(crate) fn ends(&self, h: HalfedgeId) -> [VertexId; 2] {
        [self.from(h), self.from(h.next())]
    }
    pub(crate) fn opposite(&self, h: HalfedgeId) -> VertexId {
        self.from(h.prev())
    }
    pub(crate) fn length(&self, h: HalfedgeId) -> f64 {
        let [a, b] = self.ends(h);
        self.positions[a].distance(self.positions[b])
    }

    /// True when some face has an edge between the two vertices; `start` is a halfedge that starts at `a`.
    pub(crate) fn are_joined(&self, start: HalfedgeId, b: VertexId) -> bool {
        let joins = |h: HalfedgeId| self.from(h.next()) == b || self.opposite(h) == b;
        let forward = std::iter::successors(Some(start), |h| self.twins[h.prev()].filter(|&n| n != start));
        // From a border the fan is cut open: the rest of it lies on the other side of the start.
        let backward = std::iter::successors(self.twins[start].map(HalfedgeId::next), |h| {
            self.twins[*h].map(HalfedgeId::next).filter(|&n| n != start)
        });
        forward.chain(backward).any(joins)
    }

    /// Replaces an edge `a -> b` between the faces `a b c` and `b a d` by `c - d`. Returns the four halfedges of the border of the
    /// two faces; the given halfedge runs from `d` to `c` then.
    pub(crate) fn flip(&mut self, h: HalfedgeId, twin: HalfedgeId) -> [HalfedgeId; 4] {
        let [a, b] = self.ends(h);
        let (c, d) = (self.opposite(h), self.opposite(twin));
        let [bc, ca, ad, db] = [h.next(), h.prev(), twin.next(), twin.prev()].map(|e| self.twins[e]);
        // Face of h: d c a; face of the twin: c d b.
        self.set_face(h, [d, c, a]);
        self.set_face(twin, [c, d, b]);
        self.join(h.next(), ca);
        self.join(h.prev(), ad);
        self.join(twin.next(), db);
        self.join(twin.prev(), bc);
        [h.next(), h.prev(), twin.next(), twin.prev()]
    }

    /// Where to split an edge. Sides that lie on each other are halved in the same way, and their new vertices would touch where the surface does not;
    /// where it does along an edge, both have the same ends, and stay together.
    fn free_place(&mut self, ends: [VertexId; 2]) -> DVec3 {
        let mut ends = ends.map(|v| self.positions[v]);
        ends.sort_by_key(|&p| place(p));
        let (origin, middle) = (Some(ends.map(place)), ends[0].midpoint(ends[1]));
        let beside = BESIDE.iter().map(|&share| ends[0].lerp(ends[1], share));
        let is_free = |p: &DVec3| self.origins.get(&place(*p)).is_none_or(|there| *there == origin);
        let free = std::iter::once(middle).chain(beside).find(is_free).unwrap_or(middle);
        self.origins.entry(place(free)).or_insert(origin);
        free
    }

    /// Halves an edge, or nearly so. Returns the new vertex, and the halfedges of the border of the new faces and of the new edges.
    pub(crate) fn split(&mut self, h: HalfedgeId) -> (VertexId, Vec<HalfedgeId>) {
        let [a, b] = self.ends(h);
        let middle = self.free_place([a, b]);
        let m = self.positions.push(middle);
        let (first, mut touched) = self.halve_face(h, m);
        if let Some(twin) = self.twins[h] {
            let (second, more) = self.halve_face(twin, m);
            // h runs from a to m now, first from m to b; twin from b to m, second from m to a.
            self.join(h, Some(second));
            self.join(twin, Some(first));
            touched.extend(more);
        }
        (m, touched)
    }

    /// Puts `m` on the edge `h` of one face: `a b c` becomes `a m c`, and `m b c` is new. Returns the new halfedge `m -> b` and
    /// all others of both faces but those along the edge.
    fn halve_face(&mut self, h: HalfedgeId, m: VertexId) -> (HalfedgeId, Vec<HalfedgeId>) {
        let (b, c) = (self.from(h.next()), self.opposite(h));
        let outer = self.twins[h.next()];
        self.faces[h.face()][h.next().corner()] = m;
        let new = self.faces.push([m, b, c]);
        self.source.push(self.source[h.face()]);
        (0..3).for_each(|_| _ = self.twins.push(None));
        let [mb, bc, cm] = [0, 1, 2].map(|c| HalfedgeId::of(new, c));
        self.join(bc, outer);
        self.join(cm, Some(h.next()));
        (mb, vec![h, mb, bc, cm, h.prev()])
    }

    /// Sets the corners of the face of `h` so that `h` starts at the first of them.
    fn set_face(&mut self, h: HalfedgeId, corners: [VertexId; 3]) {
        for (h, v) in [h, h.next(), h.prev()].into_iter().zip(corners) {
            self.faces[h.face()][h.corner()] = v;
        }
    }

    fn join(&mut self, h: HalfedgeId, twin: Option<HalfedgeId>) {
        self.twins[h] = twin;
        if let Some(twin) = twin {
            self.twins[twin] = Some(h);
        }
    }
}
