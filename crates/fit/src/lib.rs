//! The last move of the vertices: off the surface, so that the triangles between them come closer to it.
//!
//! When all vertices are on a convex surface, all triangles are inside it. [`fit`] moves the vertices along the surface's
//! normals, and a little over the surface, to where the distances between the two, in both directions, are least. Vertices at
//! corners and on arcs stay exactly. Distances are measured from samples to the nearest place inside their own sheet, so neither
//! the two sides of a thin plate nor components that pass through each other are mistaken for one another. The greatest distance
//! does not grow, no triangle turns over, and where the mean distance hardly falls, nothing moves.
//!
//! ```
//! use fit::{FitOptions, fit};
//! use mesh_core::TriMesh;
//! use region_map::{Domain, RegionMap, Surface};
//!
//! // An octahedron, and the spheres that come of it at 5 and at 3 levels: the surface, and a domain with its vertices on it.
//! let corners = [[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]].map(|p| p.map(f64::from).into()).to_vec();
//! let octahedron = TriMesh::new(corners, (0..4).flat_map(|i| [[i, (i + 1) % 4, 4], [(i + 1) % 4, i, 5]]).collect())?;
//! let base = Domain::identity(&Surface::smooth(octahedron)?);
//! let [fine, coarse] = [subdiv::subdivide(&base, 5)?, subdiv::subdivide(&base, 3)?].map(|level| level.domain);
//! let surface = Surface::smooth(fine.mesh.with_positions(fine.mesh.positions().iter().map(|p| p.normalize()).collect())?)?;
//! let nearest = coarse.mesh.positions().iter().filter_map(|p| surface.index().closest(p.normalize())).map(|c| c.point());
//! let domain = coarse.placed(&surface, RegionMap { points: nearest.collect(), ..coarse.region.clone() })?;
//!
//! let fitted = fit(&surface, &domain, &FitOptions::default())?;
//! assert!(fitted.report.used && fitted.report.end.mean < 0.6 * fitted.report.start.mean);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod error;
mod errors;
mod fit;
mod options;
mod pairs;
mod placement;
mod shape_guard;
mod system;
mod terrain;

pub use error::FitError;
pub use errors::Errors;
pub use fit::{FitReport, Fitted, fit, fit_holding};
pub use options::FitOptions;
