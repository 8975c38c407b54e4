//! Where the base vertices shall be: on arcs by arc length, inside patches by centroidal Voronoi relaxation (paper, section 3.2).
//!
//! [`sample`] takes the cells of a segmentation and a number of base vertices, and returns [`region_map::Sites`].

mod arc_measure;
mod budget;
mod candidates;
mod kd_tree;
mod lloyd;
mod options;
mod sample;
mod sizing;

pub use budget::Budget;
pub use options::CvtOptions;
pub use sample::{CvtError, Sampled, sample};
pub use sizing::SizingField;
