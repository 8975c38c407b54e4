//! The last move of the vertices: off the surface, so that the triangles between them come closer to it.
//!
//! Vertices on a convex surface have all their chords inside it. [`fit`] moves those inside sheets along the surface's normals, and a little
//! over the surface, to where the distances between the two surfaces, both ways, are least; corners and arcs stay exactly. Each sample
//! follows its place on the other surface downhill, inside its sheet, so neither thin plates nor components that pass through each other
//! mix. The greatest distance does not grow, no triangle turns over, and where the mean distance hardly falls, nothing moves.
//!
//! ```
//! use fit::{FitOptions, fit};
//! use mesh_core::TriMesh;
//! use region_map::{Domain, Surface};
//!
//! let surface = Surface::smooth(TriMesh::new(vec![], vec![])?)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod error;
mod errors;
mod fit;
mod options;
mod pairs;
mod placement;
mod system;
mod terrain;

pub use error::FitError;
pub use errors::Errors;
pub use fit::{FitReport, Fitted, fit, fit_holding};
pub use options::FitOptions;
