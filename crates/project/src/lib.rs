//! Regional projection: every domain vertex onto the surface, by its class (paper, section 4.2).
//!
//! Corners stay. Vertices on arcs go to their arc length. Vertices inside a sheet are placed by the bijective map of the base
//! mesh, where there is one, and the paper's ray along the domain normal may then improve the place; without a map the ray comes
//! first, and where it misses, the nearest point of the sheet.
//!
//! ```
//! use mesh_core::TriMesh;
//! use project::{ProjectOptions, project};
//! use region_map::{Domain, Surface};
//!
//! // A unit square of two triangles as surface, and as its domain the same with a corner lifted.
//! let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]].map(Into::into).to_vec();
//! let surface = Surface::smooth(TriMesh::new(corners.clone(), vec![[0, 1, 2], [0, 2, 3]])?)?;
//! let mut domain = Domain::identity(&surface);
//! domain.mesh = domain.mesh.with_positions([&corners[..3], &[[0.0, 1.0, 0.5].into()]].concat())?;
//!
//! let projected = project(&surface, &domain, None, &ProjectOptions::default())?;
//! assert_eq!(projected.domain.mesh.positions().as_slice(), corners);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod error;
mod place;
mod project;
mod ray;
mod refined;

pub use error::ProjectError;
pub use place::Origins;
pub use project::{ProjectOptions, ProjectReport, Projected, project};
pub use refined::project_refined;
