//! Object file format (Geomview). Text alone; the binary kind is refused.

use crate::document::{Builder, Document, saturating_index};
use crate::error::Fault;
use crate::extra::{Extra, Extras};
use crate::text::{Words, decode, integer, number, quoted};
use glam::DVec3;
use mesh_core::TriMesh;
use std::fmt::Write;

/// Reads an off file of any kind (`OFF`, `COFF`, `NOFF`, `STOFF`, ...) in three dimensions, also without its first word.
///
/// Vertices and faces start on lines of their own; what follows the position or the corners on the line (normals, colours,
/// texture coordinates) is noted, but left unread.
pub(crate) fn read(bytes: &[u8]) -> Result<Document, Fault> {
    let text = decode(bytes);
    let mut words = Words::new(&text, 1).without_comments();
    let Header { prefix, n_vertices, n_faces } = header(&mut words)?;
    let mut more_at_vertices = false;
    let mut builder = Builder::default();
    for i in 0..n_vertices {
        let mut p = [0.0; 3];
        for x in &mut p {
            *x = number(words.expect(|| format!("vertex {i} of {n_vertices}"))?, words.line())?;
        }
        builder.vertex(p.into());
        more_at_vertices |= words.end_line();
    }
    if more_at_vertices {
        note_vertex_extras(&prefix, &mut builder.extras);
    }
    let mut corners = Vec::new();
    for i in 0..n_faces {
        face(&mut words, &mut corners, || format!("face {i} of {n_faces}"))?;
        builder.polygon(&corners);
        builder.extras.note_if(words.end_line(), Extra::Colors);
    }
    builder.finish()
}

/// The header: what stands before `OFF`, in capitals, and the numbers of vertices and faces.
struct Header {
    prefix: String,
    n_vertices: i64,
    n_faces: i64,
}

/// Notes what the prefix says of the numbers after the positions; without a word on them they are colours more often than not.
fn note_vertex_extras(prefix: &str, extras: &mut Extras) {
    extras.note_if(prefix.contains("ST"), Extra::TextureCoordinates);
    extras.note_if(prefix.contains('C') || prefix.is_empty(), Extra::Colors);
    extras.note_if(prefix.contains('N'), Extra::Normals);
}

/// Reads the header. Its numbers may be on the line of its word or after it. That of edges is not used.
fn header(words: &mut Words) -> Result<Header, Fault> {
    let what = || "the header".to_owned();
    let mut word = words.expect(what)?;
    let mut prefix = String::new();
    if let Some(end) = word.to_ascii_uppercase().find("OFF") {
        check_kind(&word[..end], words.line())?;
        prefix = word[..end].to_ascii_uppercase();
        // Files of a well-known data set (ModelNet) have the first count glued to the word: OFF490 518 0.
        word = if word.len() > end + 3 { &word[end + 3..] } else { words.expect(what)? };
    }
    if word.eq_ignore_ascii_case("BINARY") {
        return Err(Fault::unsupported("binary off is not supported", "convert it to text off, ply or obj"));
    }
    let n_vertices = count(word, words.line())?;
    let n_faces = count(words.expect(what)?, words.line())?;
    words.end_line();
    Ok(Header { prefix, n_vertices, n_faces })
}

/// What may stand before `OFF` as long as the position is the first three numbers of a vertex.
fn check_kind(prefix: &str, line: usize) -> Result<(), Fault> {
    match prefix {
        "" | "ST" | "C" | "N" | "STC" | "STN" | "CN" | "STCN" => Ok(()),
        "4" | "n" | "4n" => Err(Fault::unsupported("off with other than 3 dimensions", "export it with 3 dimensions")),
        _ => Err(Fault::line(line, format!("{} is not an off header", quoted(&format!("{prefix}OFF"))))),
    }
}

fn count(word: &str, line: usize) -> Result<i64, Fault> {
    let n = integer(word, line)?;
    if n < 0 { Err(Fault::line(line, format!("a count of {n}"))) } else { Ok(n) }
}

fn face(words: &mut Words, corners: &mut Vec<u32>, reading: impl Fn() -> String) -> Result<(), Fault> {
    let n = integer(words.expect(&reading)?, words.line())?;
    if n < 3 {
        return Err(Fault::line(words.line(), format!("a face of {n} corners")));
    }
    corners.clear();
    for _ in 0..n {
        corners.push(saturating_index(integer(words.expect(&reading)?, words.line())?));
    }
    Ok(())
}

/// The mesh as off. Coordinates have the fewest digits that give them back exactly.
pub(crate) fn write(mesh: &TriMesh) -> Vec<u8> {
    // Writing to a String cannot fail.
    let mut text = format!("OFF\n{} {} 0\n", mesh.n_vertices(), mesh.n_faces());
    for DVec3 { x, y, z } in mesh.positions() {
        let _ = writeln!(text, "{x:?} {y:?} {z:?}");
    }
    for [a, b, c] in mesh.faces().iter().map(|f| f.map(|v| v.0)) {
        let _ = writeln!(text, "3 {a} {b} {c}");
    }
    text.into_bytes()
}
