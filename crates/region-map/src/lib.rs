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
