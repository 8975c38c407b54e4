//! An independent check of a finished semi-regular mesh: from its faces and positions alone, with code that shares nothing with
//! the stages that made it.
//!
//! [`certify`] says whether a mesh may be called good; [`measure`] compares any two meshes; the other functions are their parts.
//!
//! ```
//! use certify::{MeasureOptions, certify};
//! use mesh_core::TriMesh;
//!
//! // A triangle, and its one subdivision in the order of `connectivity`.
//! let corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
//! let middles = [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
//! let points = |p: &[[f64; 3]]| p.iter().map(|&p| p.into()).collect::<Vec<_>>();
//! let input = TriMesh::new(points(&corners), vec![[0, 1, 2]])?;
//! let faces = vec![[0, 3, 5], [1, 4, 3], [2, 5, 4], [4, 5, 3]];
//! let output = TriMesh::new(points(&[corners, middles].concat()), faces)?;
//!
//! let certificate = certify(&input, &output, 1, &MeasureOptions::default())?;
//! assert!(certificate.passed(), "{:?}", certificate.failures());
//! assert!(certificate.measures.distance.worse().max < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod certificate;
mod component_counts;
mod connectivity;
mod creases;
mod distance;
mod edges;
mod intersections;
mod measures;
mod orientation;
mod quality;
mod sampling;
mod surface;
#[cfg(test)]
mod test_shapes;
mod topology;
mod triangle_pair;
mod union_find;
mod weld;

pub use certificate::{Certificate, Failure, Warning, certify};
pub use component_counts::{ComponentCounts, component_counts};
pub use connectivity::{ConnectivityError, Hierarchy, LevelCounts, connectivity};
pub use creases::{COVER_DISTANCE, CreaseCover, ORIGINAL_CREASE_DEGREES, REMESHED_CREASE_DEGREES, border_distance, crease_cover};
pub use distance::{DEFAULT_SAMPLES, Distance, Stats, distance};
pub use intersections::self_intersecting;
pub use measures::{MeasureError, MeasureOptions, Measures, Topologies, measure};
pub use orientation::flipped;
pub use quality::{DEGENERATE_ASPECT_RATIO, Quality, quality};
pub use surface::{NoSurface, Surface};
pub use topology::TopologyCounts;
pub use weld::weld;
