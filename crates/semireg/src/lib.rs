//! The whole pipeline: any triangle mesh in, a certified semi-regular mesh out.
//!
//! [`remesh`] runs the stages one after the other; each stage is a crate of its own that can be used without the others.

mod error;
mod options;
mod pipeline;
mod report;

pub use error::Error;
pub use options::Options;
pub use pipeline::{BaseStages, Remeshed, Stages, base, remesh};
pub use report::{Report, StageSeconds};
