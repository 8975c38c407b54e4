//! Reading (also compressed by gzip) and writing obj, ply, stl, off, gltf and glb.
//!
//! [`read()`] gives what the file says, as a [`mesh_core::Soup`] in a [`Document`]; cleaning is not done here. What else the file holds
//! (texture coordinates, materials, ...) is named in [`Document::extras`]. [`write()`] is
//! atomic and keeps the order of vertices and faces.
//!
//! ```
//! use mesh_io::{Format, read_bytes, write_bytes};
//!
//! let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
//! let document = read_bytes(square.as_bytes(), Format::Obj)?;
//! assert_eq!(document.soup.triangles, [[0, 1, 2], [0, 2, 3]]);
//! assert_eq!(document.polygon_of, [0, 0]);
//!
//! let mesh = mesh_core::TriMesh::new(document.soup.positions, document.soup.triangles)?;
//! let off = write_bytes(&mesh, Format::Off)?;
//! assert!(off.starts_with(b"OFF\n4 2 0\n"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod base64;
mod document;
mod error;
mod extra;
mod format;
mod gltf;
mod obj;
mod off;
mod packed;
mod ply;
mod read;
mod single_precision;
mod stl;
mod text;
mod write;

pub use document::Document;
pub use error::{ReadError, WriteError};
pub use extra::Extra;
pub use format::Format;
pub use read::{read, read_bytes};
pub use write::{writable_format, write, write_bytes, write_colored_ply};
