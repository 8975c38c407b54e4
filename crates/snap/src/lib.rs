//! Moves vertices of the finest level to features that the base mesh is too coarse for: bends of arcs, and minor creases.
//!
//! The network has only what the base mesh can follow. [`snap`] refines it for the finest level: where an edge cuts off a bend of
//! an arc, the vertex of the bend becomes a corner, and creases that were left out become arcs, each along a path of edges of the
//! finest level. So they cost no base vertex, and what holds for all arcs and corners holds for them: vertices slide along arcs,
//! nothing crosses them, and normals are one-sided. [`release`] is the way back, for arcs that the domain cannot follow.
//!
//! ```
//! use mesh_core::{TriMesh, VertexId};
//! use region_map::{Domain, Network, Surface};
//! use snap::{LetGo, SnapOptions, snap};
//!
//! // A square of 6 x 6 cells as surface, with a row of edges in its middle that the network has left out, and as domain itself.
//! let positions = (0..49).map(|i| [f64::from(i % 7), f64::from(i / 7), 0.0].into()).collect();
//! let cells = (0..36).map(|i| i / 6 * 7 + i % 6);
//! let smooth = Surface::smooth(TriMesh::new(positions, cells.flat_map(|a| [[a, a + 1, a + 8], [a, a + 8, a + 7]]).collect())?)?;
//! let row = (22..27).map(VertexId).collect();
//! let surface = smooth.with_network(Network { minor: vec![row], ..smooth.network().clone() })?;
//!
//! let options = SnapOptions { least_depth: 0.0, ..SnapOptions::default() }; // the domain is the surface and misses nothing
//! let snapped = snap(&surface, &Domain::identity(&surface), &Default::default(), &LetGo::default(), &options)?;
//! assert_eq!(snapped.surface.network().arcs.len(), surface.network().arcs.len() + 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod assigner;
mod assignment;
mod bends;
mod drag;
mod error;
mod let_go;
mod minor;
mod options;
mod path;
mod poor;
mod release;
mod retarget;
mod sector;
mod snap;

pub use error::SnapError;
pub use let_go::LetGo;
pub use options::SnapOptions;
pub use release::release;
pub use snap::{Bend, Snapped, Track, snap};
