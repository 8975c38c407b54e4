//! The first pass over an obj file: every word is checked, with its line.

use crate::Labels;
use crate::attributes::{Names, WHITE};
use crate::document::saturating_index;
use crate::error::Fault;
use crate::extra::{Extra, Extras};
use crate::text::{integer, number};
use glam::{DVec2, DVec3};

/// What the first pass finds.
#[derive(Default)]
pub(super) struct Scan {
    /// The `v` lines, with the words that make the position alone.
    pub(super) vertex_lines: String,
    pub(super) n_vertices: usize,
    /// Colours of vertices; empty as long as there is none.
    pub(super) colors: Vec<[f64; 4]>,
    /// The `vt` lines; what is no number is none here.
    pub(super) uvs: Vec<DVec2>,
    /// The `vn` lines; what is no number is none here.
    pub(super) normals: Vec<DVec3>,
    /// Corners of all polygons, from 0; out of range where the file has them so.
    pub(super) corners: Vec<i64>,
    /// The texture coordinates and the normal of every corner, from 0; out of range where there is none.
    pub(super) more: Vec<[i64; 2]>,
    /// Where the corners of each polygon end.
    pub(super) ends: Vec<usize>,
    /// What holds for each polygon: material, object, group and smoothing group.
    pub(super) states: Vec<State>,
    /// Vertices of the `l` lines, from 0; `u32::MAX` for what is no index.
    pub(super) polylines: Vec<Vec<u32>>,
    /// What is there that is not read; counts of names come at the end.
    unread: Extras,
    state: State,
    pub(super) materials: Names,
    pub(super) objects: Names,
    pub(super) groups: Names,
    /// Whether the file speaks of smoothing groups.
    pub(super) has_smoothing: bool,
    /// Files that describe the materials.
    pub(super) libraries: Vec<String>,
}

/// What holds from a line on.
#[derive(Clone, Copy)]
pub(super) struct State {
    pub(super) material: u32,
    pub(super) object: u32,
    pub(super) group: u32,
    pub(super) smoothing: u32,
}

impl Default for State {
    fn default() -> Self {
        Self { material: Labels::NONE, object: Labels::NONE, group: Labels::NONE, smoothing: 0 }
    }
}

impl Scan {
    pub(super) fn of(text: &str) -> Result<Self, Fault> {
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
                Some("vt") => scan.uvs.push(numbers(words).into()),
                Some("vn") => scan.normals.push(numbers(words).into()),
                Some("f") => scan.face(words, i + 1)?,
                Some("l") => scan.line(words, i + 1),
                Some(keyword) => scan.name(keyword, words),
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
        if let [_, _, _, r, g, b, ..] = words {
            self.colors.resize(self.n_vertices, WHITE);
            self.colors.push([number(r, line)?, number(g, line)?, number(b, line)?, 1.0]);
        }
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
            let [vertex, uv, normal] = indices(word, line)?;
            self.corners.push(counted_from_zero(vertex, self.n_vertices));
            self.more.push([counted_from_zero(uv, self.uvs.len()), counted_from_zero(normal, self.normals.len())]);
        }
        let n = self.corners.len() - start;
        if n < 3 {
            return Err(Fault::line(line, format!("a face of {n} corners")));
        }
        self.ends.push(self.corners.len());
        self.states.push(self.state);
        Ok(())
    }

    /// A chain of line segments. A word that is no index must not cost the mesh.
    fn line<'a>(&mut self, words: impl Iterator<Item = &'a str>, line: usize) {
        let n = self.n_vertices;
        let index = |word| indices(word, line).map_or(u32::MAX, |[index, ..]| saturating_index(counted_from_zero(index, n)));
        self.polylines.push(words.map(index).collect());
    }

    /// Takes what holds from this line on, and notes what is not read.
    fn name<'a>(&mut self, keyword: &str, words: impl Iterator<Item = &'a str>) {
        let name = words.collect::<Vec<_>>().join(" ");
        match keyword {
            "usemtl" => self.state.material = label(&mut self.materials, name),
            "o" => self.state.object = label(&mut self.objects, name),
            "g" => self.state.group = label(&mut self.groups, name),
            "s" => {
                self.has_smoothing = true;
                // `off` is 0.
                self.state.smoothing = name.parse().unwrap_or(0);
            }
            "mtllib" => self.libraries.push(name),
            "p" => self.unread.note(Extra::PointsOrLines),
            "curv" | "curv2" | "surf" => self.unread.note(Extra::FreeForm),
            _ => {}
        }
    }

    pub(super) fn extras(&self) -> Extras {
        let mut extras = self.unread.clone();
        extras.note_if(!self.normals.is_empty(), Extra::Normals);
        extras.note_if(!self.uvs.is_empty(), Extra::TextureCoordinates);
        extras.note_if(!self.colors.is_empty(), Extra::Colors);
        extras.note(Extra::Materials(self.materials.len()));
        // Exporters often make a group of every object: they are not counted twice.
        extras.note(Extra::Parts(self.objects.len().max(self.groups.len())));
        extras
    }

    pub(super) fn polygons(&self) -> impl Iterator<Item = &[i64]> {
        let mut start = 0;
        self.ends.iter().map(move |&end| &self.corners[std::mem::replace(&mut start, end)..end])
    }

    pub(super) fn in_range(&self, polygon: &[i64]) -> bool {
        polygon.iter().all(|&c| (0..self.n_vertices as i64).contains(&c))
    }
}

/// The label of a name; a line without one ends what held before.
fn label(names: &mut Names, name: String) -> u32 {
    if name.is_empty() { Labels::NONE } else { names.index_of(name) }
}

/// The part of a line before a comment. A backslash at the end of a comment continues nothing.
fn without_comment(line: &str) -> &str {
    line.split('#').next().unwrap_or("").trim_end()
}

/// The indices of `v`, `v/vt`, `v//vn` or `v/vt/vn`, 0 where there is none.
fn indices(word: &str, line: usize) -> Result<[i64; 3], Fault> {
    let mut parts = word.split('/');
    let mut indices = [integer(parts.next().unwrap_or(""), line)?, 0, 0];
    for (i, part) in parts.enumerate().filter(|(_, part)| !part.is_empty()) {
        let index = integer(part, line)?;
        if let Some(slot) = indices.get_mut(i + 1) {
            *slot = index;
        }
    }
    Ok(indices)
}

/// An index of the file counted from 0. Negative ones count back from the last of `n` so far. 0 is no index: it becomes -1, out of range.
fn counted_from_zero(index: i64, n: usize) -> i64 {
    if index < 0 { index.saturating_add(n as i64) } else { index - 1 }
}

/// The first numbers of a line. Exporters write texts such as `-nan(ind)` for normals, which must not cost the mesh.
fn numbers<'a, const N: usize>(mut words: impl Iterator<Item = &'a str>) -> [f64; N] {
    std::array::from_fn(|_| words.next().and_then(|word| word.parse().ok()).unwrap_or(f64::NAN))
}
