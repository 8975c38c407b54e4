//! What vertices and faces of a ply have beside positions and indices.

use super::header::{Element, Kind, Scalar};
use crate::attributes::{Attributes, NO_NORMAL, NO_UV};
use crate::document::{Builder, OfVertices, fan};
use crate::{ValueKind, Values};
use glam::{DVec2, DVec3};

/// The scalar properties of an element that are attributes, column by column.
#[derive(Default)]
pub(super) struct Columns {
    columns: Vec<Column>,
}

struct Column {
    property: usize,
    name: String,
    scalar: Scalar,
    values: Vec<f64>,
}

/// Names of red, green, blue and opacity.
const COLORS: [&[&str]; 4] =
    [&["red", "r", "diffuse_red"], &["green", "g", "diffuse_green"], &["blue", "b", "diffuse_blue"], &["alpha", "a"]];
const NORMALS: [&[&str]; 3] = [&["nx"], &["ny"], &["nz"]];
/// Pairs of names for texture coordinates.
const UVS: [[&[&str]; 2]; 3] = [[&["s"], &["t"]], [&["u"], &["v"]], [&["texture_u"], &["texture_v"]]];

impl Columns {
    pub(super) fn new(element: &Element) -> Self {
        let scalars = element.properties.iter().enumerate().filter_map(|(property, p)| match p.kind {
            Kind::Scalar(scalar) if !["x", "y", "z"].contains(&p.name.as_str()) => {
                Some(Column { property, name: p.name.clone(), scalar, values: Vec::new() })
            }
            _ => None,
        });
        Self { columns: scalars.collect() }
    }

    /// Appends a row, as often as it is needed.
    pub(super) fn push(&mut self, scalars: &[f64], times: usize) {
        for column in &mut self.columns {
            column.values.extend(std::iter::repeat_n(scalars[column.property], times));
        }
    }

    /// Takes out the columns of these names, if all of them are there.
    fn take<const N: usize>(&mut self, names: [&[&str]; N]) -> Option<[Column; N]> {
        let find = |names: &[&str]| self.columns.iter().position(|c| names.contains(&c.name.as_str()));
        let found: Vec<usize> = names.iter().map_while(|names| find(names)).collect();
        let indices: [usize; N] = found.try_into().ok()?;
        let empty = || Column { property: 0, name: String::new(), scalar: Scalar::U8, values: Vec::new() };
        let taken = indices.map(|i| std::mem::replace(&mut self.columns[i], empty()));
        self.columns.retain(|c| !c.name.is_empty());
        Some(taken)
    }

    fn take_colors(&mut self) -> Vec<[f64; 4]> {
        let [red, green, blue, alpha] = COLORS;
        let Some(rgb) = self.take([red, green, blue]) else { return Vec::new() };
        let alpha = self.take([alpha]);
        let part = |column: &Column, i: usize| column.values[i] / greatest(column.scalar);
        let opacity = |i| alpha.as_ref().map_or(1.0, |[alpha]| part(alpha, i));
        (0..rgb[0].values.len()).map(|i| [part(&rgb[0], i), part(&rgb[1], i), part(&rgb[2], i), opacity(i)]).collect()
    }

    /// Puts colours and values where they belong; returns what belongs to corners.
    pub(super) fn take_for_corners(mut self, attributes: &mut Attributes) -> OfVertices {
        attributes.colors = self.take_colors();
        let normals = self.take(NORMALS).map(|[x, y, z]| {
            let all = x.values.iter().zip(&y.values).zip(&z.values);
            all.map(|((&x, &y), &z)| DVec3::new(x, y, z)).collect()
        });
        let uvs = UVS.into_iter().find_map(|names| self.take(names));
        let uvs = uvs.map(|[u, v]| u.values.iter().zip(&v.values).map(|(&u, &v)| DVec2::new(u, v)).collect());
        attributes.vertex_values = self.columns.into_iter().map(Column::into_values).collect();
        OfVertices { normals: normals.unwrap_or_default(), uvs: uvs.unwrap_or_default() }
    }

    /// Puts colours and values of faces where they belong.
    pub(super) fn take_for_faces(mut self, attributes: &mut Attributes) {
        attributes.face_colors = self.take_colors();
        // Normals of faces are those of the triangles.
        self.take(NORMALS);
        attributes.face_values = self.columns.into_iter().map(Column::into_values).collect();
    }
}

impl Column {
    fn into_values(self) -> Values {
        let kind = match self.scalar {
            Scalar::F32 => ValueKind::Single,
            Scalar::F64 => ValueKind::Double,
            _ => ValueKind::Label,
        };
        Values { name: self.name, kind, values: self.values }
    }
}

/// What full colour is in a type.
fn greatest(scalar: Scalar) -> f64 {
    match scalar {
        Scalar::F32 | Scalar::F64 => 1.0,
        Scalar::I8 | Scalar::U8 | Scalar::I32 | Scalar::U32 => 255.0,
        Scalar::I16 | Scalar::U16 => 65535.0,
    }
}

/// The list of texture coordinates of the corners of a face, as MeshLab writes it.
pub(super) fn uv_list(element: &Element) -> Option<usize> {
    let is_it = |kind| matches!(kind, Kind::List { .. });
    element.properties.iter().position(|p| element.name == "face" && p.name == "texcoord" && is_it(p.kind))
}

/// Appends the texture coordinates of a polygon of `n` corners; none where the list is of another length.
pub(super) fn push_uvs(builder: &mut Builder, list: &[f64], n: usize) {
    let (pairs, _) = list.as_chunks::<2>();
    let corners: Vec<DVec2> = if pairs.len() == n { pairs.iter().map(|&uv| uv.into()).collect() } else { vec![NO_UV[0]; n] };
    let attributes = &mut builder.attributes;
    attributes.uvs.resize(1, Vec::new());
    attributes.uvs[0].extend(fan(&corners));
}

/// Gives the corners of all triangles what their vertices have.
pub(super) fn to_corners(builder: &mut Builder) {
    let OfVertices { normals, uvs } = std::mem::take(&mut builder.of_vertices);
    let at = |v: u32| v as usize;
    if !normals.is_empty() {
        let normal = |v| normals.get(at(v)).copied().unwrap_or(NO_NORMAL[0]);
        builder.attributes.normals = builder.triangles().iter().map(|t| t.map(normal)).collect();
    }
    if !uvs.is_empty() && builder.attributes.uvs.is_empty() {
        let uv = |v| uvs.get(at(v)).copied().unwrap_or(NO_UV[0]);
        builder.attributes.uvs = vec![builder.triangles().iter().map(|t| t.map(uv)).collect()];
    }
}
