//! Variational shape approximation into disk patches (paper, section 3.1).
//!
//! [`segment`] is the one verb. Every patch is a disk whose border is one simple cycle at all times, by the rule of growth
//! in `disk.rs`; no feature runs inside a patch.
//!
//! ```
//! use mesh_core::TriMesh;
//! use region_map::Surface;
//! use segment_vsa::{VsaOptions, segment};
//!
//! // A cube of twelve triangles: each of its sides is a patch.
//! let positions = [0, 1, 2, 3, 4, 5, 6, 7].map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from));
//! let squares = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
//! let faces = squares.map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).concat();
//! let surface = Surface::with_creases(TriMesh::from_slices(&positions, &faces)?, 40.0)?;
//! let (segmentation, _) = segment(&surface, &VsaOptions::default())?;
//! assert_eq!(segmentation.n_patches, 6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! ```
//! use region_map::{Cells, Surface};
//! use segment_vsa::{VsaOptions, segment};
//!
//! // A torus: no crease, and yet every patch is a disk. `Cells::trace` would refuse any other.
//! let surface = Surface::smooth(fixtures::torus(1.0, 0.4, 40, 20))?;
//! let (segmentation, _) = segment(&surface, &VsaOptions::default())?;
//! let cells = Cells::trace(&surface, &segmentation)?;
//! let euler = cells.corners.len() as i64 - cells.arcs.len() as i64 + cells.patches.len() as i64;
//! assert_eq!(euler, surface.topology().euler());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod axes;
mod disk;
mod grow;
mod inflate;
mod measured;
mod merge;
mod proxy;
mod seeds;
mod segment;
mod split;
mod straighten;

pub use segment::{VsaError, VsaOptions, VsaReport, segment};
pub use split::{SplitError, split};
