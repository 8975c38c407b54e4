//! What the input has beside positions, carried over to the result.

use crate::marks::{SAME_UV, arrays};
use attributes::{Correspondence, Source, corner_values, correspond, face_values, vertex_labels, vertex_values};
use glam::DVec2;
use mesh_core::{Cleaned, EdgeId, IdVec, TriMesh};
use mesh_io::{Attributes, Document, Extra, Format, Labels, Looks, ValueKind, Values};
use std::path::{Component, Path, PathBuf};

/// Colours and other values on both sides of an edge are the same if they differ by no more than this share of their range.
const SAME_VALUE: f64 = 1e-6;

/// What a format holds of the attributes. Normals and smoothing groups are those of the new triangles.
fn wanted(all: &Attributes, format: Format) -> Attributes {
    let (is_ply, is_gltf) = (format == Format::Ply, matches!(format, Format::Gltf | Format::Glb));
    let [colors, materials, parts] = [Extra::Colors, Extra::Materials(1), Extra::Parts(2)].map(|extra| format.holds(&extra));
    Attributes {
        uvs: part(format.holds(&Extra::TextureCoordinates), &all.uvs),
        colors: part(colors, &all.colors),
        face_colors: part(is_ply, &all.face_colors),
        vertex_values: part(is_ply || is_gltf, &all.vertex_values),
        face_values: part(is_ply, &all.face_values),
        materials: part(materials, &all.materials),
        objects: part(parts, &all.objects),
        groups: part(parts, &all.groups),
        looks: part(materials, &all.looks),
        ..Attributes::default()
    }
}

fn part<T: Clone + Default>(is_held: bool, all: &T) -> T {
    if is_held { all.clone() } else { T::default() }
}

/// Edges of the input where values end that must not be mixed across: seams of textures, and colours and values that jump.
fn cuts(source: &Source, from: &Attributes, document: &Document) -> IdVec<EdgeId, bool> {
    let triangles = &document.soup.triangles;
    let mut all: Vec<IdVec<EdgeId, bool>> = from.uvs.iter().map(|layer| source.seams(&arrays(layer), SAME_UV)).collect();
    let at = |v: u32| v as usize;
    if !from.colors.is_empty() {
        let of_corners: Vec<[[f64; 4]; 3]> =
            triangles.iter().map(|t| t.map(|v| from.colors.get(at(v)).copied().unwrap_or_default())).collect();
        all.push(source.seams(&of_corners, SAME_VALUE));
    }
    for values in from.vertex_values.iter().filter(|values| values.kind != ValueKind::Label) {
        let range = values.values.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let of_corners: Vec<[[f64; 1]; 3]> =
            triangles.iter().map(|t| t.map(|v| [values.values.get(at(v)).copied().unwrap_or(0.0)])).collect();
        all.push(source.seams(&of_corners, SAME_VALUE * range));
    }
    let none = source.label_borders(&vec![0; triangles.len()]);
    all.iter().fold(none, |cuts, more| cuts.iter().zip(more.iter()).map(|(a, b)| a | b).collect())
}

/// Carries what a document has to meshes that were made of it.
pub(crate) struct Carrier<'a> {
    /// What the format of these meshes holds of it.
    from: Attributes,
    source: Source<'a>,
    cuts: IdVec<EdgeId, bool>,
    triangles: &'a [[u32; 3]],
}

impl<'a> Carrier<'a> {
    /// Of a document that was cleaned, to files of a format. `None` where there is nothing to carry.
    pub(crate) fn new(document: &'a Document, cleaned: &'a Cleaned, format: Format) -> Option<Self> {
        let from = wanted(&document.attributes, format);
        if from == Attributes::default() {
            return None;
        }
        let source = Source::new(&document.soup, cleaned);
        Some(Self { cuts: cuts(&source, &from, document), from, source, triangles: &document.soup.triangles })
    }

    /// What a mesh has of the attributes.
    pub(crate) fn carried(&self, mesh: &TriMesh) -> Attributes {
        let at = correspond(&self.source, &self.cuts, mesh);
        Carried { mesh, at, triangles: self.triangles }.of(&self.from)
    }
}

/// A mesh, and where it is on the input.
struct Carried<'a> {
    mesh: &'a TriMesh,
    at: Correspondence,
    triangles: &'a [[u32; 3]],
}

impl Carried<'_> {
    fn of(&self, from: &Attributes) -> Attributes {
        let layer = |layer: &Vec<[DVec2; 3]>| {
            corner_values(self.mesh, &self.at, &arrays(layer)).into_iter().map(|t| t.map(DVec2::from)).collect()
        };
        let colors = match from.colors.as_slice() {
            [] => Vec::new(),
            colors => vertex_values(self.mesh, &self.at, self.triangles, colors),
        };
        Attributes {
            uvs: from.uvs.iter().map(layer).collect(),
            colors,
            face_colors: self.of_faces(&from.face_colors),
            vertex_values: from.vertex_values.iter().map(|values| self.vertex_values(values)).collect(),
            face_values: from.face_values.iter().map(|v| Values { values: self.of_faces(&v.values), ..v.clone() }).collect(),
            materials: self.labels(&from.materials),
            objects: self.labels(&from.objects),
            groups: self.labels(&from.groups),
            looks: from.looks.clone(),
            ..Attributes::default()
        }
    }

    fn vertex_values(&self, from: &Values) -> Values {
        let values = match from.kind {
            ValueKind::Label => vertex_labels(self.mesh, &self.at, self.triangles, &from.values),
            ValueKind::Single | ValueKind::Double => {
                let single: Vec<[f64; 1]> = from.values.iter().map(|&x| [x]).collect();
                vertex_values(self.mesh, &self.at, self.triangles, &single).into_iter().map(|[x]| x).collect()
            }
        };
        Values { values, ..from.clone() }
    }

    fn labels(&self, from: &Labels) -> Labels {
        Labels { names: from.names.clone(), of_face: self.of_faces(&from.of_face) }
    }

    fn of_faces<T: Copy + PartialEq>(&self, values: &[T]) -> Vec<T> {
        if values.is_empty() { Vec::new() } else { face_values(&self.at, values) }
    }
}

/// What the materials look like, if the output says that in the same way. Names of files are as seen from the second folder, instead of the first.
pub(crate) fn looks(mut looks: Looks, format: Format, [from, to]: [&Path; 2]) -> Looks {
    let is_of_format = match looks {
        Looks::Libraries(_) => format == Format::Obj,
        Looks::Images(_) => format == Format::Ply,
        Looks::Gltf(_) => matches!(format, Format::Gltf | Format::Glb),
        Looks::Unknown => false,
    };
    if !is_of_format {
        return Looks::Unknown;
    }
    looks.rename(|name| seen_from(to, &from.join(name)).unwrap_or_else(|| name.to_owned()));
    looks
}

/// The path of a file relative to a folder, with slashes; `None` where there is none.
fn seen_from(folder: &Path, file: &Path) -> Option<String> {
    let (folder, file) = (plain(&std::path::absolute(folder).ok()?), plain(&std::path::absolute(file).ok()?));
    let shared = folder.components().zip(file.components()).take_while(|(a, b)| a == b).count();
    let up = folder.components().skip(shared).map(|_| "..".to_owned());
    let down = file.components().skip(shared).map(|part| part.as_os_str().to_string_lossy().into_owned());
    Some(up.chain(down).collect::<Vec<_>>().join("/"))
}

/// Without `..`.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => drop(plain.pop()),
            other => plain.push(other),
        }
    }
    plain
}
