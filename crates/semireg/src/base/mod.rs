//! From the working mesh to base meshes: the paper's way by patches, by decimation, or one that the user gives.

mod candidates;
mod decimation;
mod given;
mod patches;
mod rating;
mod search;
mod setting;
mod stages;
mod way;

pub(crate) use candidates::candidates;
pub use patches::Patches;
pub(crate) use setting::Setting;
pub use stages::{Base, BaseCounts, BaseStages, CellCounts};
pub use way::Way;
