//! How far to refine, and why refining fails.

use mesh_core::{MeshError, TopologyError, VertexId};

/// How far to refine.
#[derive(Clone, Debug, PartialEq)]
pub struct RefineOptions {
    /// Edges longer than this are halved, in the units of the mesh, positive. Infinite: none.
    pub longest_edge: f64,
    /// Creases, borders and marked edges shorter than this are contracted, and triangles lower than this are flipped away, in the units of the
    /// mesh, not negative. Default 0: none.
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

impl RefineOptions {
    /// Checks the ranges.
    pub(crate) fn check(&self) -> Result<(), RefineError> {
        let Self { longest_edge, shortest_edge, crease_angle, flatness, .. } = *self;
        let rules = [
            ("longest_edge", longest_edge, longest_edge > 0.0, "above 0"),
            ("shortest_edge", shortest_edge, shortest_edge >= 0.0, "at least 0"),
            ("crease_angle", crease_angle, (0.0..=180.0).contains(&crease_angle), "0 to 180 (degrees)"),
            ("flatness", flatness, flatness >= 0.0, "at least 0"),
        ];
        match rules.into_iter().find(|&(_, _, is_kept, _)| !is_kept) {
            Some((option, value, _, range)) => Err(RefineError::Option { option, value, range }),
            None => Ok(()),
        }
    }

    /// Most faces that splitting may lead to, as long as ids of halfedges can be told apart.
    pub(crate) fn most_faces(&self, n_faces: usize) -> usize {
        let most = self.most_faces.unwrap_or(FACES_PER_FACE * n_faces + SPARE_FACES);
        most.min((u32::MAX / 3) as usize)
    }
}

/// See [`RefineOptions::most_faces`]. Fewer leave long edges in large inputs, more take memory and time from inputs of needles.
const FACES_PER_FACE: usize = 4;
/// See [`RefineOptions::most_faces`]: so that a box of twelve triangles may be refined for any base mesh.
const SPARE_FACES: usize = 200_000;

/// Why a mesh is not refined.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RefineError {
    /// An option is out of its range.
    #[error("refining option {option} is {value}, it must be {range}")]
    Option {
        /// The name of the option.
        option: &'static str,
        /// Its value.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// The topology joins other vertices than the faces of the mesh do.
    #[error("the topology is of another mesh")]
    OtherMesh,
    /// A marked pair of vertices is not joined by an edge.
    #[error("marked vertices {0} and {1} are not joined by an edge of this mesh")]
    NotAnEdge(VertexId, VertexId),
    /// The refined faces are no mesh: a fault of ours, or coordinates so large that the middle of an edge is no number.
    #[error("refining broke the mesh, please report this: {0}")]
    Mesh(#[from] MeshError),
    /// The refined faces are no manifold: a fault of ours, as refining keeps a manifold a manifold.
    #[error("refining broke the connectivity, please report this: {0}")]
    Topology(#[from] TopologyError),
}
