//! By how much the surface turns at an edge, measured over regions that are larger than the noise of a scan.
//!
//! A dihedral angle is one of two triangles, and on a scan one of two noisy ones. The mean normals of a small region on each side tell
//! creases from noise, where they are the same, and from round ridges, where they go on turning on both sides.

use glam::DVec3;
use mesh_core::{EdgeId, FaceId, Topology, TriMesh, vector_area};
use region_map::Network;
use rustc_hash::FxHashSet;
use std::collections::VecDeque;

/// Radius of the region on each side, in base edge lengths.
const REACH: f64 = 0.25;
/// Cosine of the angle to the first face of a region up to which faces belong to it: all round a pin, normals would cancel.
const MOST_TURN: f64 = 0.5;
/// Faces of a region at most, for inputs much finer than their base mesh.
const MOST_FACES: usize = 200;

/// Regions beside the edges of a network.
pub(crate) struct Jumps<'a> {
    pub(crate) mesh: &'a TriMesh,
    pub(crate) topology: &'a Topology,
    pub(crate) network: &'a Network,
    pub(crate) base_edge_length: f64,
}

impl Jumps<'_> {
    /// By how many degrees the mean normals near both sides of an edge differ, less what they turn by within the sides, farther from the
    /// edge; 0 at least, and on the border.
    pub(crate) fn at(&self, e: EdgeId) -> f64 {
        let (f, Some(g)) = self.topology.edge_faces(e) else { return 0.0 };
        let [a, b] = self.topology.ends(e).map(|v| self.mesh.position(v));
        let [(m, m_far), (n, n_far)] = [f, g].map(|face| self.mean_normals(face, 0.5 * (a + b)));
        (m.angle_between(n) - m.angle_between(m_far) - n.angle_between(n_far)).to_degrees().max(0.0)
    }

    /// Mean normals of the faces within the reach of a middle, and within twice the reach but not nearer; where there is none of
    /// these, the former again. Other arcs of the network end the region.
    fn mean_normals(&self, first: FaceId, middle: DVec3) -> (DVec3, DVec3) {
        let reach = REACH * self.base_edge_length;
        let (mut near, mut far) = (DVec3::ZERO, DVec3::ZERO);
        let normal = self.mesh.normal(first);
        let mut seen = FxHashSet::from_iter([first]);
        let mut queue = VecDeque::from([first]);
        while let Some(f) = queue.pop_front() {
            let sum = if f == first || self.mesh.centroid(f).distance(middle) <= reach { &mut near } else { &mut far };
            *sum += vector_area(self.mesh.triangle(f));
            for h in self.topology.halfedges(f) {
                let Some(g) = self.topology.twin(h).map(|twin| twin.face()) else { continue };
                let is_near =
                    self.mesh.centroid(g).distance(middle) <= 2.0 * reach && self.mesh.normal(g).dot(normal) >= MOST_TURN;
                let may_enter = is_near && !self.network.is_barrier(self.topology.edge(h)) && seen.len() < MOST_FACES;
                if may_enter && seen.insert(g) {
                    queue.push_back(g);
                }
            }
        }
        let near = near.normalize_or_zero();
        (near, if far == DVec3::ZERO { near } else { far.normalize_or_zero() })
    }
}
