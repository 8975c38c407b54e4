//! The feature network of a working mesh.

use crate::corner::{cone_tips, sharp_turns};
use crate::crease::{Creases, Kinds};
use crate::gaps::close_gaps;
use crate::narrow::cut_narrow_tips;
use crate::options::{FeatureError, FeatureOptions, check_same_mesh};
use crate::rounded::rounded_creases;
use crate::simplify::simplify;
use crate::touching::Touching;
use mesh_core::{EdgeId, IdVec, Topology, TriMesh, VertexId};
use region_map::{ArcKind, Network, NetworkError};

/// Single points where the surface touches itself are corners, unless there are more than this share of the base vertices: those of a broken scan
/// would be the whole base mesh.
const TOUCHING_SHARE: f64 = 0.02;

/// Finds creases, borders and marked edges, simplifies them and sets the corners.
///
/// - `marked`: edges that are features whatever their angle, and are never dropped, as pairs of vertices of this mesh, in any order.
/// - `base_edge_length`: the length of an edge of the base mesh, in the units of the mesh: the resolution at which the network is
///   simplified. 0 keeps every crease.
///
/// Borders, marked edges and lines where sheets touch are always in the network. Creases that are too small or too weak at the base resolution are in
/// [`Network::minor`].
///
/// Fails where an option is out of its range, the topology is of another mesh, or a marked pair is no edge.
pub fn detect(
    mesh: &TriMesh,
    topology: &Topology,
    marked: &[[VertexId; 2]],
    base_edge_length: f64,
    options: &FeatureOptions,
) -> Result<Network, FeatureError> {
    options.check()?;
    if !(base_edge_length.is_finite() && base_edge_length >= 0.0) {
        return Err(FeatureError::BaseEdgeLength(base_edge_length));
    }
    check_same_mesh(mesh, topology)?;
    let mut creases = Creases::find(mesh, topology, options);
    if options.rounded_width > 0.0 && options.finds_creases() {
        let rounded = rounded_creases(mesh, topology, &creases, options.rounded_width, options.strong_angle);
        rounded.into_iter().for_each(|(e, angle)| creases.add(e, angle));
    }
    let mut kinds = creases.kinds(topology);
    for e in marked_edges(topology, marked)? {
        if !topology.is_border_edge(e) {
            kinds[e] = Some(ArcKind::Marked);
        }
    }
    let touching = Touching::find(mesh, topology);
    for e in touching.lines().filter(|&e| !topology.is_border_edge(e)) {
        kinds[e] = Some(ArcKind::Marked);
    }
    let minor = simplify(mesh, topology, &creases, &mut kinds, base_edge_length, options.persistence)?;
    let mut network = cut_narrow_tips(mesh, topology, &mut kinds, base_edge_length)?;
    if close_gaps(mesh, topology, &mut kinds, base_edge_length) {
        network = Network::trace(mesh, topology, &kinds, |_| false, Vec::new())?;
    }
    let is_corner = corners(mesh, topology, &kinds, &network, &touching, base_edge_length)?;
    Ok(Network::trace(mesh, topology, &kinds, |v| is_corner[v], minor)?)
}

fn marked_edges(topology: &Topology, marked: &[[VertexId; 2]]) -> Result<Vec<EdgeId>, FeatureError> {
    let in_range = |v: VertexId| (v.0 as usize) < topology.n_vertices();
    let find = |&[a, b]: &[VertexId; 2]| {
        let edge = if in_range(a) && in_range(b) { topology.find_edge(a, b) } else { None };
        edge.ok_or(FeatureError::NotAnEdge(a, b))
    };
    marked.iter().map(find).collect()
}

/// Corners beyond those of degree other than 2, which alone the network has: sharp turns, cone tips, and those where the surface touches itself.
fn corners(
    mesh: &TriMesh,
    topology: &Topology,
    kinds: &Kinds,
    network: &Network,
    touching: &Touching<'_>,
    base_edge_length: f64,
) -> Result<IdVec<VertexId, bool>, NetworkError> {
    let traced = |is_corner: &IdVec<VertexId, bool>| Network::trace(mesh, topology, kinds, |v| is_corner[v], Vec::new());
    let mut is_corner = IdVec::filled(false, topology.n_vertices());
    for v in sharp_turns(mesh, network, base_edge_length) {
        is_corner[v] = true;
    }
    for v in cone_tips(mesh, topology, kinds) {
        is_corner[v] = true;
    }
    touching.set_corners(&mut is_corner, most_touching(mesh, base_edge_length), traced)?;
    Ok(is_corner)
}

/// [`TOUCHING_SHARE`] of the vertices of a closed base mesh with equilateral triangles; all of a surface where its edges have no length.
fn most_touching(mesh: &TriMesh, base_edge_length: f64) -> usize {
    let triangles = mesh.total_area() / (0.25 * 3f64.sqrt() * base_edge_length * base_edge_length);
    if base_edge_length > 0.0 { (TOUCHING_SHARE * 0.5 * triangles) as usize } else { usize::MAX }
}
