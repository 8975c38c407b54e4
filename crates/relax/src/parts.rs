//! For crates that try edits of a domain: a place is taken out as a domain of its own, relaxed, and its energy compared.
//!
//! A [`Whole`] is a domain over its surface, each vertex a [`PlacedVertex`] with a [`Freedom`]. [`Whole::part`] takes triangles
//! out of it, changed as the caller likes: with other vertices, other [`CornerNormal`]s, other neighbours on arcs ([`OnArc`],
//! [`ArcNeighbour`]). What [`Part::relaxed`] gives is what these triangles then cost, and where their vertices went. The domain
//! itself never changes.
//!
//! ```
//! use mesh_core::{HalfedgeId, TriMesh};
//! use region_map::{Domain, Surface};
//! use relax::{ShapeOptions, parts::{PartFace, Whole}};
//!
//! // A pyramid on a square, its apex off the middle. All of it is one part, whose triangles shall be equally large.
//! let positions = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.], [0.2, 0.3, 0.1]];
//! let surface = Surface::smooth(TriMesh::from_slices(&positions, &[[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])?)?;
//! let (whole, options) = (Whole::new(&surface, &Domain::identity(&surface))?, ShapeOptions::default());
//! let normals = |f| [0, 1, 2].map(|c| whole.normals()[HalfedgeId::of(f, c)]);
//! let face = |(f, &corners)| PartFace { corners, normals: normals(f), target_area: 0.25 };
//! let faces: Vec<PartFace> = surface.topology().faces().enumerate().map(face).collect();
//! let part = whole.part(&faces, |v| whole.freedoms()[v]).ok_or("no manifold")?;
//! let relaxed = part.relaxed(|v| whole.placed()[v], &options);
//! assert!(relaxed.costs.iter().sum::<f64>() < whole.costs(&options).iter().sum());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub use crate::corner_normal::CornerNormal;
pub use crate::freedom::{ArcNeighbour, Freedom, OnArc};
pub use crate::part::{Part, PartFace, RelaxedPart};
pub use crate::placed_vertex::PlacedVertex;
pub use crate::whole::Whole;
