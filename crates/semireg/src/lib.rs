//! The whole pipeline: any triangle mesh in, a certified semi-regular mesh out.
//!
//! [`remesh`] runs the stages one after the other; each stage is a crate of its own that can be used without the others.
//!
//! ```
//! use semireg::{Options, remesh};
//!
//! let soup = fixtures::cube(3).to_soup();
//! let remeshed = remesh(&soup, &Options { base_vertices: Some(40), levels: 2, ..Options::default() })?;
//! assert!(remeshed.report.certificate.passed());
//! let base = &remeshed.stages.base.base.mesh;
//! assert_eq!(remeshed.mesh.n_faces(), 16 * base.n_faces());
//! # Ok::<(), semireg::Error>(())
//! ```

mod anchors;
mod base_report;
mod base_stages;
mod error;
mod failing;
mod fitting;
mod input;
mod ladder;
mod marked;
mod options;
mod patches;
mod pipeline;
mod rating;
mod repair;
mod report;
mod search;
mod snapping;
mod with_base;

pub use base_stages::{BaseStages, Way};
pub use error::Error;
pub use fit::FitReport;
pub use options::Options;
pub use patches::Patches;
pub use pipeline::{Based, MAX_TRIANGLES, Remeshed, Stages, base, remesh};
pub use report::{Report, StageSeconds};
pub use with_base::remesh_with_base;
