//! Reading (also compressed by gzip) and writing obj, ply, stl, off, gltf and glb.
//!
//! [`read()`] gives what the file says, as a [`mesh_core::Soup`] in a [`Document`]; cleaning is not done here. What else the file holds
//! (texture coordinates, materials, animations, ...) is named in [`Document::extras`], and what of it is read is in [`Attributes`].
//! [`write()`] and [`write_with`] are atomic and keep the order of vertices and faces.
//!
//! Beside meshes there are arrays for numpy ([`write_arrays`], [`read_arrays`]) and the control mesh of a subdivision surface ([`usda_bytes`]).
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

mod attributes;
mod base64;
mod corners;
mod document;
mod error;
mod extra;
mod format;
mod gltf;
mod looks;
mod npz;
mod obj;
mod off;
mod packed;
mod ply;
mod read;
mod settings;
mod single_precision;
mod stl;
mod text;
mod usda;
mod write;

pub use attributes::{Attributes, Labels, ValueKind, Values};
pub use document::Document;
pub use error::{ReadError, WriteError};
pub use extra::Extra;
pub use format::Format;
pub use looks::Looks;
pub use npz::{Array, Numbers};
pub use read::{read, read_arrays, read_arrays_bytes, read_bytes, read_from, readable_format};
pub use settings::{Level, Settings};
pub use usda::{ControlMesh, usda_bytes};
pub use write::{
    array_bytes, writable_format, write, write_arrays, write_bytes, write_bytes_with, write_colored_ply, write_files,
    write_levels, write_with,
};
