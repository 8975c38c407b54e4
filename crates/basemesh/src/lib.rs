//! The base mesh: a coarse simplicial mesh over a surface, with a bijection to it (paper, section 3.2).
//!
//! [`build`] charts every patch of a segmentation onto a convex polygon, joins its sites by a constrained Delaunay triangulation there,
//! and joins all patches. [`decimate`] begins with the surface itself. Both then improve the connectivity by the same edits, which the
//! map records. [`bisect`], [`mend`] and [`Replay`] edit a base mesh that is there.
//!
//! ```
//! use basemesh::{BaseOptions, decimate};
//! use mesh_core::{FaceId, TriMesh};
//! use region_map::{Sizing, Surface};
//!
//! // A tetrahedron, its six edges creases; any mesh goes in like that.
//! let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
//! let mesh = TriMesh::from_slices(&positions, &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])?;
//! let surface = Surface::with_creases(mesh, 40.0)?;
//! let options = BaseOptions { base_vertices: 50, ..Default::default() };
//! let base = decimate(&surface, &Sizing::uniform(surface.mesh()), &options)?;
//! assert_eq!(base.mesh().n_vertices(), 50);
//!
//! // The map: from a point of a base face to the surface, and back.
//! let point = base.locate(FaceId(0), glam::DVec3::new(0.2, 0.3, 0.5));
//! let (face, weights) = base.map.find(point).ok_or("every point is found")?;
//! assert_eq!(face, base.map_faces[FaceId(0)]);
//! assert!(weights.distance(glam::DVec3::new(0.2, 0.3, 0.5)) < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod arguments;
mod build;
mod decimate;
mod edit;
mod editor;
mod error;
mod improve;
mod options;
#[cfg(test)]
mod tests;

pub use build::build;
pub use decimate::decimate;
pub use edit::{Mended, Replay, bisect, mend};
pub use error::BaseError;
pub use options::BaseOptions;
