//! Writing ply.

use crate::attributes::Attributes;
use crate::looks::Looks;
use crate::{Labels, Settings, ValueKind, Values};
use glam::DVec3;
use mesh_core::TriMesh;
use std::fmt::Write as _;

/// The mesh as little endian binary ply, positions in f64.
///
/// A ply has one normal for each vertex, and vertices in the order of the subdivision cannot be split: there are normals where each vertex has
/// only one. Texture coordinates are a list at each face (`texcoord`), as MeshLab has them. Labels with names are numbers, their names comments.
pub(crate) fn write(mesh: &TriMesh, settings: &Settings) -> Vec<u8> {
    let attributes = settings.attributes;
    let normals = vertex_normals(mesh, &attributes.normals);
    let labels = [("material", &attributes.materials), ("object", &attributes.objects), ("group", &attributes.groups)];
    let labels: Vec<(&str, &Labels)> = labels.into_iter().filter(|(_, labels)| !labels.is_empty()).collect();
    let mut bytes = header(mesh, settings, &labels, normals.is_some()).into_bytes();
    let [width, face_width] = [&attributes.colors, &attributes.face_colors].map(|colors| color_width(colors));
    for (v, p) in mesh.positions().iter().enumerate() {
        bytes.extend(p.to_array().iter().flat_map(|x| x.to_le_bytes()));
        if let Some(normals) = &normals {
            bytes.extend(normals[v].as_vec3().to_array().iter().flat_map(|x| x.to_le_bytes()));
        }
        push_color(&mut bytes, &attributes.colors, v, width);
        attributes.vertex_values.iter().for_each(|values| push_value(&mut bytes, values, v));
    }
    for (f, corners) in mesh.faces().iter().enumerate() {
        bytes.push(3);
        bytes.extend(corners.iter().flat_map(|v| v.0.to_le_bytes()));
        if let Some(layer) = attributes.uvs.first() {
            bytes.push(6);
            bytes.extend(layer[f].iter().flat_map(|uv| uv.as_vec2().to_array()).flat_map(f32::to_le_bytes));
        }
        push_color(&mut bytes, &attributes.face_colors, f, face_width);
        labels.iter().for_each(|(_, labels)| bytes.extend((labels.of_face[f] as i32).to_le_bytes()));
        attributes.face_values.iter().for_each(|values| push_value(&mut bytes, values, f));
    }
    settings.lines.iter().flatten().for_each(|v| bytes.extend(v.to_le_bytes()));
    bytes
}

fn header(mesh: &TriMesh, settings: &Settings, labels: &[(&str, &Labels)], has_normals: bool) -> String {
    let attributes = settings.attributes;
    let mut text = "ply\nformat binary_little_endian 1.0\n".to_owned();
    if let Looks::Images(names) = &attributes.looks {
        names.iter().for_each(|name| line(&mut text, format_args!("comment TextureFile {name}")));
    }
    for (kind, labels) in labels {
        for (i, name) in labels.names.iter().enumerate() {
            let one_line = name.split_whitespace().collect::<Vec<_>>().join(" ");
            line(&mut text, format_args!("comment {kind} {i} {one_line}"));
        }
    }
    let _ = write!(text, "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n", mesh.n_vertices());
    if has_normals {
        text += "property float nx\nproperty float ny\nproperty float nz\n";
    }
    text += &color_properties(&attributes.colors);
    attributes.vertex_values.iter().for_each(|values| push_property(&mut text, values));
    let _ = write!(text, "element face {}\nproperty list uchar int vertex_indices\n", mesh.n_faces());
    if !attributes.uvs.is_empty() {
        text += "property list uchar float texcoord\n";
    }
    text += &color_properties(&attributes.face_colors);
    labels.iter().for_each(|(kind, _)| line(&mut text, format_args!("property int {kind}")));
    attributes.face_values.iter().for_each(|values| push_property(&mut text, values));
    if !settings.lines.is_empty() {
        let _ = write!(text, "element edge {}\nproperty int vertex1\nproperty int vertex2\n", settings.lines.len());
    }
    text + "end_header\n"
}

/// Appends a line.
fn line(text: &mut String, words: std::fmt::Arguments) {
    // Writing to a String cannot fail.
    let _ = writeln!(text, "{words}");
}

/// The normal of each vertex, if each has only one (to f32). A vertex without faces has any.
fn vertex_normals(mesh: &TriMesh, normals: &[[DVec3; 3]]) -> Option<Vec<DVec3>> {
    if normals.is_empty() {
        return None;
    }
    let mut of_vertices = vec![None; mesh.n_vertices()];
    for (face, normals) in mesh.faces().iter().zip(normals) {
        for (v, normal) in face.iter().zip(normals) {
            let known: &mut Option<DVec3> = &mut of_vertices[v.0 as usize];
            if known.get_or_insert(*normal).as_vec3() != normal.as_vec3() {
                return None;
            }
        }
    }
    Some(of_vertices.into_iter().map(|normal| normal.unwrap_or(DVec3::Z)).collect())
}

/// How many numbers a colour has: opacity is written where something is not opaque.
fn color_width(colors: &[[f64; 4]]) -> usize {
    match (colors.is_empty(), Attributes::has_opacity(colors)) {
        (true, _) => 0,
        (false, false) => 3,
        (false, true) => 4,
    }
}

fn color_properties(colors: &[[f64; 4]]) -> String {
    let names = ["red", "green", "blue", "alpha"];
    names[..color_width(colors)].iter().map(|name| format!("property uchar {name}\n")).collect()
}

/// Appends the colour of a vertex or face, if there is one.
fn push_color(bytes: &mut Vec<u8>, colors: &[[f64; 4]], i: usize, width: usize) {
    bytes.extend(colors.get(i).iter().flat_map(|color| &color[..width]).map(|x| (255.0 * x).round() as u8));
}

fn push_property(text: &mut String, values: &Values) {
    let kind = match values.kind {
        ValueKind::Single => "float",
        ValueKind::Double => "double",
        ValueKind::Label if is_unsigned(values) => "uint",
        ValueKind::Label => "int",
    };
    // A name of several words would be none.
    let name = values.name.split_whitespace().collect::<Vec<_>>().join("_");
    let _ = writeln!(text, "property {kind} {name}");
}

/// Whether a label needs the sign's bit.
fn is_unsigned(values: &Values) -> bool {
    values.values.iter().any(|&x| x > f64::from(i32::MAX))
}

fn push_value(bytes: &mut Vec<u8>, values: &Values, i: usize) {
    let x = values.values[i];
    match values.kind {
        ValueKind::Single => bytes.extend((x as f32).to_le_bytes()),
        ValueKind::Double => bytes.extend(x.to_le_bytes()),
        // Both keep the 32 bits of their numbers.
        ValueKind::Label => bytes.extend((x as i64 as u32).to_le_bytes()),
    }
}
