//! What became of the vertices and triangles of the soup.

use super::editable_mesh::EditableMesh;
use crate::{FaceId, IdVec, Soup, VertexId};

/// Whether each vertex is where its vertex of the soup is. Those in the middle of split edges are not.
pub(super) fn stayed(mesh: &EditableMesh, soup: &Soup) -> IdVec<VertexId, bool> {
    let is_there = |(v, &source): (VertexId, &u32)| mesh.positions[v] == soup.positions[source as usize];
    mesh.source_vertex.enumerate().map(is_there).collect()
}

/// For every triangle of the soup the first face that it is or that lies in it.
pub(super) fn face_of(mesh: &EditableMesh, soup: &Soup) -> Vec<Option<FaceId>> {
    let mut face_of = vec![None; soup.triangles.len()];
    for (f, &source) in mesh.source_face.enumerate() {
        face_of[source as usize].get_or_insert(f);
    }
    face_of
}

/// For every vertex of the soup the one that it is, or was merged into.
///
/// Where a vertex has several copies, the faces tell which of them belongs to a triangle: a file that shares no vertices has one for each
/// triangle. A vertex whose triangles are all gone takes the first copy.
pub(super) fn vertex_of(mesh: &EditableMesh, soup: &Soup, stayed: &IdVec<VertexId, bool>) -> Vec<Option<VertexId>> {
    let mut of_faces = vec![None; soup.positions.len()];
    for (f, corners) in mesh.faces.enumerate() {
        for v in soup.triangles[mesh.source_face[f] as usize] {
            let merged = mesh.merged_into[v as usize];
            let corner = corners.iter().find(|&&c| stayed[c] && mesh.source_vertex[c] == merged);
            of_faces[v as usize] = of_faces[v as usize].or(corner.copied());
        }
    }
    let mut first = vec![None; soup.positions.len()];
    for (v, &source) in mesh.source_vertex.enumerate().filter(|&(v, _)| stayed[v]) {
        first[source as usize].get_or_insert(v);
    }
    of_faces.into_iter().zip(&mesh.merged_into).map(|(v, &merged)| v.or(first[merged as usize])).collect()
}
