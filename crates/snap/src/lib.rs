//! The finest level hung on what the base could not hold: bends of arcs, and minor creases.
//!
//! The network is simplified at the resolution of the base mesh. [`snap`] refines it again, at the resolution of the finest
//! level: vertices of arcs that the edges cut off become corners, and creases that were left out become arcs, each along a path of
//! edges that are there. So they cost no base vertex, and all that holds for arcs and corners holds for them: vertices slide
//! along them, nothing crosses them, normals are one-sided.
//!
//! ```
//! use glam::DVec3;
//! use mesh_core::{Topology, TriMesh, VertexId};
//! use region_map::{ArcKind, Network, RegionMap, SheetNormals, Surface};
//! use snap::{LetGo, SnapOptions, snap};
//!
//! // A square of 6 x 6 cells as surface, and as domain itself, with a row of edges in its middle that was left out.
//! let at = |i: u32| DVec3::new(f64::from(i % 7), f64::from(i / 7), 0.0);
//! let cells = (0..36).map(|i| i / 6 * 7 + i % 6);
//! let mesh = TriMesh::new((0..49).map(at).collect(), cells.flat_map(|a| [[a, a + 1, a + 8], [a, a + 8, a + 7]]).collect())?;
//! let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
//! let kinds = topology.edge_ids().map(|e| topology.is_border_edge(e).then_some(ArcKind::Border)).collect();
//! let row = (22..27).map(VertexId).collect();
//! let network = Network::trace(&mesh, &topology, &kinds, |v| [0, 6, 42, 48].contains(&v.0), vec![row]);
//! let normals = SheetNormals::new(&mesh, &topology, &network);
//! let surface = Surface { mesh: &mesh, topology: &topology, network: &network, normals: &normals };
//! let map = RegionMap::identity(&topology, &network);
//!
//! let options = SnapOptions { least_depth: 0.0, ..SnapOptions::default() }; // the domain is the surface and misses nothing
//! let snapped = snap(&surface, &mesh, &topology, &map, &LetGo::default(), &options)?;
//! assert_eq!(snapped.network.arcs.len(), network.arcs.len() + 1);
//! assert_eq!(snapped.tracks[0].1, (22..27).map(VertexId).collect::<Vec<_>>());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bends;
mod claims;
mod drag;
mod error;
mod minor;
mod options;
mod path;
mod retarget;
mod sector;
mod snap;

pub use error::SnapError;
pub use options::SnapOptions;
pub use snap::{LetGo, Snapped, snap};
