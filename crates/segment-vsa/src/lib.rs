//! Variational shape approximation into disk patches (paper, section 3.1).
//!
//! [`segment`] is the one verb. Every patch is a disk whose border is one simple cycle at all times, by the rule of growth
//! in `disk.rs`; no feature runs inside a patch.
//!
//! ```
//! use region_map::{Cells, Surface};
//! use segment_vsa::{VsaOptions, segment};
//!
//! // A torus: no crease, and yet every patch is a disk. `Cells::trace` would refuse any other.
//! let surface = Surface::smooth(fixtures::torus(1.0, 0.4, 40, 20))?;
//! let (segmentation, _) = segment(&surface, &VsaOptions::default())?;
//! let cells = Cells::trace(&surface, &segmentation)?;
//! let euler = cells.corners.len() as i64 - cells.arcs.len() as i64 + cells.patches.len() as i64;
//! assert_eq!(euler, surface.topology().euler());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod axes;
mod disk;
mod grow;
mod inflate;
mod measured;
mod merge;
mod proxy;
mod seeds;
mod segment;
mod split;
mod straighten;

pub use segment::{VsaError, VsaOptions, VsaReport, segment};
pub use split::{SplitError, split};
