//! What is tried where a result is not right at once: the plan, its budget, and what mends places.

mod budget;
mod mender;
mod misses;
mod places;
mod plan;
mod together;

pub use budget::MAX_TRIANGLES;
pub(crate) use budget::{Budget, NextStage};
pub(crate) use misses::followed;
pub(crate) use places::mended;
pub(crate) use plan::{Growth, Loss, PLAN, finest, growth};
pub(crate) use together::{joined, matched, on_touching_arcs};
