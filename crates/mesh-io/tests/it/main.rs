//! One binary for all tests of the public interface.

mod attributes;
mod extras;
/// What fuzzing asks of any bytes, so that it stays true of the code of today.
#[path = "../../../../fuzz/src/lib.rs"]
pub mod fuzz;
mod gltf;
mod malformed;
mod npz;
mod obj;
mod off;
mod packed;
mod ply;
mod round_trip;
mod stl;
mod usda;

use glam::DVec3;
use mesh_core::TriMesh;
use mesh_io::{Document, Format, ReadError, read_bytes};

/// The contents read, or the test fails with the error.
fn document(contents: impl AsRef<[u8]>, format: Format) -> Document {
    read_bytes(contents.as_ref(), format).unwrap_or_else(|e| panic!("{e}"))
}

/// The document as if the file held nothing else.
fn without_extras(document: Document) -> Document {
    Document { extras: Vec::new(), attributes: mesh_io::Attributes::default(), ..document }
}

/// Checks that the contents are refused with an error that names `line` (`None` for binary) and says `what`.
fn check_refused(contents: impl AsRef<[u8]>, format: Format, line: Option<usize>, what: &str) {
    match read_bytes(contents.as_ref(), format) {
        Err(ReadError::Malformed { line: found, what: said, .. }) => {
            assert_eq!(found, line, "{said}");
            assert!(said.contains(what), "{said:?} does not say {what:?}");
        }
        Err(ReadError::Unsupported { what: said, .. }) => {
            assert_eq!(None, line, "{said}");
            assert!(said.contains(what), "{said:?} does not say {what:?}");
        }
        other => panic!("not refused for {what:?}: {other:?}"),
    }
}

/// A tetrahedron whose coordinates need all digits of f64.
fn tetrahedron() -> TriMesh {
    let positions =
        vec![DVec3::ZERO, DVec3::new(0.1, 1.0 / 3.0, -1e-300), DVec3::new(1e17, -0.0, 2.0), DVec3::new(-0.7, 5e-324, 1e300)];
    TriMesh::new(positions, vec![[0, 1, 2], [0, 2, 3], [0, 3, 1], [3, 2, 1]]).unwrap()
}

/// The same faces with coordinates that fit in f32.
fn small_tetrahedron() -> TriMesh {
    let p = vec![
        DVec3::ZERO,
        DVec3::new(0.5, -0.0, 1e-3f32.into()),
        DVec3::new(0.0, 1.25, 0.1f32.into()),
        DVec3::new(-3.0, 0.0, 1e30f32.into()),
    ];
    tetrahedron().with_positions(p).unwrap()
}
