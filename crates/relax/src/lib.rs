//! Quadric relaxation and shape optimisation on the surface (paper, section 4.3).
//!
//! [`relax`] moves the vertices of a domain mesh: corners stay, vertices on arcs slide along them, all others walk inside their
//! sheet. First comes the paper's relaxation (eqs. 7 to 9, corrected), then Newton's method on a shape energy over signed areas,
//! which also untangles what is folded.
//!
//! - [`relax_holding`] leaves some vertices where they are;
//! - [`relax_keeping`] holds those without which a limb or a pit of the input would be lost;
//! - [`relax_in_space`] is the paper's relaxation as it is printed: vertices leave the surface, and a second projection brings them back;
//! - [`relax_around`] relaxes the places of some faces alone;
//! - [`inverted`] tells which faces are turned over;
//! - [`parts`] is for crates that try edits of a domain and compare its energy before and after.
//!
//! ```
//! use mesh_core::TriMesh;
//! use region_map::{Domain, Surface};
//! use relax::{RelaxOptions, relax};
//!
//! // A pyramid on a square, its apex off the middle.
//! let positions = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.], [0.2, 0.3, 0.1]];
//! let faces = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
//! let surface = Surface::smooth(TriMesh::from_slices(&positions, &faces)?)?;
//! let relaxed = relax(&surface, &Domain::identity(&surface), &RelaxOptions::default())?;
//! assert!(relaxed.report.end.ar_mean > relaxed.report.start.ar_mean);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod best_shape;
mod corner_normal;
mod energy;
mod error;
mod freedom;
mod in_space;
mod keeping;
mod longest_gaps;
mod measured;
mod mend;
mod movable_domain;
mod options;
mod part;
pub mod parts;
mod placed_vertex;
mod placement;
mod places;
mod quadric;
mod quality;
mod relax;
mod shape;
mod system;
mod weights;
mod whole;

pub use error::RelaxError;
pub use in_space::{RelaxedInSpace, relax_in_space};
pub use keeping::relax_keeping;
pub use options::{QuadricOptions, RelaxOptions, ShapeOptions, Weights};
pub use quality::Quality;
pub use relax::{RelaxReport, Relaxed, inverted, relax, relax_around, relax_holding};
