//! Edits of a base mesh that are asked for from outside.

mod bisect;
mod mend;
mod replay;

pub use bisect::bisect;
pub use mend::{Mended, mend};
pub use replay::Replay;
