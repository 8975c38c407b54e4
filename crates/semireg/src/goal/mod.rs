//! Results of a size or an error that the user names: how many base vertices and levels that takes.

mod search;
mod sized;
mod split;
mod target;
mod within;

pub use search::SizeTry;
pub(crate) use search::reached;
pub use split::Split;
pub use target::{Goal, Target};
