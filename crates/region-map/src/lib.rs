//! The vocabulary between the stages: what one stage makes and another one reads.
//!
//! Two complexes are laid over the working mesh, and must not be confused:
//! - the [`Network`]: corners, arcs (creases, borders, marked edges) and the *sheets* that they cut the surface into. It holds
//!   to the end and bounds all projection and relaxation.
//! - the [`Cells`]: the *patches* of a [`Segmentation`] inside the sheets, with their own corners and arcs. They serve to
//!   sample and to chart; once the first base mesh stands they are gone.
//!
//! A domain mesh (the base mesh and all that is subdivided from it) is tied to the network by a [`RegionMap`], and the base mesh
//! to the working mesh by a [`BaseMap`], a bijection.
//!
//! ```
//! use mesh_core::Topology;
//! use region_map::{ArcKind, Network, RegionMap};
//!
//! // A cylinder: two rims, closed arcs without a corner, between three sheets.
//! let mesh = fixtures::cylinder(0.5, 1.5, 48);
//! let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
//! let network = Network::trace(&mesh, &topology, &ArcKind::by_angle(&mesh, &topology, 40.0), |_| false, Vec::new());
//! assert_eq!((network.corners.len(), network.arcs.len(), network.n_sheets), (0, 2, 3));
//!
//! // The mesh as a domain over itself: 48 vertices on each rim, the others inside sheets.
//! let map = RegionMap::identity(&topology, &network);
//! map.check(&topology, &network)?;
//! assert_eq!(map.class_counts()[1], 96);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod base_edit;
mod base_map;
mod base_mesh;
mod cells;
mod chain;
mod network;
mod region_map;
mod segmentation;
mod sheet_normals;
mod sites;
mod sizing;

pub use base_edit::BaseEdit;
pub use base_map::{BaseMap, Chart, ChartFace, ChartId, MapError, MapFaceId, flat_barycentric};
pub use base_mesh::{BaseCounts, BaseMesh};
pub use cells::{CellArc, CellArcId, CellCornerId, CellError, CellPatch, Cells};
pub use mesh_core::SurfacePoint;
pub use network::{Arc, ArcId, ArcKind, CornerId, Network, SheetId};
pub use region_map::{ArcSpan, Attachment, RegionMap, RegionMapError};
pub use segmentation::{PatchId, Segmentation};
pub use sheet_normals::{SheetNormals, Surface};
pub use sites::Sites;
pub use sizing::Sizing;
