//! Triangle meshes as every stage sees them: typed ids, connectivity without positions, measures, cleaning,
//! closest points and rays, and walks over a surface.
//!
//! ```
//! use glam::DVec3;
//! use mesh_core::{CleanOptions, Soup, SurfaceIndex, clean};
//!
//! // A tetrahedron as plain arrays: one corner is there twice, and one face is turned over.
//! let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]];
//! let soup = Soup::from_slices(&corners, &[[0, 2, 1], [4, 1, 3], [0, 3, 2], [1, 3, 2]]);
//! let cleaned = clean(&soup, &CleanOptions::default())?;
//! assert_eq!((cleaned.report.merged_exactly, cleaned.report.turned), (1, 1));
//! assert_eq!((cleaned.topology.euler(), cleaned.topology.genus()), (2, 0));
//! assert_eq!(cleaned.mesh.face_arrays(), [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]);
//!
//! let closest = SurfaceIndex::new(&cleaned.mesh).closest(DVec3::new(0.2, 0.2, -1.0)).unwrap();
//! assert_eq!((closest.distance, closest.face.0), (1.0, 0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod clean;
pub mod exact;
mod face_sets;
mod face_tree;
mod filling;
mod id;
mod inspect;
mod interrupt;
mod layout;
mod leaving;
mod limits;
mod measure;
mod partition;
mod place;
mod polyline;
mod surface_index;
mod surface_point;
mod topology;
mod tri_mesh;
mod triangle;
mod walk;
mod ways;

pub use clean::{CleanError, CleanOptions, CleanReport, Cleaned, clean, clean_until};
pub use filling::cheapest_filling;
pub use id::{EdgeId, FaceId, HalfedgeId, Id, IdVec, VertexId};
pub use inspect::{Inspection, inspect};
pub use interrupt::Interrupt;
pub use measure::{Bounds, angles, area, aspect_ratio, equilateral_edge_length, inverse_mean_ratio, normal, vector_area};
pub use place::{Place, place};
pub use polyline::{Foot, Polyline};
pub use surface_index::{Closest, Hit, SHEET_DISTANCE, SurfaceIndex};
pub use surface_point::SurfacePoint;
pub use topology::{Topology, TopologyError};
pub use tri_mesh::{MeshError, Soup, TriMesh};
pub use triangle::{Line, barycentric, closest_on_segment, closest_on_triangle, distance_to_segment};
pub use walk::{Walked, walk, walk_end};
pub use ways::ways_around;
