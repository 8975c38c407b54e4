//! How long base edges may be at every place.
//!
//! Where the surface or an arc bends, edges are short enough to follow it (a limb thinner than an edge would be lost), and lengths
//! change gradually.

mod cells;
mod curvature;
mod gradation;
mod sizing;

pub use sizing::{SizingOptions, sizing};
