//! Variational shape approximation into disk patches (paper, section 3.1).
//!
//! [`segment`] is the one verb. Every patch is a disk whose border is one simple cycle at all times, by the rule of growth
//! in `disk.rs`; no feature runs inside a patch.
//!
//! ```
//! use mesh_core::Topology;
//! use region_map::Cells;
//! use segment_vsa::{VsaOptions, segment};
//!
//! // A torus: no crease, and yet every patch is a disk. `Cells::trace` would refuse any other.
//! let mesh = fixtures::torus(1.0, 0.4, 40, 20);
//! let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
//! let network = features::detect(&mesh, &topology, &Default::default())?;
//! let (segmentation, _) = segment(&mesh, &topology, &network, &VsaOptions::default())?;
//! let cells = Cells::trace(&mesh, &topology, &network, &segmentation)?;
//! assert_eq!(cells.corners.len() as i64 - cells.arcs.len() as i64 + cells.patches.len() as i64, topology.euler());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod axes;
mod disk;
mod grow;
mod inflate;
mod merge;
mod proxy;
mod seeds;
mod segment;
mod split;
mod straighten;
mod surface;

pub use segment::{VsaError, VsaOptions, VsaReport, segment};
pub use split::split;
