//! Stanford ply, as text and as binary of both byte orders.
//!
//! Our own reader: the text grammar of the package ply-rs-bw (4.0.1) knows no `nan`, `inf`, `.5` or `5.`, it loses an element
//! whose name comes twice, and it keeps every element of the file in memory.

mod columns;
mod header;
mod unread;
mod values;
mod write;

pub(crate) use write::write;

use crate::document::{Builder, Document, saturating_index, strip_triangles};
use crate::error::Fault;
use crate::extra::Extra;
use crate::looks::Looks;
use columns::Columns;
use glam::DVec3;
use header::{Element, Encoding, Header, Kind};
use values::Values;

/// Reads a ply file: positions from the element `vertex`, polygons from `face`, triangle strips from `tristrips`, lines from `edge`, and what
/// vertices and faces have beside. Other elements and lists are noted and skipped.
pub(crate) fn read(bytes: &[u8]) -> Result<Document, Fault> {
    let header = Header::parse(bytes)?;
    let body = &bytes[header.length..];
    match header.encoding {
        Encoding::Text => elements(&header, &mut Values::text(&crate::text::decode(body), header.lines + 1)),
        encoding => elements(&header, &mut Values::binary(body, encoding)),
    }
}

fn elements(header: &Header, values: &mut Values) -> Result<Document, Fault> {
    let mut builder = Builder::default();
    for element in &header.elements {
        unread::note(element, &mut builder.extras);
        match element.name.as_str() {
            "vertex" => vertices(element, values, &mut builder)?,
            "face" => faces(element, values, &mut builder)?,
            "tristrips" => strips(element, values, &mut builder)?,
            "edge" => edges(element, values, &mut builder)?,
            _ => rows(element, values, |_, _| Ok(()))?,
        }
    }
    builder.extras.note(Extra::Textures(header.textures.len()));
    if !header.textures.is_empty() {
        builder.attributes.looks = Looks::Images(header.textures.clone());
    }
    columns::to_corners(&mut builder);
    builder.finish()
}

/// One row of an element: its scalars in order (0 for a list) and the list of vertex indices.
struct Row {
    scalars: Vec<f64>,
    list: Vec<i64>,
    /// The list of texture coordinates of a face.
    uvs: Vec<f64>,
}

/// Reads an element row by row. An element without properties takes no room, whatever its count says.
fn rows(
    element: &Element,
    values: &mut Values,
    mut each: impl FnMut(&mut Values, &Row) -> Result<(), Fault>,
) -> Result<(), Fault> {
    if element.properties.is_empty() {
        return Ok(());
    }
    let (index_list, uv_list) = (index_list(element), columns::uv_list(element));
    let mut row = Row { scalars: vec![0.0; element.properties.len()], list: Vec::new(), uvs: Vec::new() };
    for i in 0..element.count {
        let fault = |e: Fault| in_row(e, element, i);
        for (p, property) in element.properties.iter().enumerate() {
            match property.kind {
                Kind::Scalar(scalar) => row.scalars[p] = values.scalar(scalar).map_err(fault)?,
                Kind::List { count, item } => {
                    let n = values.integer(count).map_err(fault)?;
                    let (is_index, is_uv) = (Some(p) == index_list, Some(p) == uv_list);
                    if is_index {
                        row.list.clear();
                    }
                    if is_uv {
                        row.uvs.clear();
                    }
                    for _ in 0..n {
                        if is_index {
                            row.list.push(values.integer(item).map_err(fault)?);
                        } else if is_uv {
                            row.uvs.push(values.scalar(item).map_err(fault)?);
                        } else {
                            values.scalar(item).map_err(fault)?;
                        }
                    }
                }
            }
        }
        each(values, &row).map_err(fault)?;
        values.end_row();
    }
    Ok(())
}

/// Binary faults have no line, so they name the row.
fn in_row(fault: Fault, element: &Element, row: u64) -> Fault {
    match fault {
        Fault::Malformed { line, what } => {
            Fault::Malformed { line, what: format!("{} {row} of {}: {what}", element.name, element.count) }
        }
        other => other,
    }
}

fn vertices(element: &Element, values: &mut Values, builder: &mut Builder) -> Result<(), Fault> {
    let scalar = |name: &str| element.properties.iter().position(|p| p.name == name && matches!(p.kind, Kind::Scalar(_)));
    let (Some(x), Some(y), Some(z)) = (scalar("x"), scalar("y"), scalar("z")) else {
        return Err(Fault::line(element.line, "the element vertex has no properties x, y and z"));
    };
    let mut columns = Columns::new(element);
    rows(element, values, |_, row| {
        builder.vertex(DVec3::new(row.scalars[x], row.scalars[y], row.scalars[z]));
        columns.push(&row.scalars, 1);
        Ok(())
    })?;
    builder.of_vertices = columns.take_for_corners(&mut builder.attributes);
    Ok(())
}

/// Lines between `vertex1` and `vertex2`; an element without them is skipped like any other that we don't know.
fn edges(element: &Element, values: &mut Values, builder: &mut Builder) -> Result<(), Fault> {
    let scalar = |name: &str| element.properties.iter().position(|p| p.name == name && matches!(p.kind, Kind::Scalar(_)));
    let ends = scalar("vertex1").zip(scalar("vertex2"));
    rows(element, values, |_, row| {
        if let Some((a, b)) = ends {
            // What is no index becomes -1, out of range.
            let index = |x: f64| saturating_index(if x.fract() == 0.0 { x as i64 } else { -1 });
            builder.polyline(&[index(row.scalars[a]), index(row.scalars[b])]);
        }
        Ok(())
    })
}

/// Which property is the list of vertex indices; both names are in use.
fn index_list(element: &Element) -> Option<usize> {
    let is_list = |kind| matches!(kind, Kind::List { .. });
    element.properties.iter().position(|p| matches!(p.name.as_str(), "vertex_indices" | "vertex_index") && is_list(p.kind))
}

/// Fails for an element that should hold indices and does not.
fn check_index_list(element: &Element) -> Result<(), Fault> {
    if element.count == 0 || index_list(element).is_some() {
        return Ok(());
    }
    Err(Fault::line(element.line, format!("the element {} has no list vertex_indices", element.name)))
}

fn faces(element: &Element, values: &mut Values, builder: &mut Builder) -> Result<(), Fault> {
    check_index_list(element)?;
    let mut corners = Vec::new();
    let mut columns = Columns::new(element);
    let has_uvs = columns::uv_list(element).is_some();
    rows(element, values, |values, row| {
        if row.list.len() < 3 {
            return Err(values.fault(format!("a face of {} corners", row.list.len())));
        }
        corners.clear();
        corners.extend(row.list.iter().map(|&c| saturating_index(c)));
        builder.polygon(&corners);
        columns.push(&row.scalars, corners.len() - 2);
        if has_uvs {
            columns::push_uvs(builder, &row.uvs, corners.len());
        }
        Ok(())
    })?;
    columns.take_for_faces(&mut builder.attributes);
    Ok(())
}

/// Strips in one list, with -1 (or its unsigned twin) where the next one begins.
fn strips(element: &Element, values: &mut Values, builder: &mut Builder) -> Result<(), Fault> {
    check_index_list(element)?;
    rows(element, values, |_, row| {
        let corners: Vec<u32> = row.list.iter().map(|&c| saturating_index(c)).collect();
        for strip in corners.split(|&c| c == u32::MAX) {
            strip_triangles(strip).for_each(|t| builder.polygon(&t));
        }
        Ok(())
    })
}
