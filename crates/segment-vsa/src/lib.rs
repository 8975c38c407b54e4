//! Variational shape approximation into disk patches (paper, section 3.1).
//!
//! [`segment`] is the one verb. Every patch is a disk whose border is one simple cycle at all times, by the rule of growth
//! in `disk.rs`; no feature runs inside a patch.

mod axes;
mod disk;
mod grow;
mod inflate;
mod merge;
mod proxy;
mod seeds;
mod segment;
mod split;
mod straighten;
mod surface;

pub use segment::{VsaError, VsaOptions, VsaReport, segment};
pub use split::split;
