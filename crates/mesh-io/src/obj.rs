//! Wavefront obj.
//!
//! Parsed by the package tobj, which by itself would not do (checked with 4.0.5): every object, group and material becomes a
//! model with its own compacted positions, so vertices are renumbered and solids fall apart at material borders; errors name no
//! line; one index out of range refuses the whole file. So a first pass checks every word, naming lines, and hands tobj a plain
//! text: the `v` lines, one polygon that names all vertices (it fixes their order and keeps those that no face uses), and the
//! faces whose indices are in range.

mod face;
mod scan;
mod write;

pub(crate) use write::write;

use crate::attributes::{NO_NORMAL, NO_UV};
use crate::document::{Builder, Document, fan, saturating_index};
use crate::error::Fault;
use crate::looks::Looks;
use crate::text::decode;
use face::push_face;
use glam::{DVec2, DVec3};
use scan::{Scan, State};
use tobj::LoadOptions;

/// Reads an obj file: vertices with their colours, faces with texture coordinates and normals, names, smoothing groups, and lines. Points and
/// curves are noted, but left unread. A normal or texture coordinate that is no number is not there: that must not cost the mesh.
pub(crate) fn read(bytes: &[u8]) -> Result<Document, Fault> {
    let mut scan = Scan::of(&decode(bytes))?;
    let (positions, kept_corners) = parse(&scan)?;
    let mut kept_corners = kept_corners.as_slice();
    let mut builder = Builder::default();
    for p in positions.chunks_exact(3) {
        builder.vertex(DVec3::from_slice(p));
    }
    let mut more = scan.more.as_slice();
    for (polygon, state) in scan.polygons().zip(&scan.states) {
        let (of_polygon, rest) = more.split_at(polygon.len());
        more = rest;
        if scan.in_range(polygon) && kept_corners.len() >= polygon.len() {
            let (corners, rest) = kept_corners.split_at(polygon.len());
            builder.polygon(corners);
            kept_corners = rest;
        } else {
            builder.polygon(&polygon.iter().map(|&c| saturating_index(c)).collect::<Vec<_>>());
        }
        push_attributes(&mut builder, &scan, of_polygon, *state);
    }
    scan.polylines.iter().for_each(|line| builder.polyline(line));
    builder.extras = scan.extras();
    let attributes = &mut builder.attributes;
    attributes.colors = std::mem::take(&mut scan.colors);
    attributes.materials.names = scan.materials.into_names();
    attributes.objects.names = scan.objects.into_names();
    attributes.groups.names = scan.groups.into_names();
    if !scan.libraries.is_empty() {
        attributes.looks = Looks::Libraries(scan.libraries);
    }
    builder.finish()
}

/// Appends what the triangles of a polygon have; `corners` are the texture coordinates and the normal of each of its corners.
fn push_attributes(builder: &mut Builder, scan: &Scan, corners: &[[i64; 2]], state: State) {
    let attributes = &mut builder.attributes;
    if !scan.uvs.is_empty() {
        if attributes.uvs.is_empty() {
            attributes.uvs.push(Vec::new());
        }
        let uv = |i: i64| usize::try_from(i).ok().and_then(|i| scan.uvs.get(i).copied()).unwrap_or(NO_UV[0]);
        attributes.uvs[0].extend(fan(&corners.iter().map(|c| uv(c[0])).collect::<Vec<DVec2>>()));
    }
    if !scan.normals.is_empty() {
        let normal = |i: i64| usize::try_from(i).ok().and_then(|i| scan.normals.get(i).copied()).unwrap_or(NO_NORMAL[0]);
        attributes.normals.extend(fan(&corners.iter().map(|c| normal(c[1])).collect::<Vec<DVec3>>()));
    }
    for _ in 2..corners.len() {
        attributes.materials.of_face.push(state.material);
        attributes.objects.of_face.push(state.object);
        attributes.groups.of_face.push(state.group);
        if scan.has_smoothing {
            attributes.smoothing.push(state.smoothing);
        }
    }
}

/// Coordinates of all vertices, and corners of all polygons that are in range, by tobj.
fn parse(scan: &Scan) -> Result<(Vec<f64>, Vec<u32>), Fault> {
    if scan.n_vertices == 0 {
        return Ok(Default::default());
    }
    let text = plain_text(scan);
    let no_materials = |_: &std::path::Path| Ok(Default::default());
    let loaded = tobj::load_obj_buf(&mut text.as_bytes(), &LoadOptions::default(), no_materials);
    let (models, _) = loaded.map_err(|e| Fault::data(format!("tobj: {e}")))?;
    let mesh = models.into_iter().next().map(|m| m.mesh).unwrap_or_default();
    let mut indices = mesh.indices;
    let corners = indices.split_off(scan.n_vertices.min(indices.len()));
    Ok((mesh.positions, corners))
}

fn plain_text(scan: &Scan) -> String {
    let mut text = scan.vertex_lines.clone();
    push_face(&mut text, 0..scan.n_vertices as i64);
    for polygon in scan.polygons().filter(|p| scan.in_range(p)) {
        push_face(&mut text, polygon.iter().copied());
    }
    text
}
