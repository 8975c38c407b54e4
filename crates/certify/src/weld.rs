//! Exact weld: vertices at one position become one.

use crate::edges::Edges;
use mesh_core::{IdVec, TriMesh, VertexId, place};
use rustc_hash::FxHashMap;

/// A mesh connected by position, and its edges.
#[derive(Debug)]
pub(crate) struct Welded {
    mesh: TriMesh,
    edges: Edges,
    /// For every vertex of the original the first one at its position; `None` where none share one.
    first: Option<IdVec<VertexId, VertexId>>,
}

impl Welded {
    pub(crate) fn of(mesh: &TriMesh) -> Self {
        let first = first_at_position(mesh);
        let is_merged = first.enumerate().any(|(v, &first)| first != v);
        let mesh = weld_by(mesh, &first);
        Self { edges: Edges::of(mesh.faces()), mesh, first: is_merged.then_some(first) }
    }

    /// The welded mesh.
    pub(crate) fn mesh(&self) -> &TriMesh {
        &self.mesh
    }

    /// Edges of the welded mesh.
    pub(crate) fn edges(&self) -> &Edges {
        &self.edges
    }

    /// Whether vertices at the same position were made one.
    pub(crate) fn merged(&self) -> bool {
        self.first.is_some()
    }

    /// The first vertex of the original at the position of each of these.
    pub(crate) fn first(&self, vertices: [VertexId; 3]) -> [VertexId; 3] {
        self.first.as_ref().map_or(vertices, |first| vertices.map(|v| first[v]))
    }
}

/// For every vertex the first one at its position.
fn first_at_position(mesh: &TriMesh) -> IdVec<VertexId, VertexId> {
    let mut at: FxHashMap<[u64; 3], VertexId> = FxHashMap::default();
    at.reserve(mesh.n_vertices());
    mesh.positions().enumerate().map(|(v, &p)| *at.entry(place(p)).or_insert(v)).collect()
}

/// The mesh with vertices at the same position made one, faces that lose a corner by it dropped, and only vertices that faces
/// use, in the order of their first use.
///
/// Connectivity by position is what another program sees in a file, whatever the indices say.
pub fn weld(mesh: &TriMesh) -> TriMesh {
    weld_by(mesh, &first_at_position(mesh))
}

fn weld_by(mesh: &TriMesh, first: &IdVec<VertexId, VertexId>) -> TriMesh {
    let mut new_index = IdVec::<VertexId, Option<u32>>::filled(None, mesh.n_vertices());
    let mut positions = Vec::new();
    let mut faces = Vec::with_capacity(mesh.n_faces());
    for f in mesh.faces() {
        let [a, b, c] = f.map(|v| first[v]);
        if a == b || b == c || c == a {
            continue;
        }
        faces.push([a, b, c].map(|v| {
            *new_index[v].get_or_insert_with(|| {
                positions.push(mesh.position(v));
                positions.len() as u32 - 1
            })
        }));
    }
    TriMesh::new(positions, faces).expect("corners are distinct and positions are those of a checked mesh")
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn two_sheets_of_one_square_are_joined() {
        let p = |x: f64, y: f64| DVec3::new(x, y, 0.0);
        let unused = p(9.0, 9.0);
        let positions = vec![unused, p(0.0, 0.0), p(1.0, 0.0), p(0.0, 1.0), p(1.0, 0.0), p(1.0, 1.0), p(-0.0, 1.0)];
        let mesh = TriMesh::new(positions, vec![[1, 2, 3], [4, 5, 6], [2, 4, 5]]).unwrap();
        let welded = weld(&mesh);
        assert_eq!((welded.n_vertices(), welded.n_faces()), (4, 2));
        assert_eq!(welded.to_soup().triangles, [[0, 1, 2], [1, 3, 2]]);
    }
}
