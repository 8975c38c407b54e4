//! From a base mesh to a certified mesh: subdivided, projected, relaxed, mended, snapped, fitted and certified.

mod fitting;
mod place;
mod snapping;
mod whole;

pub(crate) use whole::finished;
