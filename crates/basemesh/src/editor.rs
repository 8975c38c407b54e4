//! A base mesh that can be changed: flip, split, move and take away a vertex, each recorded in the base map.

mod checkpoint;
mod edges;
mod layout;
mod lengths;
mod mesh;
mod moves;
mod removal;
mod replace;
mod samples;
mod star;

pub(crate) use checkpoint::Checkpoint;
pub(crate) use mesh::Editor;
pub(crate) use removal::{Filling, Hole, Removal};
pub(crate) use star::{Face, signed_quality};
