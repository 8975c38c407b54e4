//! How long base edges may be at every place.
//!
//! Three rules: where the surface or an arc bends, edges are short enough to follow it (a limb thinner than an edge would be lost);
//! across a strip between two creases an edge is at most as long as the strip is wide; and lengths change gradually.

mod cells;
mod curvature;
mod gradation;
mod sizing;
mod strips;

pub use sizing::{SizingOptions, sizing};
