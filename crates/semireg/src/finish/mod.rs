//! From a base mesh to a certified mesh: subdivided, projected, relaxed, mended, snapped, fitted and certified.

mod fitting;
mod levels;
mod paper;
mod place;
mod snapping;
mod whole;

pub(crate) use paper::paper_finished;
pub(crate) use whole::finished;

#[cfg(test)]
pub(crate) use place::first_candidate;
