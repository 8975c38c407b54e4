//! Quadric relaxation and shape optimisation on the surface (paper, section 4.3).
//!
//! [`relax`] moves the vertices of a domain mesh: corners stay, vertices on arcs slide along them, all others walk inside their
//! sheet. First comes the paper's relaxation (eqs. 7 to 9, corrected), then Newton's method on a shape energy over signed areas,
//! which also untangles what is folded. [`reconnect`] searches edits of a base mesh by the same energy.
//!
//! ```
//! use glam::DVec3;
//! use mesh_core::{SurfacePoint, Topology, TriMesh, VertexId};
//! use region_map::{Attachment, Network, RegionMap, SheetId, SheetNormals, Surface};
//! use relax::{RelaxOptions, relax};
//!
//! // An octahedron without arcs as surface, and as domain itself, one vertex displaced along an edge.
//! let positions = vec![DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
//! let faces = vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
//! let mesh = TriMesh::new(positions, faces)?;
//! let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
//! let network = Network::trace(&mesh, &topology, &topology.edge_ids().map(|_| None).collect(), |_| false, vec![]);
//! let normals = SheetNormals::new(&mesh, &topology, &network);
//! let surface = Surface { mesh: &mesh, topology: &topology, network: &network, normals: &normals };
//!
//! let corner = |v: VertexId| topology.fan(v).next().map(|h| SurfacePoint::at_corner(h.face(), h.corner()));
//! let mut map = RegionMap {
//!     attachments: (0..6).map(|_| Attachment::Sheet(SheetId(0))).collect(),
//!     points: mesh.positions().ids().filter_map(corner).collect(),
//!     sheet_of_face: (0..8).map(|_| SheetId(0)).collect(),
//!     spans: Default::default(),
//! };
//! let moved = topology.fan(VertexId(4)).next().unwrap();
//! map.points[VertexId(4)].barycentric[moved.next().corner()] = 0.3;
//! map.points[VertexId(4)].barycentric[moved.corner()] = 0.7;
//!
//! let relaxed = relax(&surface, &mesh, &topology, &map, &RelaxOptions::default())?;
//! assert!(relaxed.report.end.ar_mean > relaxed.report.start.ar_mean);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod domain;
mod energy;
mod error;
mod mend;
mod options;
mod part;
mod placement;
mod places;
mod quadric;
mod quality;
mod reconnect;
mod relax;
mod shape;
mod system;
mod weights;

pub use error::RelaxError;
pub use options::{QuadricOptions, RelaxOptions, ShapeOptions, TargetArea, Weights};
pub use quality::Quality;
pub use reconnect::{ReconnectOptions, Reconnected, reconnect};
pub use relax::{RelaxReport, Relaxed, inverted, relax, relax_around};
