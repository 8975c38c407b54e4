//! Wavefront obj.
//!
//! Parsed by the package tobj, which by itself would not do (checked with 4.0.5): every object, group and material becomes a
//! model with its own compacted positions, so vertices are renumbered and solids fall apart at material borders; errors name no
//! line; one index out of range refuses the whole file. So a first pass checks every word, naming lines, and hands tobj a plain
//! text: the `v` lines, one polygon that names all vertices (it fixes their order and keeps those that no face uses), and the
//! faces whose indices are in range.

use crate::document::{Builder, Document, saturating_index};
use crate::error::Fault;
use crate::extra::{Extra, Extras};
use crate::text::{decode, integer, number};
use glam::DVec3;
use mesh_core::TriMesh;
use std::collections::BTreeSet;
use std::fmt::Write;
use tobj::LoadOptions;

/// Reads an obj file: vertices, faces and lines. All else (normals, texture coordinates, points, curves, names) is noted, but left
/// unread: exporters write texts such as `-nan(ind)` for normals, which must not cost the mesh.
pub(crate) fn read(bytes: &[u8]) -> Result<Document, Fault> {
    let scan = Scan::of(&decode(bytes))?;
    let (positions, kept_corners) = parse(&scan)?;
    let mut kept_corners = kept_corners.as_slice();
    let mut builder = Builder::default();
    for p in positions.chunks_exact(3) {
        builder.vertex(DVec3::from_slice(p));
    }
    for polygon in scan.polygons() {
        if scan.in_range(polygon) && kept_corners.len() >= polygon.len() {
            let (corners, rest) = kept_corners.split_at(polygon.len());
            builder.polygon(corners);
            kept_corners = rest;
        } else {
            builder.polygon(&polygon.iter().map(|&c| saturating_index(c)).collect::<Vec<_>>());
        }
    }
    scan.polylines.iter().for_each(|line| builder.polyline(line));
    builder.extras = scan.extras();
    builder.finish()
}

/// What the first pass finds.
#[derive(Default)]
struct Scan {
    /// The `v` lines, with the words that make the position alone.
    vertex_lines: String,
    n_vertices: usize,
    /// Corners of all polygons, from 0; out of range where the file has them so.
    corners: Vec<i64>,
    /// Where the corners of each polygon end.
    ends: Vec<usize>,
    /// Vertices of the `l` lines, from 0; `u32::MAX` for what is no index.
    polylines: Vec<Vec<u32>>,
    /// What is there that is not read; counts of names come at the end.
    unread: Extras,
    materials: BTreeSet<String>,
    objects: BTreeSet<String>,
    groups: BTreeSet<String>,
}

impl Scan {
    fn of(text: &str) -> Result<Self, Fault> {
        let mut scan = Self::default();
        let mut lines = text.lines().map(without_comment).enumerate();
        while let Some((i, line)) = lines.next() {
            let mut whole = line.to_owned();
            while whole.ends_with('\\') {
                whole.pop();
                whole.push(' ');
                whole.push_str(lines.next().map_or("", |(_, next)| next));
            }
            let mut words = whole.split_whitespace();
            match words.next() {
                Some("v") => scan.vertex(&words.collect::<Vec<_>>(), i + 1)?,
                Some("f") => scan.face(words, i + 1)?,
                Some("l") => scan.line(words, i + 1),
                Some(keyword) => scan.unread(keyword, words),
                None => {}
            }
        }
        Ok(scan)
    }

    /// `x y z`, then nothing, a weight that divides them, or a colour.
    fn vertex(&mut self, words: &[&str], line: usize) -> Result<(), Fault> {
        if words.len() < 3 {
            return Err(Fault::line(line, format!("a vertex of {} coordinates", words.len())));
        }
        for word in words {
            number(word, line)?;
        }
        let used = if words.len() == 4 { 4 } else { 3 };
        self.unread.note_if(words.len() >= 6, Extra::Colors);
        if used == 4 && number(words[3], line)? == 0.0 {
            return Err(Fault::line(line, "a vertex of weight 0 is at infinity"));
        }
        self.vertex_lines.push('v');
        for word in &words[..used] {
            self.vertex_lines.push(' ');
            self.vertex_lines.push_str(word);
        }
        self.vertex_lines.push('\n');
        self.n_vertices += 1;
        Ok(())
    }

    fn face<'a>(&mut self, words: impl Iterator<Item = &'a str>, line: usize) -> Result<(), Fault> {
        let start = self.corners.len();
        for word in words {
            let index = vertex_index(word, line)?;
            self.corners.push(self.counted_from_zero(index));
        }
        let n = self.corners.len() - start;
        if n < 3 {
            return Err(Fault::line(line, format!("a face of {n} corners")));
        }
        self.ends.push(self.corners.len());
        Ok(())
    }

    /// A chain of line segments. A word that is no index must not cost the mesh.
    fn line<'a>(&mut self, words: impl Iterator<Item = &'a str>, line: usize) {
        let index = |word| vertex_index(word, line).map_or(u32::MAX, |index| saturating_index(self.counted_from_zero(index)));
        let polyline = words.map(index).collect();
        self.polylines.push(polyline);
    }

    /// Notes what a line says that is not read.
    fn unread<'a>(&mut self, keyword: &str, words: impl Iterator<Item = &'a str>) {
        let name = || words.collect::<Vec<_>>().join(" ");
        match keyword {
            "vn" => self.unread.note(Extra::Normals),
            "vt" => self.unread.note(Extra::TextureCoordinates),
            "p" => self.unread.note(Extra::PointsOrLines),
            "curv" | "curv2" | "surf" => self.unread.note(Extra::FreeForm),
            "usemtl" => drop(self.materials.insert(name())),
            "o" => drop(self.objects.insert(name())),
            "g" => drop(self.groups.insert(name())),
            _ => {}
        }
    }

    fn extras(self) -> Extras {
        let mut extras = self.unread;
        extras.note(Extra::Materials(self.materials.len()));
        // Exporters often make a group of every object: they are not counted twice.
        extras.note(Extra::Parts(self.objects.len().max(self.groups.len())));
        extras
    }

    /// An index of the file counted from 0. Negative ones count back from the last vertex so far. 0 is no index: it becomes -1, out
    /// of range.
    fn counted_from_zero(&self, index: i64) -> i64 {
        if index < 0 { index.saturating_add(self.n_vertices as i64) } else { index - 1 }
    }

    fn polygons(&self) -> impl Iterator<Item = &[i64]> {
        let mut start = 0;
        self.ends.iter().map(move |&end| &self.corners[std::mem::replace(&mut start, end)..end])
    }

    fn in_range(&self, polygon: &[i64]) -> bool {
        polygon.iter().all(|&c| (0..self.n_vertices as i64).contains(&c))
    }
}

/// The part of a line before a comment. A backslash at the end of a comment continues nothing.
fn without_comment(line: &str) -> &str {
    line.split('#').next().unwrap_or("").trim_end()
}

/// The first number of `v`, `v/vt`, `v//vn` or `v/vt/vn`; the others must be integers too.
fn vertex_index(word: &str, line: usize) -> Result<i64, Fault> {
    let mut parts = word.split('/');
    let index = integer(parts.next().unwrap_or(""), line)?;
    for part in parts.filter(|p| !p.is_empty()) {
        integer(part, line)?;
    }
    Ok(index)
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

fn push_face(text: &mut String, corners: impl Iterator<Item = i64>) {
    text.push('f');
    for corner in corners {
        // Writing to a String cannot fail.
        let _ = write!(text, " {}", corner + 1);
    }
    text.push('\n');
}

/// The mesh as obj. Coordinates have the fewest digits that give them back exactly.
pub(crate) fn write(mesh: &TriMesh) -> Vec<u8> {
    let mut text = String::new();
    for p in mesh.positions() {
        let _ = writeln!(text, "v {:?} {:?} {:?}", p.x, p.y, p.z);
    }
    for face in mesh.faces() {
        push_face(&mut text, face.iter().map(|v| i64::from(v.0)));
    }
    text.into_bytes()
}
