//! What counts as a feature, and what is no valid question.

use mesh_core::{Topology, TriMesh, VertexId};
use region_map::NetworkError;

/// What counts as a feature.
#[derive(Clone, Debug, PartialEq)]
pub struct FeatureOptions {
    /// An edge with at least this dihedral angle (degrees between the normals of its faces, above 0 and at most 180) is a crease. At 180
    /// no edge is one. Default 40.
    pub strong_angle: f64,
    /// An edge with at least this dihedral angle continues a crease from its loose end, in degrees, above 0 and at most `strong_angle`.
    /// Default 25.
    pub weak_angle: f64,
    /// Factor on the persistence (length times strength) below which creases are left out as minor, not negative; infinite leaves out
    /// every crease that may be left out. Default 1.
    pub persistence: f64,
    /// A strip of weak edges, as of a small fillet, is a crease, too, where the surface turns by `strong_angle` within this width, in the units of
    /// the mesh, not negative, finite. Default 0, for none.
    pub rounded_width: f64,
}

impl Default for FeatureOptions {
    fn default() -> Self {
        Self { strong_angle: 40.0, weak_angle: 25.0, persistence: 1.0, rounded_width: 0.0 }
    }
}

impl FeatureOptions {
    /// The strong angle without creases, in degrees: not even where a face lies on its neighbour, which is an angle of 180.
    pub const NO_CREASES: f64 = 180.0;

    /// Checks the ranges: `0 < weak_angle <= strong_angle <= 180` and `0 <= persistence`.
    pub fn check(&self) -> Result<(), FeatureError> {
        let Self { strong_angle: strong, weak_angle: weak, persistence, rounded_width } = *self;
        if !(weak > 0.0 && weak <= strong && strong <= Self::NO_CREASES) {
            return Err(FeatureError::Angles { strong, weak });
        }
        if persistence.is_nan() || persistence < 0.0 {
            return Err(FeatureError::Persistence(persistence));
        }
        if !(rounded_width.is_finite() && rounded_width >= 0.0) {
            return Err(FeatureError::RoundedWidth(rounded_width));
        }
        Ok(())
    }

    /// Whether there can be creases: the strong angle is below 180 degrees.
    pub fn finds_creases(&self) -> bool {
        self.strong_angle < Self::NO_CREASES
    }

    /// Is an edge of this dihedral angle (degrees) a crease by itself?
    pub(crate) fn is_strong(&self, angle: f64) -> bool {
        self.finds_creases() && angle >= self.strong_angle
    }
}

/// Why there is no network.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FeatureError {
    /// The angles are out of range or order.
    #[error(
        "crease angles {strong} (strong) and {weak} (weak) must satisfy 0 < weak <= strong <= 180 (degrees); 180 finds no creases"
    )]
    Angles {
        /// The angle that makes a crease.
        strong: f64,
        /// The angle that continues one.
        weak: f64,
    },
    /// The factor on the persistence is negative or not a number.
    #[error("the factor {0} on the persistence of creases must not be negative")]
    Persistence(f64),
    /// The width of rounded creases is negative or not a number.
    #[error("the width {0} of rounded creases must be finite and not negative")]
    RoundedWidth(f64),
    /// The base edge length is negative or not a number.
    #[error("base edge length {0} must be finite and not negative")]
    BaseEdgeLength(f64),
    /// A marked pair of vertices is not joined by an edge.
    #[error("marked vertices {0} and {1} are not joined by an edge of this mesh")]
    NotAnEdge(VertexId, VertexId),
    /// The topology joins other vertices than the faces of the mesh do.
    #[error("the topology is of another mesh")]
    OtherMesh,
    /// The network could not be traced.
    #[error(transparent)]
    Network(#[from] NetworkError),
}

/// Checks that a topology is that of a mesh.
pub(crate) fn check_same_mesh(mesh: &TriMesh, topology: &Topology) -> Result<(), FeatureError> {
    let is_same = topology.n_vertices() == mesh.n_vertices() && topology.faces() == mesh.faces();
    if is_same { Ok(()) } else { Err(FeatureError::OtherMesh) }
}
