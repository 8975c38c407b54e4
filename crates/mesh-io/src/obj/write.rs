//! Writing obj.

use super::face::push_face;
use crate::attributes::Attributes;
use crate::corners::{Corner, Distinct};
use crate::looks::Looks;
use crate::{Labels, Settings};
use mesh_core::TriMesh;
use std::fmt::Write as _;

/// The mesh as obj. Coordinates have the fewest digits that give them back exactly; texture coordinates and normals are rounded to f32.
pub(crate) fn write(mesh: &TriMesh, settings: &Settings) -> Vec<u8> {
    let attributes = settings.attributes;
    let mut text = String::new();
    if let Looks::Libraries(names) = &attributes.looks {
        names.iter().for_each(|name| line(&mut text, format_args!("mtllib {name}")));
    }
    for (v, p) in mesh.positions().iter().enumerate() {
        // Writing to a String cannot fail.
        let _ = write!(text, "v {:?} {:?} {:?}", p.x, p.y, p.z);
        if let Some([r, g, b, _]) = attributes.colors.get(v) {
            let _ = write!(text, " {r:?} {g:?} {b:?}");
        }
        text.push('\n');
    }
    let uvs = attributes.uvs.first().map(|layer| {
        let rounded: Vec<[[f32; 2]; 3]> = layer.iter().map(|t| t.map(|uv| uv.as_vec2().to_array())).collect();
        numbered(&mut text, "vt", mesh, &rounded)
    });
    let normals = (!attributes.normals.is_empty()).then(|| {
        let rounded: Vec<[[f32; 3]; 3]> = attributes.normals.iter().map(|t| t.map(|n| n.as_vec3().to_array())).collect();
        numbered(&mut text, "vn", mesh, &rounded)
    });
    faces(&mut text, mesh, attributes, uvs.as_deref(), normals.as_deref());
    for [a, b] in settings.lines {
        line(&mut text, format_args!("l {} {}", a + 1, b + 1));
    }
    text.into_bytes()
}

fn line(text: &mut String, words: std::fmt::Arguments) {
    let _ = writeln!(text, "{words}");
}

/// The number of a value that is not there.
const NONE: u32 = 0;

/// Writes every value once and returns its number for each corner, from 1; [`NONE`] where it is not a number.
fn numbered<const N: usize>(text: &mut String, keyword: &str, mesh: &TriMesh, values: &[[[f32; N]; 3]]) -> Vec<[u32; 3]> {
    let bits = |(f, c): Corner| values[f][c].map(f32::to_bits);
    let distinct = Distinct::new(mesh, |a, b| bits(a) == bits(b));
    let mut written = 0;
    let number = |&(f, c): &Corner| {
        let value = values[f][c];
        if value.iter().any(|x| x.is_nan()) {
            return NONE;
        }
        text.push_str(keyword);
        value.iter().for_each(|x| text.push_str(&format!(" {x:?}")));
        text.push('\n');
        written += 1;
        written
    };
    let numbers: Vec<u32> = distinct.first.iter().map(number).collect();
    distinct.of_corner.iter().map(|t| t.map(|i| numbers[i as usize])).collect()
}

fn faces(text: &mut String, mesh: &TriMesh, attributes: &Attributes, uvs: Option<&[[u32; 3]]>, normals: Option<&[[u32; 3]]>) {
    let states = [("o", &attributes.objects), ("g", &attributes.groups), ("usemtl", &attributes.materials)];
    let mut current = [Labels::NONE; 3];
    for (f, face) in mesh.faces().iter().enumerate() {
        for ((keyword, labels), current) in states.iter().zip(&mut current) {
            let label = labels.of_face.get(f).copied().unwrap_or(Labels::NONE);
            if std::mem::replace(current, label) != label {
                line(text, format_args!("{keyword} {}", name(labels, label)));
            }
        }
        if uvs.is_none() && normals.is_none() {
            push_face(text, face.iter().map(|v| i64::from(v.0)));
            continue;
        }
        text.push('f');
        for (c, v) in face.iter().enumerate() {
            let _ = write!(text, " {}", v.0 + 1);
            let [uv, normal] = [uvs, normals].map(|numbers| numbers.map_or(NONE, |numbers| numbers[f][c]));
            let _ = match (uv, normal) {
                (NONE, NONE) => Ok(()),
                (uv, NONE) => write!(text, "/{uv}"),
                (NONE, normal) => write!(text, "//{normal}"),
                (uv, normal) => write!(text, "/{uv}/{normal}"),
            };
        }
        text.push('\n');
    }
}

/// A name that an obj file can hold: never empty. What has no name gets its number.
fn name(labels: &Labels, label: u32) -> String {
    match labels.names.get(label as usize).map(|name| name.split_whitespace().collect::<Vec<_>>().join(" ")) {
        Some(name) if !name.is_empty() => name,
        _ if label == Labels::NONE => "none".to_owned(),
        _ => format!("unnamed_{label}"),
    }
}
