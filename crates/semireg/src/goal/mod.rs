//! Results of a size or an error that the user names: how many base vertices and levels that takes.

mod reach;
mod search;
mod sized;
mod split;
mod target;
mod within;

pub(crate) use reach::reached;
pub use split::{SizeTry, Split};
pub use target::{Goal, Target};
