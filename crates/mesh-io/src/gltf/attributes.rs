//! What the vertices and triangles of a glTF mesh have beside positions. What cannot be read must not cost the mesh: it is not there.

use super::accessor::numbers;
use super::buffers::Buffers;
use super::scene::Instance;
use crate::attributes::{NO_NORMAL, NO_UV, WHITE, put};
use crate::document::Builder;
use crate::{Attributes, Labels};
use glam::{DMat3, DVec2, DVec3};
use gltf_json::mesh::{Primitive, Semantic};
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Index};

/// Where the triangles of a primitive are in the document.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    /// The vertex of the document for each of its own.
    pub(super) vertices: &'a [u32],
    /// Its triangles, by its own vertices.
    pub(super) triangles: &'a [[usize; 3]],
    /// The first of them in the document.
    pub(super) first: usize,
}

/// Appends normals, texture coordinates, colours and labels of a primitive whose triangles are in the document.
pub(super) fn push(builder: &mut Builder, buffers: &Buffers, instance: &Instance, primitive: &Primitive, place: Place) {
    let n_vertices = builder.n_vertices();
    let attributes = &mut builder.attributes;
    for (semantic, &accessor) in &primitive.attributes {
        match semantic {
            Checked::Valid(Semantic::Normals) => push_normals(attributes, buffers, instance, accessor, place),
            Checked::Valid(Semantic::TexCoords(layer)) => push_uvs(attributes, buffers, *layer as usize, accessor, place),
            Checked::Valid(Semantic::Colors(0)) => push_colors(attributes, buffers, n_vertices, accessor, place),
            _ => {}
        }
    }
    let n = place.triangles.len();
    if let Some(material) = primitive.material {
        put(&mut attributes.materials.of_face, place.first, vec![material.value() as u32; n], Labels::NONE);
    }
    if instance.object != Labels::NONE {
        put(&mut attributes.objects.of_face, place.first, vec![instance.object; n], Labels::NONE);
    }
}

fn push_normals(attributes: &mut Attributes, buffers: &Buffers, instance: &Instance, accessor: Index<Accessor>, place: Place) {
    let Ok(normals) = numbers::<3>(buffers, accessor) else { return };
    // Normals stay normal to what the transform makes of the surface.
    let turn = DMat3::from_mat4(instance.transform).inverse().transpose();
    let normal = |i: usize| normals.get(i).map_or(DVec3::NAN, |&n| (turn * DVec3::from(n)).normalize_or(DVec3::NAN));
    put(&mut attributes.normals, place.first, place.triangles.iter().map(|t| t.map(normal)), NO_NORMAL);
}

/// glTF counts texture coordinates from the upper left of the image.
fn upside_down(uv: DVec2) -> DVec2 {
    DVec2::new(uv.x, 1.0 - uv.y)
}

/// Texture coordinates as a file has them; 0 for what is no number.
pub(super) fn single_uv(uv: DVec2) -> [f32; 2] {
    upside_down(uv).as_vec2().to_array().map(|x| if x.is_finite() { x } else { 0.0 })
}

/// A normal as a file has it; z for what is no direction.
pub(super) fn single_normal(normal: DVec3) -> [f32; 3] {
    normal.normalize_or(DVec3::Z).as_vec3().to_array()
}

/// Layers that a file may have: more than any viewer takes.
const MOST_LAYERS: usize = 8;

fn push_uvs(attributes: &mut Attributes, buffers: &Buffers, layer: usize, accessor: Index<Accessor>, place: Place) {
    let Ok(uvs) = numbers::<2>(buffers, accessor) else { return };
    if layer >= MOST_LAYERS {
        return;
    }
    if attributes.uvs.len() <= layer {
        attributes.uvs.resize(layer + 1, Vec::new());
    }
    let uv = |i: usize| uvs.get(i).map_or(DVec2::NAN, |&uv| upside_down(uv.into()));
    put(&mut attributes.uvs[layer], place.first, place.triangles.iter().map(|t| t.map(uv)), NO_UV);
}

fn push_colors(attributes: &mut Attributes, buffers: &Buffers, n_vertices: usize, accessor: Index<Accessor>, place: Place) {
    let with_opacity = || numbers::<3>(buffers, accessor).map(|c| c.iter().map(|&[r, g, b]| [r, g, b, 1.0]).collect());
    let Ok(colors) = numbers::<4>(buffers, accessor).or_else(|_| with_opacity()) else { return };
    attributes.colors.resize(n_vertices, WHITE);
    for (&v, color) in place.vertices.iter().zip(colors) {
        attributes.colors[v as usize] = color;
    }
}
