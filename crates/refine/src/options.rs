//! How far to refine, and why refining fails.

use mesh_core::{MeshError, TopologyError};

/// How far to refine.
#[derive(Clone, Debug, PartialEq)]
pub struct RefineOptions {
    /// Edges longer than this are halved, in the units of the mesh, positive. Infinite: none.
    pub longest_edge: f64,
    /// Creases, borders and marked edges shorter than this are contracted, in the units of the mesh, not negative. Default 0: none.
    pub shortest_edge: f64,
    /// An edge with a greater dihedral angle (degrees between the normals of its faces, 0 to 180) is a crease, for the contraction of short
    /// ones. Default 40.
    pub crease_angle: f64,
    /// Most faces that splitting may lead to; the longest edges come first. Default: four for each input face and 200,000 more.
    pub most_faces: Option<usize>,
    /// How far a flip may move the surface, as a share of the diagonal of the box. Default 1e-7: what single precision does to
    /// planes, and a hundredth of the mean error of a good result.
    pub flatness: f64,
}

impl RefineOptions {
    /// The defaults for a longest edge.
    pub fn new(longest_edge: f64) -> Self {
        Self { longest_edge, shortest_edge: 0.0, crease_angle: 40.0, most_faces: None, flatness: 1e-7 }
    }
}

/// Faults of ours: refining keeps a manifold a manifold.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RefineError {
    /// The refined faces are no mesh.
    #[error("refining broke the mesh, please report this: {0}")]
    Mesh(#[from] MeshError),
    /// The refined faces are no manifold.
    #[error("refining broke the connectivity, please report this: {0}")]
    Topology(#[from] TopologyError),
}
