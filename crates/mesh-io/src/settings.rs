//! [`Settings`] and [`Level`]: what a file gets beside a mesh.

use crate::attributes::Attributes;
use crate::error::WriteError;
use mesh_core::TriMesh;

/// What a file gets beside positions and triangles.
#[derive(Clone, Copy, Debug)]
pub struct Settings<'a> {
    /// What the vertices and triangles have. A format that does not hold something leaves it out: [`crate::Format::holds`] tells what.
    pub attributes: &'a Attributes,
    /// Edges to draw, as pairs of vertices: lines of an obj (`l`), a ply (the element `edge`) and a gltf (a mesh of its own).
    pub lines: &'a [[u32; 2]],
}

impl Settings<'_> {
    /// Checks that all arrays are those of the mesh.
    pub(crate) fn check(&self, mesh: &TriMesh) -> Result<(), WriteError> {
        let a = self.attributes;
        let (vertices, faces) = (mesh.n_vertices(), mesh.n_faces());
        let layers = a.uvs.iter().map(|layer| ("texture coordinates", layer.len(), faces));
        let values = a.vertex_values.iter().map(|v| (v.name.as_str(), v.values.len(), vertices));
        let face_values = a.face_values.iter().map(|v| (v.name.as_str(), v.values.len(), faces));
        let others = [
            ("normals", a.normals.len(), faces),
            ("colours", a.colors.len(), vertices),
            ("colours of faces", a.face_colors.len(), faces),
            ("materials", a.materials.of_face.len(), faces),
            ("objects", a.objects.of_face.len(), faces),
            ("groups", a.groups.of_face.len(), faces),
        ];
        let wrong =
            layers.chain(values).chain(face_values).chain(others).find(|&(_, found, wanted)| found != 0 && found != wanted);
        if let Some((what, found, expected)) = wrong {
            return Err(WriteError::AttributeCount { what: what.to_owned(), found, expected });
        }
        match self.lines.iter().flatten().find(|&&v| v as usize >= vertices) {
            Some(&vertex) => Err(WriteError::NoSuchVertex { vertex, vertices }),
            None => Ok(()),
        }
    }
}

/// A level of a mesh, with what belongs to it.
#[derive(Clone, Copy)]
pub struct Level<'a> {
    /// Its positions and triangles.
    pub mesh: &'a TriMesh,
    /// What it has beside.
    pub settings: Settings<'a>,
}
