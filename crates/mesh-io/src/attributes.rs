//! What a mesh has beside positions and triangles: normals, texture coordinates, colours, values and labels.

use crate::looks::Looks;
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// What a mesh has beside positions and triangles, in arrays beside them. An array without entries says that there is no such thing; else it
/// has one entry for each vertex or triangle, in their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attributes {
    /// Normals at the three corners of each triangle, of length 1 as far as the file keeps that; not a number where it gives none.
    pub normals: Vec<[DVec3; 3]>,
    /// Layers of texture coordinates: for each layer those at the three corners of each triangle, in parts of the image from its lower left;
    /// not a number where the file gives none.
    pub uvs: Vec<Vec<[DVec2; 3]>>,
    /// Red, green, blue and opacity of each vertex, 0 to 1. White where the file gives none.
    pub colors: Vec<[f64; 4]>,
    /// Red, green, blue and opacity of each triangle, 0 to 1.
    pub face_colors: Vec<[f64; 4]>,
    /// Numbers at the vertices.
    pub vertex_values: Vec<Values>,
    /// Numbers of the triangles.
    pub face_values: Vec<Values>,
    /// Materials of the triangles.
    pub materials: Labels,
    /// Named objects (`o` of an obj, nodes of a gltf) that the triangles belong to.
    pub objects: Labels,
    /// Named groups (`g` of an obj) that the triangles belong to.
    pub groups: Labels,
    /// The smoothing group of each triangle (`s` of an obj); 0 for none. Edges between groups, and all of triangles without one, are hard.
    pub smoothing: Vec<u32>,
    /// What the materials look like.
    pub looks: Looks,
}

/// Numbers with a name, one for each vertex or triangle.
#[derive(Clone, Debug, PartialEq)]
pub struct Values {
    /// The name that the file gives them.
    pub name: String,
    /// Whether they may be mixed.
    pub kind: ValueKind,
    /// The numbers.
    pub values: Vec<f64>,
}

/// Whether numbers may be mixed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ValueKind {
    /// A measure of single precision: values between two others make sense.
    Single,
    /// A measure of double precision.
    Double,
    /// A label of 32 bits, with or without sign: one of the given numbers, never one between them.
    Label,
}

/// Names, and which of them each triangle has.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Labels {
    /// The names, each once, in the order of the file. An empty one is a thing without name.
    pub names: Vec<String>,
    /// The index of its name for each triangle, [`Labels::NONE`] without one.
    pub of_face: Vec<u32>,
}

impl Labels {
    /// Of a triangle without a name.
    pub const NONE: u32 = u32::MAX;

    /// Whether no triangle has a name.
    pub fn is_empty(&self) -> bool {
        self.of_face.is_empty()
    }
    /// The name of a triangle.
    pub fn name(&self, face: usize) -> Option<&str> {
        self.names.get(*self.of_face.get(face)? as usize).map(String::as_str)
    }
}

/// Collects names, each once.
#[derive(Default)]
pub(crate) struct Names {
    names: Vec<String>,
    indices: BTreeMap<String, u32>,
}

impl Names {
    /// The index of a name, which is added if it is new.
    pub(crate) fn index_of(&mut self, name: String) -> u32 {
        let next = self.names.len() as u32;
        *self.indices.entry(name).or_insert_with_key(|name| {
            self.names.push(name.clone());
            next
        })
    }
    /// Number of names.
    pub(crate) fn len(&self) -> usize {
        self.names.len()
    }
    /// The names in the order in which they came.
    pub(crate) fn into_names(self) -> Vec<String> {
        self.names
    }
}

/// Where the file gives no normal.
pub(crate) const NO_NORMAL: [DVec3; 3] = [DVec3::NAN; 3];
/// Where the file gives no texture coordinates.
pub(crate) const NO_UV: [DVec2; 3] = [DVec2::NAN; 3];
/// Where the file gives no colour.
pub(crate) const WHITE: [f64; 4] = [1.0; 4];

impl Attributes {
    /// Whether any colour is not opaque.
    pub(crate) fn has_opacity(colors: &[[f64; 4]]) -> bool {
        colors.iter().any(|c| c[3] != 1.0)
    }

    /// Fills up what the end of a file gives no values for, and drops what it gives none for anywhere.
    pub(crate) fn complete(&mut self, n_vertices: usize, n_triangles: usize) {
        let fill_uv = |layer: &mut Vec<[DVec2; 3]>| fill(layer, n_triangles, NO_UV);
        fill(&mut self.normals, n_triangles, NO_NORMAL);
        self.uvs.iter_mut().for_each(fill_uv);
        fill(&mut self.colors, n_vertices, WHITE);
        fill(&mut self.face_colors, n_triangles, WHITE);
        self.vertex_values.iter_mut().for_each(|v| fill(&mut v.values, n_vertices, 0.0));
        self.face_values.iter_mut().for_each(|v| fill(&mut v.values, n_triangles, 0.0));
        for labels in [&mut self.materials, &mut self.objects, &mut self.groups] {
            fill(&mut labels.of_face, n_triangles, Labels::NONE);
            if labels.of_face.iter().all(|&l| l == Labels::NONE) {
                labels.of_face.clear();
            }
        }
        fill(&mut self.smoothing, n_triangles, 0);
        if self.normals.iter().flatten().all(|n| n.is_nan()) {
            self.normals.clear();
        }
        self.uvs.retain(|layer| layer.iter().flatten().any(|uv| !uv.is_nan()));
        self.vertex_values.retain(|v| !v.values.is_empty());
        self.face_values.retain(|v| !v.values.is_empty());
    }
}

/// Fills a list up to a length, if there is anything in it.
fn fill<T: Clone>(list: &mut Vec<T>, length: usize, with: T) {
    if !list.is_empty() {
        list.resize(length, with);
    }
}

/// Puts values at the place `start` of a list, which is filled up to there.
pub(crate) fn put<T: Clone>(list: &mut Vec<T>, start: usize, values: impl IntoIterator<Item = T>, fill_with: T) {
    list.resize(start, fill_with);
    list.extend(values);
}
