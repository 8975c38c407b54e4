//! Numbers of vertices, faces and border edges of each component, and what subdivision makes of them.

use crate::edges::Edges;
use crate::topology::n_vertices;
use crate::union_find::UnionFind;
use mesh_core::{FaceId, Id, IdVec, TriMesh, VertexId};

/// Counts of one component.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ComponentCounts {
    /// Vertices.
    pub vertices: i64,
    /// Edges.
    pub edges: i64,
    /// Faces.
    pub faces: i64,
    /// Edges with one face.
    pub border_edges: i64,
}

impl std::fmt::Display for ComponentCounts {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { vertices, edges, faces, border_edges } = self;
        write!(f, "{vertices} vertices, {edges} edges, {faces} faces, {border_edges} border edges")
    }
}

impl ComponentCounts {
    /// Euler number.
    pub fn euler(&self) -> i64 {
        self.vertices - self.edges + self.faces
    }

    /// The counts of a manifold component after `levels` 1-to-4 splits: F_n = 4^n F_0, B_n = 2^n B_0,
    /// V_n = 4^n (V_0 - X) + X - (4^n - 2^n) B_0 / 2 with the Euler number X, which stays.
    pub(crate) fn subdivided(&self, levels: u32) -> Self {
        let (four, two, x) = (4i64.pow(levels), 2i64.pow(levels), self.euler());
        let faces = four * self.faces;
        let vertices = four * (self.vertices - x) + x - (four - two) * self.border_edges / 2;
        Self { vertices, edges: vertices + faces - x, faces, border_edges: two * self.border_edges }
    }
}

/// Counts every component of a mesh, in the order of their first faces.
pub fn component_counts(mesh: &TriMesh) -> Vec<ComponentCounts> {
    of_faces(mesh.faces())
}

/// The same of faces alone.
pub(crate) fn of_faces(faces: &IdVec<FaceId, [VertexId; 3]>) -> Vec<ComponentCounts> {
    let mut sets = UnionFind::new(n_vertices(faces));
    for [a, b, c] in faces {
        sets.join(a.index(), b.index());
        sets.join(b.index(), c.index());
    }
    let mut number = vec![None; n_vertices(faces)];
    let mut counts: Vec<ComponentCounts> = Vec::new();
    for f in faces {
        let component = *number[sets.find(f[0].index())].get_or_insert_with(|| {
            counts.push(ComponentCounts::default());
            counts.len() - 1
        });
        counts[component].faces += 1;
    }
    let mut component_of = |v: VertexId| number[sets.find(v.index())];
    for sides in Edges::of(faces).iter() {
        let Some(component) = component_of(sides[0].ends[0]) else { continue };
        counts[component].edges += 1;
        counts[component].border_edges += i64::from(sides.len() == 1);
    }
    for v in (0..n_vertices(faces)).map(VertexId::new) {
        // A vertex without faces is a set of its own that no face numbered.
        let Some(component) = component_of(v) else { continue };
        counts[component].vertices += 1;
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_shapes::{cube, joined, mesh, square, subdivide};

    #[test]
    fn the_formula_is_what_subdivision_gives() {
        let three_fans =
            mesh(&[[0.; 3], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.], [-1., 1., 0.]], &[[0, 1, 2], [0, 2, 3], [0, 3, 4]]);
        let base = joined(&joined(&cube(), &square()), &three_fans);
        let counted = component_counts(&base);
        assert_eq!(
            counted.iter().map(|c| (c.vertices, c.euler(), c.border_edges)).collect::<Vec<_>>(),
            [(8, 2, 0), (4, 1, 4), (5, 1, 5)]
        );
        let mut fine = base.clone();
        for n in 0..4 {
            let expected: Vec<_> = counted.iter().map(|c| c.subdivided(n)).collect();
            assert_eq!(component_counts(&fine), expected, "level {n}");
            fine = subdivide(&fine);
        }
    }
}
