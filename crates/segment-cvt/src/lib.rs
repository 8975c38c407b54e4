//! Where the base vertices shall be: on arcs by arc length, inside patches by centroidal Voronoi relaxation (paper, section 3.2).
//!
//! [`sample`] takes the cells of a segmentation, a sizing field and a number of base vertices, and returns [`region_map::Sites`].
//!
//! ```
//! use mesh_core::{IdVec, TriMesh};
//! use region_map::{Cells, PatchId, Segmentation, Sizing, Surface};
//! use segment_cvt::{CvtOptions, sample};
//!
//! // A rectangle of two triangles: one patch in one border loop.
//! let corners = [[0.0, 0.0, 0.0], [5.0, 0.0, 0.0], [5.0, 3.0, 0.0], [0.0, 3.0, 0.0]];
//! let surface = Surface::smooth(TriMesh::from_slices(&corners, &[[0, 1, 2], [0, 2, 3]])?)?;
//! let segmentation = Segmentation { patch_of_face: IdVec::filled(PatchId(0), 2), n_patches: 1 };
//! let cells = Cells::trace(&surface, &segmentation)?;
//!
//! let options = CvtOptions { base_vertices: 50, ..CvtOptions::default() };
//! let sampled = sample(&surface, &cells, &Sizing::uniform(surface.mesh()), &options)?;
//! let on_arcs: usize = sampled.sites.on_arcs.iter().map(Vec::len).sum();
//! let inside: usize = sampled.sites.in_patches.iter().map(Vec::len).sum();
//! assert_eq!(cells.corners.len() + on_arcs + inside, 50);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod arc_measure;
mod budget;
mod candidates;
mod farthest;
mod kd_tree;
mod lloyd;
mod options;
mod sample;

pub use budget::Budget;
pub use options::CvtOptions;
pub use sample::{CvtError, Sampled, sample};
