//! The whole pipeline: any triangle mesh in, a certified semi-regular mesh out.
//!
//! [`remesh`] runs the stages one after the other; each stage is a crate of its own that can be used without the others.
//!
//! ```
//! use semireg::{Options, remesh};
//!
//! let soup = fixtures::cube(3).to_soup();
//! let remeshed = remesh(&soup, &Options { base_vertices: Some(40), levels: Some(2), ..Options::default() })?;
//! assert!(remeshed.report.certificate.passed());
//! let base = remeshed.stages.base.base.mesh();
//! assert_eq!(remeshed.mesh.n_faces(), 16 * base.n_faces());
//! # Ok::<(), semireg::Error>(())
//! ```

mod attempt;
mod badness;
mod base;
mod best;
mod candidate;
mod error;
mod finish;
mod goal;
mod input;
mod nudged;
mod options;
mod progress;
mod raised;
mod relaxation;
mod remesh;
mod remeshed;
mod report;
mod rescue;
mod run;
mod verdict;

pub use attempt::{Attempt, EdgeChoice, Remedy};
pub use base::{Base, BaseCounts, BaseStages, CellCounts, Method, Patches, Way};
pub use correspondence::{CorrespondenceError, FaceOrder, Levels, Map, Prolongation};
pub use error::Error;
pub use fit::FitReport;
pub use goal::{Goal, SizeTry, Split, Target};
pub use options::{MAX_LEVELS, Options, USUAL_LEVELS};
pub use progress::{OnProgress, Progress};
pub use relax::Weights;
pub use relaxation::{PaperOptions, Relaxation};
pub use remesh::{base, base_with, remesh, remesh_to, remesh_with};
pub use remeshed::{Based, Remeshed, Stages};
pub use report::{Report, SnapCounts};
pub use rescue::MAX_TRIANGLES;
pub use run::{StageSeconds, StageTime};
pub use verdict::Verdict;
