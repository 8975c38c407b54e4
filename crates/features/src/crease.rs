//! Creases by dihedral angle with hysteresis.

use crate::options::FeatureOptions;
use glam::DVec3;
use mesh_core::{EdgeId, IdVec, Topology, TriMesh, VertexId};
use region_map::{ArcKind, spokes};

/// What every edge is in the network; `None` where it is not in it.
pub(crate) type Kinds = IdVec<EdgeId, Option<ArcKind>>;

/// A crease goes on over weak edges that turn by less than 60 degrees, which is what a triangulation without an edge along the
/// crease needs.
const MAX_TURN_COSINE: f64 = 0.5;

/// Dihedral angles of all edges, and which of them are creases.
pub(crate) struct Creases {
    /// Angle between the normals of the two faces, in degrees; 0 on the border and beside a face without area.
    pub(crate) angle: IdVec<EdgeId, f64>,
    is_crease: IdVec<EdgeId, bool>,
}

impl Creases {
    /// Strong edges, and weak ones that continue a crease from its loose end.
    pub(crate) fn find(mesh: &TriMesh, topology: &Topology, options: &FeatureOptions) -> Self {
        let angle = dihedral_angles(mesh, topology);
        let is_crease = angle.iter().map(|&a| options.is_strong(a)).collect();
        let mut creases = Self { angle, is_crease };
        let mut ends: Vec<VertexId> = mesh.positions().ids().collect();
        while let Some(v) = ends.pop() {
            if let Some(next) = creases.continuation(mesh, topology, v, options.weak_angle) {
                creases.is_crease[next] = true;
                ends.extend(topology.ends(next));
            }
        }
        creases
    }

    /// The weak edge of greatest angle that goes on from a crease with a loose end at `v`. Elsewhere weak edges don't count: on
    /// the rim of a coarse cylinder, all edges of its side would continue the rim.
    fn continuation(&self, mesh: &TriMesh, topology: &Topology, v: VertexId, weak_angle: f64) -> Option<EdgeId> {
        let mut creases = spokes(topology, v).map(|h| topology.edge(h)).filter(|&e| self.is_crease[e]);
        let (Some(end), None) = (creases.next(), creases.next()) else { return None };
        if topology.is_border_vertex(v) {
            return None;
        }
        let away = |e: EdgeId| away(mesh, topology, e, v);
        let goes_on = |e: EdgeId| away(e).dot(-away(end)) > MAX_TURN_COSINE;
        let weak = spokes(topology, v)
            .map(|h| topology.edge(h))
            .filter(|&e| !self.is_crease[e] && self.angle[e] >= weak_angle && goes_on(e));
        weak.max_by(|&e, &f| self.angle[e].total_cmp(&self.angle[f]).then(f.cmp(&e)))
    }

    pub(crate) fn is_crease(&self, e: EdgeId) -> bool {
        self.is_crease[e]
    }

    /// Takes an edge for a crease on which the surface turns by so many degrees.
    pub(crate) fn add(&mut self, e: EdgeId, angle: f64) {
        (self.is_crease[e], self.angle[e]) = (true, angle);
    }

    /// Kinds of all edges: borders and creases.
    pub(crate) fn kinds(&self, topology: &Topology) -> Kinds {
        let kind = |e: EdgeId| match (topology.is_border_edge(e), self.is_crease[e]) {
            (true, _) => Some(ArcKind::Border),
            (false, true) => Some(ArcKind::Sharp),
            (false, false) => None,
        };
        topology.edge_ids().map(kind).collect()
    }
}

/// Unit vector along an edge, away from one of its ends.
pub(crate) fn away(mesh: &TriMesh, topology: &Topology, e: EdgeId, v: VertexId) -> DVec3 {
    let [a, b] = topology.ends(e);
    (mesh.position(if a == v { b } else { a }) - mesh.position(v)).normalize_or_zero()
}

/// Whether a vertex is on the network.
pub(crate) fn is_on_network(topology: &Topology, kinds: &Kinds, v: VertexId) -> bool {
    spokes(topology, v).any(|h| kinds[topology.edge(h)].is_some())
}

fn dihedral_angles(mesh: &TriMesh, topology: &Topology) -> IdVec<EdgeId, f64> {
    let normals = mesh.normals();
    let angle = |e: EdgeId| match topology.edge_faces(e) {
        (f, Some(g)) => normals[f].cross(normals[g]).length().atan2(normals[f].dot(normals[g])).to_degrees(),
        (_, None) => 0.0,
    };
    topology.edge_ids().map(angle).collect()
}
