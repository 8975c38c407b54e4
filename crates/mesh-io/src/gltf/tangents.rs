//! Tangents at the corners of triangles, for materials with a map of normals.
//!
//! Such a map says where normals point in a frame of normal, tangent and bitangent. A file without tangents leaves them to each viewer (glTF 2.0, section
//! 3.7.2.1); these are what it asks viewers for: those of MikkTSpace.

use super::attributes::{single_normal, single_uv};
use crate::attributes::Attributes;
use crate::looks::Looks;
use bevy_mikktspace::{Geometry, TangentSpace};
use glam::{DVec2, DVec3};
use mesh_core::TriMesh;
use serde_json::Value;

/// Of each corner of a triangle: a unit vector along the first texture coordinate, and on which side of it the bitangent is, 1 or -1.
pub(super) type Tangents = Vec<[[f32; 4]; 3]>;

/// The tangents of a mesh. `None` where no material has a map of normals, or normals or texture coordinates are missing.
pub(super) fn tangents(mesh: &TriMesh, attributes: &Attributes) -> Option<Tangents> {
    let layer = layer_of_normal_map(&attributes.looks)?;
    let (normals, uvs) = (&attributes.normals, attributes.uvs.get(layer)?);
    if normals.is_empty() {
        return None;
    }
    let mut surface = Textured { mesh, normals, uvs, tangents: vec![[[1.0, 0.0, 0.0, 1.0]; 3]; mesh.n_faces()] };
    bevy_mikktspace::generate_tangents(&mut surface).ok()?;
    Some(surface.tangents)
}

/// The texture coordinates of the first map of normals that a material has.
fn layer_of_normal_map(looks: &Looks) -> Option<usize> {
    let Looks::Gltf(looks) = looks else { return None };
    let map = looks.arrays.get("materials")?.as_array()?.iter().find_map(|material| material.get("normalTexture"))?;
    Some(map.get("texCoord").and_then(Value::as_u64).unwrap_or(0) as usize)
}

/// A mesh with normals and texture coordinates at its corners.
struct Textured<'a> {
    mesh: &'a TriMesh,
    normals: &'a [[DVec3; 3]],
    uvs: &'a [[DVec2; 3]],
    tangents: Tangents,
}

impl Geometry for Textured<'_> {
    fn num_faces(&self) -> usize {
        self.mesh.n_faces()
    }

    fn num_vertices_of_face(&self, _: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.mesh.position(self.mesh.faces().as_slice()[face][corner]).as_vec3().to_array()
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        single_normal(self.normals[face][corner])
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        single_uv(self.uvs[face][corner])
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, corner: usize) {
        let Some([x, y, z, side]) = space.as_ref().map(TangentSpace::tangent_encoded) else { return };
        if [x, y, z].iter().any(|&number| number != 0.0) {
            // A glTF counts the second texture coordinate downwards, and its bitangent points up.
            self.tangents[face][corner] = [x, y, z, -side];
        }
    }
}
