//! Quadric relaxation and shape optimisation on the surface (paper, section 4.3).

mod domain;
mod energy;
mod error;
mod options;
mod placement;
mod quadric;
mod quality;
mod relax;
mod shape;
mod system;
mod weights;

pub use error::RelaxError;
pub use options::{QuadricOptions, RelaxOptions, ShapeOptions, TargetArea, Weights};
pub use quality::Quality;
pub use relax::{RelaxReport, Relaxed, relax};
