//! A base mesh from elsewhere (from decimation, clustering, by hand) becomes a base mesh of a surface.
//!
//! Its vertices are attached to the corners, arcs and sheets of a network as far as its edges follow it; its other edges are traced
//! over the working mesh as paths that do not cross (Praun, Sweldens and Schröder, *Consistent mesh parameterizations*, 2001: a
//! spanning tree first, every path between its neighbours in the order round a vertex). Then every base face is a disk on the
//! surface, and its chart a triangle.
//!
//! [`retrace`] does the second half for a base mesh of our own, whose map has become long and rough by many edits: the paths go near
//! to where this map has the edges, and the map without a history that comes of it is exact to rounding.
//!
//! ```
//! use mesh_core::FaceId;
//! use region_map::Surface;
//! use trace_base::{TracedBase, trace};
//!
//! // A cube of 768 triangles, and one of 12 for its base mesh.
//! let surface = Surface::with_creases(fixtures::cube(8), 40.0)?;
//! let traced = trace(&surface, &fixtures::cube(1))?;
//! let TracedBase::Mapped(base) = &traced.base else { return Err("no map".into()) };
//! assert_eq!((traced.surface.network().corners.len(), base.map.charts().len()), (8, 12));
//! let point = base.locate(FaceId(5), glam::DVec3::ONE / 3.0).position(surface.mesh());
//! assert!(point.distance(base.mesh().centroid(FaceId(5))) < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod attach;
mod charts;
mod cut_mesh;
mod error;
mod follow;
mod foreign;
mod lay;
mod path;
mod paths;
mod place;
mod retrace;
mod stops;
mod trace;
mod tracer;

pub use error::{TraceError, Untraced};
pub use retrace::retrace;
pub use trace::{Traced, TracedBase, trace};
