//! Regional projection: every domain vertex onto the surface, by its class (paper, section 4.2).
//!
//! Corners stay. Vertices on arcs go to their arc length. Vertices inside a sheet are placed by the bijective map of the base mesh,
//! where there is one, and the paper's ray along the domain normal may then improve the place; without a map the ray comes first, and
//! where it misses, the nearest point of the sheet.
//!
//! ```
//! use mesh_core::Topology;
//! use project::{ProjectOptions, project};
//! use region_map::{Network, RegionMap, SheetNormals, Surface};
//!
//! // A sphere, and as the domain the sphere itself, swollen.
//! let mesh = fixtures::icosphere(6);
//! let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
//! let kinds = topology.edge_ids().map(|_| None).collect();
//! let network = Network::trace(&mesh, &topology, &kinds, |_| false, Vec::new());
//! let normals = SheetNormals::new(&mesh, &topology, &network);
//! let surface = Surface { mesh: &mesh, topology: &topology, network: &network, normals: &normals };
//! let domain = mesh.with_positions(mesh.positions().iter().map(|&p| 1.1 * p).collect())?;
//!
//! let region = RegionMap::identity(&topology, &network);
//! let projected = project(&surface, &domain, &region, None, &ProjectOptions::default())?;
//! assert_eq!(projected.report.by_ray, mesh.n_vertices());
//! assert!(projected.mesh.positions().iter().all(|p| p.length() > 0.97 && p.length() < 1.0 + 1e-9));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod place;
mod project;
mod ray;

pub use place::Origins;
pub use project::{ProjectError, ProjectOptions, ProjectReport, Projected, project};
