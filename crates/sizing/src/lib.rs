//! How long base edges may be at every place.
//!
//! [`sizing`] gives lengths relative to the mean one, by default from .5 to 1.2. Where the surface or an arc bends, edges are short enough to
//! follow it (a limb thinner than an edge would be lost); where it hardly bends they are longer; and lengths change gradually.
//!
//! ```
//! use region_map::Surface;
//! use sizing::{SizingOptions, sizing};
//!
//! // Base edges of length 2 are too long for a sphere of radius 1: along one it would turn by 2 radians, more than `turn`.
//! let surface = Surface::smooth(fixtures::icosphere(20))?;
//! let field = sizing(&surface, &SizingOptions::new(2.0))?;
//! assert!(field.relative.iter().all(|h| (h - 0.8).abs() < 0.05));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod cells;
mod curvature;
mod gradation;
mod sizing;

pub use sizing::{SizingError, SizingOptions, sizing, sizing_with};
