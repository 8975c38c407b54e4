//! A finer triangulation of the same surface, for stages that look at triangles one by one.
//!
//! CAD tessellations have planes of two triangles, cylinders of strips as long as the part, and fans of needles from one vertex to
//! a whole circle. Patches that grow face by face get ragged borders there, and charts fold. So the working mesh is refined before
//! anything is segmented: edges that lie in a plane with both of their faces are flipped towards Delaunay, and long edges are halved.
//! The point set of the surface stays what it is, but where edges are contracted that are much shorter than any of the result's.
//!
//! ```
//! use mesh_core::{Topology, TriMesh};
//! use refine::{RefineOptions, refine};
//!
//! // A rectangle of two triangles, without marked edges.
//! let corners = [[0.0, 0.0, 0.0], [5.0, 0.0, 0.0], [5.0, 3.0, 0.0], [0.0, 3.0, 0.0]];
//! let mesh = TriMesh::from_slices(&corners, &[[0, 1, 2], [0, 2, 3]])?;
//! let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
//! let refined = refine(&mesh, &topology, &[], &RefineOptions::new(0.2))?;
//! assert!(refined.topology.edge_ids().all(|e| {
//!     let [a, b] = refined.topology.ends(e);
//!     refined.mesh.distance(a, b) <= 0.2
//! }));
//! assert!((refined.mesh.total_area() - mesh.total_area()).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod contract;
mod editable_mesh;
mod options;
mod refine;

pub use options::{RefineError, RefineOptions};
pub use refine::{Refined, refine};
