//! Creases by dihedral angle with hysteresis.

use crate::FeatureOptions;
use mesh_core::{EdgeId, HalfedgeId, IdVec, Topology, TriMesh, VertexId};
use region_map::ArcKind;

/// Dihedral angles of all edges, and which of them are creases.
pub(crate) struct Creases {
    /// Angle between the normals of the two faces, in degrees; 0 on the border and beside a face without area.
    pub(crate) angle: IdVec<EdgeId, f64>,
    is_crease: IdVec<EdgeId, bool>,
}

impl Creases {
    /// Strong edges, and weak ones that are connected to a strong one by weak ones.
    pub(crate) fn find(mesh: &TriMesh, topology: &Topology, options: &FeatureOptions) -> Self {
        let angle = dihedral_angles(mesh, topology);
        let mut is_crease: IdVec<EdgeId, bool> = angle.iter().map(|&a| a >= options.strong_angle).collect();
        let mut stack: Vec<EdgeId> = topology.edge_ids().filter(|&e| is_crease[e]).collect();
        while let Some(e) = stack.pop() {
            for v in topology.ends(e) {
                for next in edges_at(topology, v) {
                    if !is_crease[next] && angle[next] >= options.weak_angle {
                        is_crease[next] = true;
                        stack.push(next);
                    }
                }
            }
        }
        Self { angle, is_crease }
    }

    /// Kinds of all edges: borders and creases.
    pub(crate) fn kinds(&self, topology: &Topology) -> IdVec<EdgeId, Option<ArcKind>> {
        let kind = |e: EdgeId| match (topology.is_border_edge(e), self.is_crease[e]) {
            (true, _) => Some(ArcKind::Border),
            (false, true) => Some(ArcKind::Sharp),
            (false, false) => None,
        };
        topology.edge_ids().map(kind).collect()
    }
}

fn dihedral_angles(mesh: &TriMesh, topology: &Topology) -> IdVec<EdgeId, f64> {
    let normals = mesh.normals();
    let angle = |e: EdgeId| match topology.edge_faces(e) {
        (f, Some(g)) => normals[f].cross(normals[g]).length().atan2(normals[f].dot(normals[g])).to_degrees(),
        (_, None) => 0.0,
    };
    topology.edge_ids().map(angle).collect()
}

/// The edges at a vertex, counter-clockwise.
pub(crate) fn edges_at(topology: &Topology, v: VertexId) -> impl Iterator<Item = EdgeId> + '_ {
    let last = topology.fan(v).last().map(HalfedgeId::prev).filter(|&h| topology.twin(h).is_none());
    topology.fan(v).chain(last).map(|h| topology.edge(h))
}
