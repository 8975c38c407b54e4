//! Triangle meshes as every stage sees them: typed ids, connectivity without positions, measures, cleaning,
//! closest points and rays, and walks over a surface.

mod clean;
pub mod exact;
mod id;
mod inspect;
mod measure;
mod partition;
mod surface_index;
mod surface_point;
mod topology;
mod tri_mesh;
mod triangle;
mod walk;

pub use clean::{CleanError, CleanOptions, CleanReport, Cleaned, clean};
pub use id::{EdgeId, FaceId, HalfedgeId, Id, IdVec, VertexId};
pub use inspect::{Inspection, inspect};
pub use measure::{Bounds, angles, area, aspect_ratio, normal, vector_area};
pub use surface_index::{Closest, Hit, SurfaceIndex};
pub use surface_point::SurfacePoint;
pub use topology::{Topology, TopologyError};
pub use tri_mesh::{MeshError, Soup, TriMesh};
pub use triangle::{Line, closest_on_segment, closest_on_triangle};
pub use walk::{Walked, walk};
