//! The base mesh: every patch charted onto a convex polygon, its sites joined by a constrained Delaunay triangulation there, all
//! patches joined to one simplicial mesh with a bijective map to the input (paper, section 3.2), and its connectivity improved.

mod assemble;
mod build;
mod chart;
mod editor;
mod error;
mod improve;
mod layout;
mod patch_cdt;
mod piece_mesh;
mod polygon;
mod shape;
#[cfg(test)]
mod shapes;
#[cfg(test)]
mod tests;
mod tutte;

pub use build::{BaseOptions, build};
pub use error::BaseError;
