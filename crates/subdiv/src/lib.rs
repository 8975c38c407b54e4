//! Linear 1-to-4 subdivision of a base mesh, any number of times, that keeps the region map (paper, section 4.1).
//!
//! Index arithmetic only: child faces of face `f = (a, b, c)` are `4f..4f+3` =
//! `(a, ab, ca) (b, bc, ab) (c, ca, bc) (bc, ca, ab)`, and the vertices of a level are a prefix of those of the next. A midpoint
//! of an edge on an arc is on that arc, of any other edge in the sheet of its face (two end points do not decide: two corners may
//! be joined across a sheet).
//!
//! [`carried_over`] brings a domain, its vertices anywhere on the surface, to its base mesh with a few more vertices.
//!
//! ```
//! use mesh_core::TriMesh;
//! use region_map::{Domain, Surface};
//! use subdiv::subdivide;
//!
//! // A tetrahedron as its own base mesh, its six edges as arcs between four corners.
//! let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Into::into).to_vec();
//! let surface = Surface::with_creases(TriMesh::new(positions, vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])?, 40.0)?;
//! let finest = subdivide(&Domain::identity(&surface), 2)?.domain;
//!
//! assert_eq!(finest.mesh.n_faces(), 16 * 4);
//! let counts = finest.region.class_counts();
//! assert_eq!((counts.at_corners, counts.on_arcs, counts.in_sheets), (4, 6 * 3, 4 * 3));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod carry;
mod grid;
mod matching;
mod subdivide;

pub use carry::{Carried, carried_over};
pub use subdivide::{SubdivDomain, SubdivError, subdivide};
