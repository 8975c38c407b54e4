//! Regional projection: every domain vertex onto the surface, by its class (paper, section 4.2).
//!
//! Corners stay. Vertices on arcs go to their arc length. Vertices inside a sheet are placed by the bijective map of the base mesh,
//! where there is one, and the paper's ray along the domain normal may then improve the place; without a map the ray comes first, and
//! where it misses, the nearest point of the sheet.

mod place;
mod project;
mod ray;

pub use place::Origins;
pub use project::{ProjectError, ProjectOptions, ProjectReport, Projected, project};
