//! The feature network of a working mesh.

use crate::corner::{cone_tips, sharp_turns};
use crate::crease::Creases;
use crate::simplify::simplify;
use mesh_core::{EdgeId, IdVec, Topology, TriMesh, VertexId};
use region_map::{ArcKind, Network};

/// What counts as a feature.
#[derive(Clone, Debug, PartialEq)]
pub struct FeatureOptions {
    /// An edge with at least this dihedral angle (degrees between the normals of its faces, 0 to 180) is a crease. Default 40.
    pub strong_angle: f64,
    /// An edge with at least this dihedral angle continues a crease from its loose end, in degrees; at most `strong_angle`.
    /// Default 25.
    pub weak_angle: f64,
    /// Length of an edge of the base mesh, in the units of the mesh: the resolution at which the network is simplified.
    /// 0 keeps every crease. Default 0.
    pub base_edge_length: f64,
    /// Factor on the persistence (length times strength) below which creases are left out as minor, not negative.
    /// Default 1.
    pub persistence: f64,
    /// Edges that are features whatever their angle, and are never dropped, as pairs of vertices.
    pub marked: Vec<[VertexId; 2]>,
}

impl Default for FeatureOptions {
    fn default() -> Self {
        Self { strong_angle: 40.0, weak_angle: 25.0, base_edge_length: 0.0, persistence: 1.0, marked: Vec::new() }
    }
}

/// Why options do not fit a mesh.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FeatureError {
    /// The angles are out of range or order.
    #[error("crease angles {strong} and {weak} must satisfy 0 < weak <= strong <= 180 (degrees)")]
    Angles {
        /// The angle that makes a crease.
        strong: f64,
        /// The angle that continues one.
        weak: f64,
    },
    /// The base edge length is negative or not a number.
    #[error("base edge length {0} must be finite and not negative")]
    BaseEdgeLength(f64),
    /// A marked pair of vertices is not joined by an edge.
    #[error("marked vertices {0} and {1} are not joined by an edge; mark edges of the cleaned mesh")]
    NotAnEdge(VertexId, VertexId),
}

/// Finds creases, borders and marked edges, simplifies them and sets the corners.
///
/// Borders and marked edges are always in the network. Creases that are too small or too weak at the base resolution
/// are in [`Network::minor`].
pub fn detect(mesh: &TriMesh, topology: &Topology, options: &FeatureOptions) -> Result<Network, FeatureError> {
    check(options)?;
    let creases = Creases::find(mesh, topology, options);
    let mut kinds = creases.kinds(topology);
    for e in marked_edges(topology, options)? {
        if !topology.is_border_edge(e) {
            kinds[e] = Some(ArcKind::Marked);
        }
    }
    let minor = simplify(mesh, topology, &creases, &mut kinds, options);
    let is_corner = corners(mesh, topology, &kinds, options.base_edge_length);
    Ok(Network::trace(mesh, topology, &kinds, |v| is_corner[v], minor))
}

fn check(options: &FeatureOptions) -> Result<(), FeatureError> {
    let FeatureOptions { strong_angle: strong, weak_angle: weak, base_edge_length: length, .. } = *options;
    if !(weak > 0.0 && weak <= strong && strong <= 180.0) {
        return Err(FeatureError::Angles { strong, weak });
    }
    if !(length.is_finite() && length >= 0.0) {
        return Err(FeatureError::BaseEdgeLength(length));
    }
    Ok(())
}

fn marked_edges(topology: &Topology, options: &FeatureOptions) -> Result<Vec<EdgeId>, FeatureError> {
    let in_range = |v: VertexId| (v.0 as usize) < topology.n_vertices();
    let find = |&[a, b]: &[VertexId; 2]| {
        let edge = if in_range(a) && in_range(b) { topology.find_edge(a, b) } else { None };
        edge.ok_or(FeatureError::NotAnEdge(a, b))
    };
    options.marked.iter().map(find).collect()
}

/// Corners beyond those of degree other than 2: sharp turns and cone tips.
fn corners(
    mesh: &TriMesh,
    topology: &Topology,
    kinds: &IdVec<EdgeId, Option<ArcKind>>,
    base_edge_length: f64,
) -> IdVec<VertexId, bool> {
    let network = Network::trace(mesh, topology, kinds, |_| false, Vec::new());
    let mut is_corner = IdVec::filled(false, topology.n_vertices());
    for v in sharp_turns(mesh, &network, base_edge_length) {
        is_corner[v] = true;
    }
    for v in cone_tips(mesh, topology, kinds) {
        is_corner[v] = true;
    }
    is_corner
}
