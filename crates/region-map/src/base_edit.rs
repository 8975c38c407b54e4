//! A change of the connectivity of a base mesh, found by one stage and carried out by another.

use mesh_core::VertexId;

/// A change of the connectivity of a base mesh. In a list of them each one is meant for what the ones before leave, and a new vertex takes
/// the number after the highest that there ever was.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BaseEdit {
    /// The edge between two vertices is replaced by the other diagonal of its two faces.
    Flip([VertexId; 2]),
    /// The edge between two vertices gets a new vertex in its middle.
    Split([VertexId; 2]),
    /// A vertex is taken away, and its star filled with these triangles. One on an arc leaves an edge between its neighbours there.
    Remove {
        /// The vertex.
        vertex: VertexId,
        /// The triangles in its place, oriented as the mesh.
        filling: Vec<[VertexId; 3]>,
    },
}
