//! Creases, corners and borders of a mesh as a network of arcs, simplified at the resolution of the base mesh.
//!
//! [`detect`] is the one verb: it finds creases by dihedral angle with hysteresis, adds borders and marked edges, takes out
//! what is too small or too weak to be worth base vertices, and sets the corners.
//!
//! ```
//! use features::{FeatureOptions, detect};
//! use mesh_core::Topology;
//!
//! // A cube has 12 arcs between 8 corners; the rims of a cylinder are closed arcs without any.
//! for (mesh, expected) in [(fixtures::cube(4), (8, 12, 6)), (fixtures::cylinder(1.0, 2.0, 48), (0, 2, 3))] {
//!     let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
//!     let network = detect(&mesh, &topology, &[], 0.4, &FeatureOptions::default())?;
//!     assert_eq!((network.corners.len(), network.arcs.len(), network.n_sheets), expected);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod chains;
mod corner;
mod crease;
mod detect;
mod jump;
mod options;
mod simplify;

pub use detect::detect;
pub use options::{FeatureError, FeatureOptions};
