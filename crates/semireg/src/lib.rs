//! The whole pipeline: any triangle mesh in, a certified semi-regular mesh out.
//!
//! [`remesh`] runs the stages one after the other; each stage is a crate of its own that can be used without the others.

mod base_stages;
mod error;
mod ladder;
mod options;
mod pipeline;
mod report;

pub use base_stages::BaseStages;
pub use error::Error;
pub use options::Options;
pub use pipeline::{Remeshed, Stages, base, remesh};
pub use report::{Report, StageSeconds};
