//! Connectivity of an oriented manifold, with or without border. Knows no positions.
//!
//! Halfedges are implicit: `3 * face + corner`. A halfedge runs from its corner to the next one of its face.

use crate::leaving::Leaving;
use crate::limits::{MOST_FACES, MOST_VERTICES};
use crate::{EdgeId, FaceId, HalfedgeId, IdVec, VertexId};

/// Why faces are not an oriented manifold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum TopologyError {
    /// Two faces run along an edge in the same direction: more than two faces meet there, or their orientations disagree.
    #[error("faces {0} and {1} use the same directed edge; clean the mesh first")]
    DirectedEdgeTwice(FaceId, FaceId),
    /// The faces around a vertex form more than one fan.
    #[error("the faces around vertex {0} form more than one fan; clean the mesh first")]
    VertexNotManifold(VertexId),
    /// A face names a vertex that is not there.
    #[error("face {face} refers to vertex {vertex}, but there are only {vertices}; clean the mesh first")]
    IndexOutOfRange {
        /// The face.
        face: FaceId,
        /// The vertex that it names.
        vertex: VertexId,
        /// Number of vertices.
        vertices: usize,
    },
    /// A face has the same vertex twice.
    #[error("face {0} uses vertex {1} twice; clean the mesh first")]
    RepeatedVertex(FaceId, VertexId),
    /// There are more vertices or faces than ids of 32 bits can tell apart.
    #[error(
        "{vertices} vertices and {faces} faces are more than a mesh can have ({MOST_VERTICES} and {MOST_FACES}); simplify it"
    )]
    TooLarge {
        /// Number of vertices.
        vertices: usize,
        /// Number of faces.
        faces: usize,
    },
}

/// Twins, edges and fans of an oriented manifold. Like the index of a slice, an id that is asked for must be one of these faces.
#[derive(Clone, Debug)]
pub struct Topology {
    faces: IdVec<FaceId, [VertexId; 3]>,
    twins: IdVec<HalfedgeId, Option<HalfedgeId>>,
    edge_of: IdVec<HalfedgeId, EdgeId>,
    edges: IdVec<EdgeId, HalfedgeId>,
    outgoing: IdVec<VertexId, Option<HalfedgeId>>,
}

impl Topology {
    /// Connects the faces of `n_vertices` vertices. Edges are numbered in the order of their first halfedge.
    pub fn new(faces: &IdVec<FaceId, [VertexId; 3]>, n_vertices: usize) -> Result<Self, TopologyError> {
        check_faces(faces, n_vertices)?;
        let twins = twins(faces, n_vertices)?;
        let n_halfedges = twins.len();
        let mut edge_of = IdVec::filled(EdgeId(u32::MAX), n_halfedges);
        let mut edges = IdVec::new();
        for h in twins.ids() {
            match twins[h] {
                Some(twin) if twin < h => edge_of[h] = edge_of[twin],
                _ => edge_of[h] = edges.push(h),
            }
        }
        let outgoing = fan_starts(faces, &twins, n_vertices);
        let topology = Self { faces: faces.clone(), twins, edge_of, edges, outgoing };
        topology.check_fans()?;
        Ok(topology)
    }

    fn check_fans(&self) -> Result<(), TopologyError> {
        let mut degree = IdVec::<VertexId, u32>::filled(0, self.outgoing.len());
        for v in self.faces.iter().flatten() {
            degree[*v] += 1;
        }
        for v in self.outgoing.ids() {
            if self.fan(v).count() != degree[v] as usize {
                return Err(TopologyError::VertexNotManifold(v));
            }
        }
        Ok(())
    }

    /// Number of vertices, those without faces included.
    pub fn n_vertices(&self) -> usize {
        self.outgoing.len()
    }
    /// Number of faces.
    pub fn n_faces(&self) -> usize {
        self.faces.len()
    }
    /// Number of undirected edges.
    pub fn n_edges(&self) -> usize {
        self.edges.len()
    }
    /// Vertices of a face.
    pub fn face(&self, f: FaceId) -> [VertexId; 3] {
        self.faces[f]
    }
    /// All faces.
    pub fn faces(&self) -> &IdVec<FaceId, [VertexId; 3]> {
        &self.faces
    }
    /// The halfedge of the neighbouring face along the same edge, `None` on the border.
    pub fn twin(&self, h: HalfedgeId) -> Option<HalfedgeId> {
        self.twins[h]
    }
    /// The edge of a halfedge.
    pub fn edge(&self, h: HalfedgeId) -> EdgeId {
        self.edge_of[h]
    }
    /// The lower of the one or two halfedges of an edge.
    pub fn halfedge(&self, e: EdgeId) -> HalfedgeId {
        self.edges[e]
    }
    /// All edge ids.
    pub fn edge_ids(&self) -> impl ExactSizeIterator<Item = EdgeId> + use<> {
        self.edges.ids()
    }
    /// The three halfedges of a face.
    pub fn halfedges(&self, f: FaceId) -> [HalfedgeId; 3] {
        [0, 1, 2].map(|c| HalfedgeId::of(f, c))
    }
    /// Where a halfedge starts.
    pub fn from(&self, h: HalfedgeId) -> VertexId {
        self.faces[h.face()][h.corner()]
    }
    /// Where a halfedge ends.
    pub fn to(&self, h: HalfedgeId) -> VertexId {
        self.from(h.next())
    }
    /// The vertex of the halfedge's face that is not on it.
    pub fn opposite(&self, h: HalfedgeId) -> VertexId {
        self.from(h.prev())
    }
    /// Both ends of an edge, in the direction of its lower halfedge.
    pub fn ends(&self, e: EdgeId) -> [VertexId; 2] {
        let h = self.edges[e];
        [self.from(h), self.to(h)]
    }
    /// The faces on both sides of an edge, the second `None` on the border.
    pub fn edge_faces(&self, e: EdgeId) -> (FaceId, Option<FaceId>) {
        let h = self.edges[e];
        (h.face(), self.twins[h].map(HalfedgeId::face))
    }
    /// True where only one face has the edge.
    pub fn is_border_edge(&self, e: EdgeId) -> bool {
        self.twins[self.edges[e]].is_none()
    }
    /// True where a border edge ends at the vertex. Vertices without faces are not on the border.
    pub fn is_border_vertex(&self, v: VertexId) -> bool {
        self.outgoing[v].is_some_and(|h| self.twins[h].is_none())
    }
    /// The faces across the three edges, in halfedge order.
    pub fn neighbours(&self, f: FaceId) -> [Option<FaceId>; 3] {
        self.halfedges(f).map(|h| self.twins[h].map(HalfedgeId::face))
    }
    /// The halfedges that start at a vertex, counter-clockwise, one for each of its faces.
    ///
    /// At a border vertex the first one is on the border, and the last one's `prev` is.
    pub fn fan(&self, v: VertexId) -> impl Iterator<Item = HalfedgeId> + '_ {
        let start = self.outgoing[v];
        let step = move |&h: &HalfedgeId| self.twins[h.prev()].filter(|&next| Some(next) != start);
        std::iter::successors(start, step)
    }
    /// The faces at a vertex, counter-clockwise.
    pub fn faces_at(&self, v: VertexId) -> impl Iterator<Item = FaceId> + '_ {
        self.fan(v).map(HalfedgeId::face)
    }
    /// Valence: number of edges at a vertex.
    pub fn valence(&self, v: VertexId) -> usize {
        self.fan(v).count() + usize::from(self.is_border_vertex(v))
    }
    /// The neighbours of a vertex, counter-clockwise.
    pub fn one_ring(&self, v: VertexId) -> impl Iterator<Item = VertexId> + '_ {
        let last = if self.is_border_vertex(v) { self.fan(v).last().map(|h| self.opposite(h)) } else { None };
        self.fan(v).map(|h| self.to(h)).chain(last)
    }
    /// The halfedge from one vertex to another, where a face has it.
    pub fn find_halfedge(&self, from: VertexId, to: VertexId) -> Option<HalfedgeId> {
        self.fan(from).find(|&h| self.to(h) == to)
    }
    /// The edge between two vertices.
    pub fn find_edge(&self, a: VertexId, b: VertexId) -> Option<EdgeId> {
        self.find_halfedge(a, b).or_else(|| self.find_halfedge(b, a)).map(|h| self.edge(h))
    }

    /// The component of every face, numbered from 0 in the order of their first face, and how many there are.
    pub fn components(&self) -> (IdVec<FaceId, u32>, usize) {
        self.regions(|_| true)
    }

    /// The connected part of every face when only the edges for which `crossable` holds connect, and how many there are.
    /// Parts are numbered from 0 in the order of their first face.
    pub fn regions(&self, crossable: impl Fn(EdgeId) -> bool) -> (IdVec<FaceId, u32>, usize) {
        let mut region = IdVec::filled(u32::MAX, self.faces.len());
        let mut count = 0;
        let mut stack = Vec::new();
        for start in self.faces.ids() {
            if region[start] != u32::MAX {
                continue;
            }
            region[start] = count;
            stack.push(start);
            while let Some(f) = stack.pop() {
                for h in self.halfedges(f) {
                    let Some(twin) = self.twins[h] else { continue };
                    let g = twin.face();
                    if region[g] == u32::MAX && crossable(self.edge_of[h]) {
                        region[g] = count;
                        stack.push(g);
                    }
                }
            }
            count += 1;
        }
        (region, count as usize)
    }

    /// The border loops, each as the halfedges along it in order (the surface on their left).
    pub fn border_loops(&self) -> Vec<Vec<HalfedgeId>> {
        let mut seen = IdVec::<HalfedgeId, bool>::filled(false, self.twins.len());
        let mut loops = Vec::new();
        for start in self.twins.ids() {
            if self.twins[start].is_some() || seen[start] {
                continue;
            }
            let mut border = Vec::new();
            let mut next = Some(start);
            while let Some(h) = next.filter(|&h| !seen[h]) {
                seen[h] = true;
                border.push(h);
                next = self.outgoing[self.to(h)];
            }
            loops.push(border);
        }
        loops
    }

    /// Euler number V - E + F, vertices without faces not counted.
    pub fn euler(&self) -> i64 {
        let used = self.outgoing.iter().filter(|h| h.is_some()).count();
        used as i64 - self.edges.len() as i64 + self.faces.len() as i64
    }

    /// Total genus: half of `2 * components - border loops - Euler number`.
    pub fn genus(&self) -> i64 {
        let (_, components) = self.components();
        (2 * components as i64 - self.border_loops().len() as i64 - self.euler()) / 2
    }
}

fn check_faces(faces: &IdVec<FaceId, [VertexId; 3]>, n_vertices: usize) -> Result<(), TopologyError> {
    if n_vertices > MOST_VERTICES || faces.len() > MOST_FACES {
        return Err(TopologyError::TooLarge { vertices: n_vertices, faces: faces.len() });
    }
    for (face, v) in faces.enumerate() {
        if let Some(&vertex) = v.iter().find(|v| v.0 as usize >= n_vertices) {
            return Err(TopologyError::IndexOutOfRange { face, vertex, vertices: n_vertices });
        }
        if let Some(c) = (0..3).find(|&c| v[c] == v[(c + 1) % 3]) {
            return Err(TopologyError::RepeatedVertex(face, v[c]));
        }
    }
    Ok(())
}

/// The other halfedge of every edge.
fn twins(
    faces: &IdVec<FaceId, [VertexId; 3]>,
    n_vertices: usize,
) -> Result<IdVec<HalfedgeId, Option<HalfedgeId>>, TopologyError> {
    let leaving = Leaving::of(faces, n_vertices);
    if let Some([first, second]) = leaving.first_repeated() {
        return Err(TopologyError::DirectedEdgeTwice(first.face(), second.face()));
    }
    let sides = faces.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    Ok(sides.map(|[from, to]| leaving.find(to, from)).collect())
}

/// For every vertex the outgoing halfedge that its fan starts at: the one on the border where there is one.
fn fan_starts(
    faces: &IdVec<FaceId, [VertexId; 3]>,
    twins: &IdVec<HalfedgeId, Option<HalfedgeId>>,
    n_vertices: usize,
) -> IdVec<VertexId, Option<HalfedgeId>> {
    let mut outgoing = IdVec::filled(None, n_vertices);
    for h in twins.ids() {
        let v = faces[h.face()][h.corner()];
        if outgoing[v].is_none() || twins[h].is_none() {
            outgoing[v] = Some(h);
        }
    }
    outgoing
}

#[cfg(test)]
mod tests {
    use super::*;

    fn topology(faces: &[[u32; 3]]) -> Result<Topology, TopologyError> {
        let n = faces.iter().flatten().max().map_or(0, |m| *m as usize + 1);
        Topology::new(&faces.iter().map(|f| f.map(VertexId)).collect(), n)
    }

    const TETRAHEDRON: [[u32; 3]; 4] = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]];

    #[test]
    fn tetrahedron() {
        let t = topology(&TETRAHEDRON).unwrap();
        assert_eq!((t.n_edges(), t.euler(), t.genus()), (6, 2, 0));
        assert!(t.border_loops().is_empty());
        for v in 0..4 {
            assert_eq!(t.valence(VertexId(v)), 3);
            assert!(!t.is_border_vertex(VertexId(v)));
        }
        for e in t.edge_ids() {
            let [a, b] = t.ends(e);
            assert_eq!(t.find_edge(b, a), Some(e));
        }
    }

    #[test]
    fn an_open_fan_goes_from_border_to_border() {
        let t = topology(&[[0, 1, 2], [0, 2, 3], [0, 3, 4]]).unwrap();
        let ring: Vec<_> = t.one_ring(VertexId(0)).collect();
        assert_eq!(ring, [1, 2, 3, 4].map(VertexId));
        assert_eq!(t.valence(VertexId(0)), 4);
        assert_eq!(t.border_loops().len(), 1);
        assert_eq!(t.border_loops()[0].len(), 5);
        assert_eq!((t.euler(), t.genus()), (1, 0));
    }

    #[test]
    fn regions_are_cut_by_edges() {
        let t = topology(&TETRAHEDRON).unwrap();
        assert_eq!(t.components().1, 1);
        assert_eq!(t.regions(|_| false).1, 4);
        let base = t.edge_ids().filter(|&e| t.edge_faces(e).0 == FaceId(0)).collect::<Vec<_>>();
        assert_eq!(t.regions(|e| !base.contains(&e)).1, 2);
    }

    #[test]
    fn what_is_not_manifold_is_refused() {
        let book = topology(&[[0, 1, 2], [1, 0, 3], [0, 1, 4]]);
        assert_eq!(book.unwrap_err(), TopologyError::DirectedEdgeTwice(FaceId(0), FaceId(2)));
        let bow_tie = topology(&[[0, 1, 2], [0, 3, 4]]);
        assert_eq!(bow_tie.unwrap_err(), TopologyError::VertexNotManifold(VertexId(0)));
        // The first halfedge that repeats another counts, not the first that is repeated.
        let twice = topology(&[[0, 1, 2], [3, 4, 5], [4, 5, 6], [0, 1, 7]]);
        assert_eq!(twice.unwrap_err(), TopologyError::DirectedEdgeTwice(FaceId(1), FaceId(2)));
    }

    #[test]
    fn faces_of_no_mesh_are_refused() {
        let of = |faces: &[[u32; 3]], n| Topology::new(&faces.iter().map(|f| f.map(VertexId)).collect(), n).unwrap_err();
        let out_of_range = TopologyError::IndexOutOfRange { face: FaceId(1), vertex: VertexId(9), vertices: 9 };
        assert_eq!(of(&[[0, 1, 2], [0, 2, 9]], 9), out_of_range);
        assert_eq!(of(&[[0, 1, 2], [5, 3, 5]], 9), TopologyError::RepeatedVertex(FaceId(1), VertexId(5)));
        assert_eq!(of(&[], MOST_VERTICES + 1), TopologyError::TooLarge { vertices: MOST_VERTICES + 1, faces: 0 });
    }
}
