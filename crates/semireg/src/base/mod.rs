//! From the working mesh to base meshes: the paper's way by patches (improved, or as it is printed), by decimation, or one that the user gives.

mod decimation;
mod given;
mod ground;
mod paper;
mod patches;
mod proposals;
mod rating;
mod search;
mod setting;
mod stages;
mod way;

pub(crate) use given::given;
pub(crate) use paper::paper;
pub use patches::Patches;
pub(crate) use proposals::Proposals;
pub(crate) use setting::Setting;
pub use stages::{Base, BaseCounts, BaseStages, CellCounts};
pub use way::{Method, Way};
