//! Normals, texture coordinates, values and labels of a mesh, carried from the mesh that it was made of.
//!
//! All in plain arrays: what a triangle has at its three corners is `[[f64; N]; 3]`. [`Source`] ties such arrays to a cleaned mesh,
//! [`correspond`] says where each corner of another mesh of the same surface is on it, and [`corner_values`] and its like give the values there.
//!
//! ```
//! use attributes::{Source, corner_values, correspond};
//! use mesh_core::{CleanOptions, clean};
//!
//! let soup = fixtures::cube(4).to_soup();
//! let cleaned = clean(&soup, &CleanOptions::default())?;
//! let source = Source::new(&soup, &cleaned);
//! // A value that is linear in space: the height.
//! let heights: Vec<[[f64; 1]; 3]> = soup.triangles.iter().map(|t| t.map(|v| [soup.positions[v as usize].z])).collect();
//! let no_cuts = source.seams(&heights, 1e-9);
//! let other = fixtures::cube(3);
//! let carried = corner_values(&other, &correspond(&source, &no_cuts, &other), &heights);
//! for (face, values) in other.faces().iter().zip(&carried) {
//!     assert!(face.iter().zip(values).all(|(&v, [height])| (other.position(v).z - height).abs() < 1e-9));
//! }
//! # Ok::<(), mesh_core::CleanError>(())
//! ```

mod correspond;
mod normals;
mod source;
mod values;

pub use correspond::{Correspondence, PARTS, correspond};
pub use normals::corner_normals;
pub use source::Source;
pub use values::{corner_values, face_values, vertex_labels, vertex_values};
