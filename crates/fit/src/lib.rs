//! The last move of the vertices: off the surface, so that the triangles between them come closer to it.
//!
//! Vertices on a convex surface have all their chords inside it. [`fit`] moves those inside sheets along the surface's normals, and a little
//! over the surface, to where the distances between the two surfaces, both ways, are least; corners and arcs stay exactly. Each sample
//! follows its place on the other surface downhill, inside its sheet, so neither thin plates nor components that pass through each other
//! mix. The greatest distance does not grow, no triangle turns over, and where the mean distance hardly falls, nothing moves.
//!
//! ```
//! use fit::{FitOptions, fit};
//! use mesh_core::{Id, SurfaceIndex, Topology, VertexId};
//! use region_map::{Network, RegionMap, SheetNormals, Surface};
//!
//! // A fine sphere, and a coarse one as domain with its vertices on it.
//! let (mesh, coarse) = (fixtures::icosphere(12), fixtures::icosphere(4));
//! let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
//! let smooth = |t: &Topology| t.edge_ids().map(|_| None).collect();
//! let network = Network::trace(&mesh, &topology, &smooth(&topology), |_| false, vec![]);
//! let normals = SheetNormals::new(&mesh, &topology, &network);
//! let surface = Surface { mesh: &mesh, topology: &topology, network: &network, normals: &normals };
//!
//! let domain_topology = Topology::new(coarse.faces(), coarse.n_vertices())?;
//! let none = Network::trace(&coarse, &domain_topology, &smooth(&domain_topology), |_| false, vec![]);
//! let mut map = RegionMap::identity(&domain_topology, &none);
//! let index = SurfaceIndex::new(&mesh);
//! map.points = coarse.positions().iter().filter_map(|&p| index.closest(p)).map(|c| c.point()).collect();
//! let domain = coarse.with_positions(map.points.iter().map(|p| p.position(&mesh)).collect())?;
//!
//! let fitted = fit(&surface, &domain, &domain_topology, &map, &FitOptions::default())?;
//! assert!(fitted.report.used && fitted.report.end.mean < 0.6 * fitted.report.start.mean);
//! assert!(fitted.offsets[VertexId::new(0)] > 0.0);
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
pub use fit::{FitReport, Fitted, fit};
pub use options::FitOptions;
