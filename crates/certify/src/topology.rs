//! Counts of a mesh that may be anything: components, Euler number, border loops, and where it is not a manifold.

use crate::edges::{Edges, Side};
use crate::union_find::UnionFind;
use crate::weld::Welded;
use mesh_core::{FaceId, Id, IdVec, TriMesh, VertexId};

/// What a face list is, by counting. Vertices without faces do not count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TopologyCounts {
    /// Vertices that faces use.
    pub vertices: usize,
    /// Faces.
    pub faces: usize,
    /// Parts connected by edges or vertices.
    pub components: usize,
    /// V - E + F.
    pub euler: i64,
    /// Connected parts of the border; loops that touch in a vertex count as one.
    pub border_loops: usize,
    /// Edges with one face.
    pub border_edges: usize,
    /// Edges with more than two faces.
    pub nonmanifold_edges: usize,
    /// Vertices whose faces form more than one fan.
    pub nonmanifold_vertices: usize,
    /// Whether every edge with two faces runs once each way.
    pub oriented: bool,
}

impl TopologyCounts {
    /// Counts a mesh as its indices say.
    pub fn of(mesh: &TriMesh) -> Self {
        Self::with_edges(mesh.faces(), &Edges::of(mesh.faces()))
    }

    fn with_edges(faces: &IdVec<FaceId, [VertexId; 3]>, edges: &Edges) -> Self {
        let n = n_vertices(faces);
        let mut used = IdVec::<VertexId, bool>::filled(false, n);
        faces.iter().flatten().for_each(|&v| used[v] = true);
        let vertices = used.iter().filter(|u| **u).count();
        Self {
            vertices,
            faces: faces.len(),
            components: parts(n, edges.iter().map(|sides| sides[0].ends)),
            euler: vertices as i64 - edges.iter().count() as i64 + faces.len() as i64,
            border_loops: parts(n, edges.border()),
            border_edges: edges.border().count(),
            nonmanifold_edges: edges.iter().filter(|sides| sides.len() > 2).count(),
            nonmanifold_vertices: nonmanifold_vertices(faces, edges, n),
            oriented: edges.oriented(),
        }
    }

    /// Every edge has one or two faces and every vertex one fan of them.
    pub fn manifold(&self) -> bool {
        self.nonmanifold_edges == 0 && self.nonmanifold_vertices == 0
    }

    /// Components, Euler number and border loops are the same.
    pub fn same_as(&self, other: &Self) -> bool {
        let key = |t: &Self| (t.components, t.euler, t.border_loops);
        key(self) == key(other)
    }
}

impl std::fmt::Display for TopologyCounts {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} components, Euler number {}, {} border loops", self.components, self.euler, self.border_loops)
    }
}

/// Counts of one mesh as its indices say, and as its positions say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Topologies {
    /// As indexed.
    pub indexed: TopologyCounts,
    /// After an exact weld.
    pub welded: TopologyCounts,
}

impl Topologies {
    pub(crate) fn of(mesh: &TriMesh, welded: &Welded) -> Self {
        let by_position = TopologyCounts::with_edges(welded.mesh().faces(), welded.edges());
        // Without vertices at the same position the weld has only numbered them anew, which no count depends on.
        let indexed = if welded.merged() { TopologyCounts::of(mesh) } else { by_position };
        Self { indexed, welded: by_position }
    }
}

/// One more than the greatest vertex that a face names.
pub(crate) fn n_vertices(faces: &IdVec<FaceId, [VertexId; 3]>) -> usize {
    faces.iter().flatten().max().map_or(0, |v| v.index() + 1)
}

/// Number of connected parts of a graph, vertices without edges left out.
fn parts(n_vertices: usize, edges: impl Iterator<Item = [VertexId; 2]>) -> usize {
    let mut sets = UnionFind::new(n_vertices);
    let mut used = vec![false; n_vertices];
    for [a, b] in edges {
        sets.join(a.index(), b.index());
        used[a.index()] = true;
        used[b.index()] = true;
    }
    (0..n_vertices).filter(|&v| used[v] && sets.find(v) == v).count()
}

/// Vertices whose corners do not hang together by the edges at the vertex.
fn nonmanifold_vertices(faces: &IdVec<FaceId, [VertexId; 3]>, edges: &Edges, n_vertices: usize) -> usize {
    let index = |side: &Side, end: usize| 3 * side.face.index() + side.corners()[end];
    let mut fans = UnionFind::new(3 * faces.len());
    for pair in edges.iter().flat_map(|sides| sides.windows(2)) {
        for end in [0, 1] {
            fans.join(index(&pair[0], end), index(&pair[1], end));
        }
    }
    let mut n_fans = vec![0; n_vertices];
    for (f, vertices) in faces.enumerate() {
        for (c, v) in vertices.iter().enumerate() {
            let i = 3 * f.index() + c;
            n_fans[v.index()] += usize::from(fans.find(i) == i);
        }
    }
    n_fans.into_iter().filter(|&n| n > 1).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(faces: &[[u32; 3]]) -> TopologyCounts {
        TopologyCounts::of(&TriMesh::from_slices(&[[0.0; 3]; 9], faces).unwrap())
    }

    #[test]
    fn closed_open_and_pinched() {
        let tetrahedron = counts(&[[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]);
        assert_eq!((tetrahedron.components, tetrahedron.euler, tetrahedron.border_loops), (1, 2, 0));
        assert!(tetrahedron.manifold() && tetrahedron.oriented);

        let two_triangles = counts(&[[0, 1, 2], [5, 6, 7]]);
        assert_eq!((two_triangles.vertices, two_triangles.components, two_triangles.border_loops), (6, 2, 2));
        assert!(two_triangles.manifold() && !two_triangles.same_as(&tetrahedron));

        let bow_tie = counts(&[[0, 1, 2], [0, 3, 4]]);
        assert_eq!((bow_tie.nonmanifold_vertices, bow_tie.components, bow_tie.border_loops), (1, 1, 1));
        assert!(!bow_tie.manifold());

        let book = counts(&[[0, 1, 2], [1, 0, 3], [0, 1, 4]]);
        assert_eq!((book.nonmanifold_edges, book.nonmanifold_vertices), (1, 0));

        assert!(!counts(&[[0, 1, 2], [0, 1, 3]]).oriented);
    }
}
