//! The base mesh: every patch charted onto a convex polygon, its sites joined by a constrained Delaunay triangulation there, all
//! patches joined to one simplicial mesh with a bijective map to the input (paper, section 3.2), and its connectivity improved.
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
