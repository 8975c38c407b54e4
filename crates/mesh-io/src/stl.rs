//! Stereolithography files.
//!
//! The binary kind goes through the package stl_io. Its text reader will not do (0.11.0): errors name no line, `nan` and a
//! header `solid` without name are refused, several solids are not read, nor is f64. And it takes every file that begins with
//! `solid` for text.

use crate::document::{Builder, Document};
use crate::error::{Fault, WriteError};
use crate::extra::Extra;
use crate::single_precision::single_precision;
use crate::text::{Words, decode, number, quoted, without_mark};
use glam::{DVec3, Vec3};
use mesh_core::TriMesh;
use std::io::Cursor;
use stl_io::{Normal, Triangle, Vertex};

const HEADER: usize = 84;
const RECORD: usize = 50;

/// Reads an stl file, text or binary. Every triangle has three vertices of its own.
pub(crate) fn read(bytes: &[u8]) -> Result<Document, Fault> {
    if is_text(bytes) { read_text(bytes) } else { read_binary(bytes) }
}

/// A file is binary when its size is what its count claims, whatever its header says. Else it is text when it begins as such and
/// has no zero byte; every binary file has them, if only in its attributes.
fn is_text(bytes: &[u8]) -> bool {
    let binary_size = claimed_triangles(bytes).map(|n| HEADER as u64 + RECORD as u64 * n);
    let start = without_mark(bytes).trim_ascii_start();
    binary_size != Some(bytes.len() as u64)
        && start.len() >= 5
        && start[..5].eq_ignore_ascii_case(b"solid")
        && !bytes.contains(&0)
}

fn claimed_triangles(bytes: &[u8]) -> Option<u64> {
    let count: [u8; 4] = bytes.get(HEADER - 4..HEADER)?.try_into().ok()?;
    Some(u64::from(u32::from_le_bytes(count)))
}

fn read_binary(bytes: &[u8]) -> Result<Document, Fault> {
    let present = (bytes.len().saturating_sub(HEADER) / RECORD) as u64;
    let claimed = claimed_triangles(bytes)
        .ok_or_else(|| Fault::data(format!("neither text stl nor binary stl, whose header has {HEADER} bytes")))?;
    if claimed > present {
        return Err(Fault::data(format!("the header claims {claimed} triangles but the file has room for {present}")));
    }
    let records = bytes[HEADER..].chunks_exact(RECORD).take(claimed as usize);
    let has_attributes = records.map(|record| &record[RECORD - 2..]).any(|attribute| attribute != [0, 0]);
    // Without the word that would make stl_io take it for text.
    let mut copy = bytes.to_vec();
    copy[..HEADER - 4].fill(0);
    let mut builder = Builder::default();
    let mut cursor = Cursor::new(copy);
    let fault = |e: std::io::Error| Fault::data(e.to_string());
    for triangle in stl_io::create_stl_reader(&mut cursor).map_err(fault)? {
        let corners = triangle.map_err(fault)?.vertices;
        push_facet(&mut builder, &corners.map(|v| Vec3::from(v.0).as_dvec3()));
    }
    builder.extras.note_if(has_attributes, Extra::FaceAttributes);
    builder.finish()
}

fn read_text(bytes: &[u8]) -> Result<Document, Fault> {
    let text = decode(bytes);
    let mut words = Words::new(&text, 1);
    let mut builder = Builder::default();
    // Solids with facets, and whether the present one has had none yet.
    let (mut solids, mut is_new) = (0, true);
    while let Some(word) = words.next() {
        match keyword(word, &mut words)?.as_str() {
            "solid" => {
                is_new = true;
                words.end_line();
            }
            "endsolid" => drop(words.end_line()),
            "facet" => {
                solids += usize::from(std::mem::replace(&mut is_new, false));
                let corners = facet(&mut words)?;
                push_facet(&mut builder, &corners);
            }
            other => return Err(Fault::line(words.line(), format!("{} where a facet should begin", quoted(other)))),
        }
    }
    builder.extras.note(Extra::Parts(solids));
    builder.finish()
}

/// The corners of a facet, after its first word. Its normal is left unread: it is often wrong or not a number.
fn facet(words: &mut Words) -> Result<Vec<DVec3>, Fault> {
    expect(words, "normal")?;
    for _ in 0..3 {
        words.expect(|| "a normal".to_owned())?;
    }
    expect(words, "outer")?;
    expect(words, "loop")?;
    let mut corners = Vec::new();
    loop {
        let word = words.expect(|| "a facet".to_owned())?;
        match keyword(word, words)?.as_str() {
            "vertex" => corners.push(vertex(words)?),
            "endloop" if corners.len() < 3 => {
                return Err(Fault::line(words.line(), format!("a facet of {} corners", corners.len())));
            }
            "endloop" => break,
            other => return Err(Fault::line(words.line(), format!("{} where a vertex should begin", quoted(other)))),
        }
    }
    expect(words, "endfacet")?;
    Ok(corners)
}

fn vertex(words: &mut Words) -> Result<DVec3, Fault> {
    let mut p = [0.0; 3];
    for x in &mut p {
        *x = number(words.expect(|| "a vertex".to_owned())?, words.line())?;
    }
    Ok(p.into())
}

fn expect(words: &mut Words, wanted: &str) -> Result<(), Fault> {
    let word = words.expect(|| "a facet".to_owned())?;
    match keyword(word, words)? {
        found if found == wanted => Ok(()),
        _ => Err(Fault::line(words.line(), format!("{} where \"{wanted}\" should be", quoted(word)))),
    }
}

/// A keyword in small letters; some programs write `end solid` in two words.
fn keyword(word: &str, words: &mut Words) -> Result<String, Fault> {
    let mut keyword = word.to_ascii_lowercase();
    if keyword == "end" {
        keyword += &words.expect(|| "a keyword".to_owned())?.to_ascii_lowercase();
    }
    Ok(keyword)
}

fn push_facet(builder: &mut Builder, corners: &[DVec3]) {
    let first = builder.n_vertices() as u32;
    for &p in corners {
        builder.vertex(p);
    }
    builder.polygon(&(first..first.saturating_add(corners.len() as u32)).collect::<Vec<_>>());
}

/// The mesh as binary stl, in f32.
pub(crate) fn write(mesh: &TriMesh) -> Result<Vec<u8>, WriteError> {
    if u32::try_from(mesh.n_faces()).is_err() {
        return Err(WriteError::TooLarge { format: "stl" });
    }
    let positions = single_precision(mesh)?;
    let triangles: Vec<Triangle> = mesh
        .faces()
        .enumerate()
        .map(|(f, corners)| Triangle {
            normal: Normal::new(mesh.normal(f).as_vec3().to_array()),
            vertices: corners.map(|v| Vertex::new(positions[v.0 as usize])),
        })
        .collect();
    let mut bytes = Vec::with_capacity(HEADER + RECORD * triangles.len());
    // Writing to a Vec cannot fail.
    let _ = stl_io::write_stl(&mut bytes, triangles.iter());
    Ok(bytes)
}
