//! Creases, corners and borders of a mesh as a network of arcs, simplified at the resolution of the base mesh.
//!
//! [`detect`] is the one verb: it finds creases by dihedral angle with hysteresis, adds borders and marked edges, takes out
//! what is too small or too weak to be worth base vertices, and sets the corners.

mod corner;
mod crease;
mod detect;
mod simplify;
mod strands;

pub use detect::{FeatureError, FeatureOptions, detect};
