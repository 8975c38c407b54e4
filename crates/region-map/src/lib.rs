//! The vocabulary between the stages: what one stage makes and another one reads.
//!
//! Four words are used throughout:
//! - a **corner** is a vertex that stays exactly where it is: where creases meet, end or turn sharply;
//! - an **arc** is a chain of edges from one corner to the next, or a closed one: a crease, a border, or edges that the user marked;
//! - a **sheet** is a part of the surface that the arcs cut off: nothing that is inside one ever leaves it;
//! - a **patch** is a part of a sheet that is a disk and nearly flat.
//!
//! So two complexes lie over the working mesh, and must not be confused:
//! - the [`Network`] of corners, arcs and sheets. It holds to the end and bounds all projection and relaxation. A [`Surface`] is the
//!   working mesh with its network.
//! - the [`Cells`]: the patches of a [`Segmentation`], with corners and arcs of their own. They serve to sample and to chart; once the
//!   first base mesh stands they are gone.
//!
//! A [`Domain`] is a mesh over the surface: the base mesh, and all that is subdivided from it. Its [`RegionMap`] tells where on the
//! network each of its vertices, edges and faces belongs. A [`BaseMesh`] also has a [`BaseMap`], a bijection to the working mesh.
//!
//! ```
//! use region_map::{Domain, Surface};
//!
//! // A cylinder: two rims, closed arcs without a corner, between three sheets.
//! let surface = Surface::with_creases(fixtures::cylinder(0.5, 1.5, 48), 40.0)?;
//! let network = surface.network();
//! assert_eq!((network.corners.len(), network.arcs.len(), network.n_sheets), (0, 2, 3));
//!
//! // The mesh as a domain over itself: 48 vertices on each rim, the others inside sheets.
//! let domain = Domain::identity(&surface);
//! domain.check(network)?;
//! assert_eq!(domain.region.class_counts().on_arcs, 96);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod base_edit;
mod base_map;
mod base_mesh;
mod cells;
mod chain;
mod domain;
mod network;
mod region_map;
mod segmentation;
mod sheet_normals;
mod sites;
mod sizing;
mod surface;

pub use base_edit::BaseEdit;
pub use base_map::{BaseMap, Chart, ChartFace, ChartId, MapError, MapFaceId, flat_barycentric};
pub use base_mesh::{BaseMesh, BaseMeshError};
pub use cells::{CellArc, CellArcId, CellCornerId, CellError, CellPatch, Cells};
pub use chain::spokes;
pub use domain::{Domain, DomainError};
pub use mesh_core::SurfacePoint;
pub use network::{Arc, ArcId, ArcKind, CornerId, CreaseLengths, LeastBase, Network, NetworkError, SheetId};
pub use region_map::{ArcSpan, Attachment, ClassCounts, RegionMap, RegionMapError};
pub use segmentation::{PatchId, Segmentation};
pub use sheet_normals::SheetNormals;
pub use sites::Sites;
pub use sizing::Sizing;
pub use surface::{Surface, SurfaceError};
