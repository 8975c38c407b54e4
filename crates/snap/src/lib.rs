//! The finest level hung on what the base could not hold: bends of arcs, and minor creases.
//!
//! The network is simplified at the resolution of the base mesh. [`snap`] refines it again, at the resolution of the finest
//! level: vertices of arcs that the edges cut off become corners, and creases that were left out become arcs, each along a path of
//! edges that are there. So they cost no base vertex, and all that holds for arcs and corners holds for them: vertices slide
//! along them, nothing crosses them, normals are one-sided.
//!
//! ```
//! use mesh_core::TriMesh;
//! use region_map::{Domain, Surface};
//! use snap::{LetGo, SnapOptions, snap};
//!
//! // A square of 6 x 6 cells as surface, and as domain itself. Nothing is bent, so nothing is snapped to.
//! let positions = (0..49).map(|i| [f64::from(i % 7), f64::from(i / 7), 0.0].into()).collect();
//! let cells = (0..36).map(|i| i / 6 * 7 + i % 6);
//! let surface = Surface::smooth(TriMesh::new(positions, cells.flat_map(|a| [[a, a + 1, a + 8], [a, a + 8, a + 7]]).collect())?)?;
//! let domain = Domain::identity(&surface);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bends;
mod claims;
mod drag;
mod error;
mod minor;
mod options;
mod path;
mod retarget;
mod sector;
mod snap;

pub use error::SnapError;
pub use options::SnapOptions;
pub use snap::{LetGo, Snapped, snap};
