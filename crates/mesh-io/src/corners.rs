//! Corners of a mesh that have the same values, for formats that number values or vertices.

use mesh_core::TriMesh;

/// A corner: the face, and which of its three.
pub(crate) type Corner = (usize, usize);

/// The different values at each vertex, numbered in the order in which the corners of the faces come by them.
pub(crate) struct Distinct {
    /// The number of the value at each corner.
    pub(crate) of_corner: Vec<[u32; 3]>,
    /// The first corner that has the value.
    pub(crate) first: Vec<Corner>,
    /// Whether it is the first value at its vertex.
    pub(crate) leads: Vec<bool>,
}

/// No value yet.
const NONE: u32 = u32::MAX;

impl Distinct {
    /// Values are never shared between vertices; `same` says whether two corners at one vertex have the same.
    pub(crate) fn new(mesh: &TriMesh, same: impl Fn(Corner, Corner) -> bool) -> Self {
        let mut latest = vec![NONE; mesh.n_vertices()];
        let mut before: Vec<u32> = Vec::new();
        let mut distinct = Self { of_corner: Vec::with_capacity(mesh.n_faces()), first: Vec::new(), leads: Vec::new() };
        for (f, vertices) in mesh.faces().iter().enumerate() {
            let of_face = [0, 1, 2].map(|c| {
                let list = &mut latest[vertices[c].0 as usize];
                let mut known = *list;
                while known != NONE && !same(distinct.first[known as usize], (f, c)) {
                    known = before[known as usize];
                }
                if known != NONE {
                    return known;
                }
                distinct.first.push((f, c));
                distinct.leads.push(*list == NONE);
                before.push(*list);
                *list = (before.len() - 1) as u32;
                *list
            });
            distinct.of_corner.push(of_face);
        }
        distinct
    }

    /// Number of values.
    pub(crate) fn len(&self) -> usize {
        self.first.len()
    }
}
