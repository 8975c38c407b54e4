//! Creases, corners and borders of a mesh as a network of arcs, simplified at the resolution of the base mesh.
//!
//! [`detect`] is the one verb: it finds creases by dihedral angle with hysteresis, adds borders and marked edges, takes out
//! what is too small or too weak to be worth base vertices, and sets the corners.
//!
//! ```
//! use features::{FeatureOptions, detect};
//! use mesh_core::{Topology, TriMesh};
//!
//! // A cube of twelve triangles has 12 arcs between 8 corners, and no marked edges. Length 0 keeps all creases.
//! let positions = [0, 1, 2, 3, 4, 5, 6, 7].map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from));
//! let squares = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
//! let faces = squares.map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).concat();
//! let mesh = TriMesh::from_slices(&positions, &faces)?;
//! let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
//! let network = detect(&mesh, &topology, &[], 0.0, &FeatureOptions::default())?;
//! assert_eq!((network.corners.len(), network.arcs.len(), network.n_sheets), (8, 12, 6));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod chains;
mod corner;
mod crease;
mod detect;
mod gaps;
mod jump;
mod narrow;
mod options;
mod rounded;
mod simplify;
mod touching;

pub use detect::detect;
pub use options::{FeatureError, FeatureOptions};
pub use touching::touching_edges;
