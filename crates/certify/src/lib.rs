//! An independent check of a finished semi-regular mesh: from its faces and positions alone, with code that shares nothing with
//! the stages that made it.
//!
//! [`certify`] says whether a mesh may be called good; [`measure`] compares any two meshes; [`faulty_faces`] tells in the middle of
//! the work which triangles would be refused. All of them see the input as a [`Reference`], which is made once. The other functions
//! are their parts.
//!
//! ```
//! use certify::{MeasureOptions, Reference, certify};
//! use mesh_core::TriMesh;
//!
//! // A triangle, and its one subdivision in the order of `connectivity`.
//! let corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
//! let middles = [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
//! let input = TriMesh::from_slices(&corners, &[[0, 1, 2]])?;
//! let faces = [[0, 3, 5], [1, 4, 3], [2, 5, 4], [4, 5, 3]];
//! let output = TriMesh::from_slices(&[corners, middles].concat(), &faces)?;
//!
//! let certificate = certify(&Reference::new(input)?, &output, 1, &MeasureOptions::default())?;
//! assert!(certificate.passed(), "{:?}", certificate.failures());
//! assert!(certificate.measures.distance.worse().max < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod apart;
mod certificate;
mod component_counts;
mod connectivity;
mod creases;
mod distance;
mod edges;
mod error;
mod faults;
mod intersections;
mod measures;
mod missed;
mod new_cuts;
mod own_cuts;
mod quality;
mod reference;
mod sampling;
mod sharp;
mod shortcoming;
#[cfg(test)]
mod test_shapes;
mod topology;
mod triangle_pair;
mod union_find;
mod weld;

pub use certificate::{Certificate, Failure, Warning, certify};
pub use component_counts::{ComponentCounts, component_counts};
pub use connectivity::{ConnectivityError, Hierarchy, LevelCounts, connectivity};
pub use creases::{COVER_DISTANCE, CreaseCover, ORIGINAL_CREASE_DEGREES, REMESHED_CREASE_DEGREES};
pub use distance::{DEFAULT_SAMPLES, Distance, Stats};
pub use error::{MeasureError, NoSurface};
pub use faults::{Faults, faulty_faces, faulty_faces_among, flipped};
pub use intersections::self_intersecting;
pub use measures::{MeasureOptions, Measures, measure};
pub use missed::{Missed, missed};
pub use new_cuts::new_cuts;
pub use quality::{DEGENERATE_ASPECT_RATIO, Quality, quality};
pub use reference::Reference;
pub use sharp::{ACCEPTED_SHARP_COVER, SharpCover, SharpEdges, mean_edge};
pub use shortcoming::{ACCEPTED_LEAST_SHAPE, ACCEPTED_MEAN_SHAPE, Shortcoming, accepted_distance};
pub use topology::{Topologies, TopologyCounts};
pub use weld::weld;
