//! Where a surface touches itself: vertices and edges of a manifold mesh that lie in one place.
//!
//! Cleaning leaves them where sheets of the input meet in a vertex (holes that share a corner) or along a line (a wall on a floor), and where it
//! cuts a one-sided surface. Arcs and corners in the same places keep together what touches.

use crate::options::{FeatureError, check_same_mesh};
use mesh_core::{EdgeId, IdVec, Place, Topology, TriMesh, VertexId, place};
use region_map::Network;
use rustc_hash::{FxHashMap, FxHashSet};

/// The edges along which sheets of a manifold mesh touch: other edges lie in the same place. Where whole faces lie on each other there are none.
pub fn touching_edges(mesh: &TriMesh, topology: &Topology) -> Result<Vec<[VertexId; 2]>, FeatureError> {
    check_same_mesh(mesh, topology)?;
    Ok(Touching::find(mesh, topology).lines().map(|e| topology.ends(e)).collect())
}

/// Vertices and edges that share their places with others.
pub(crate) struct Touching<'a> {
    mesh: &'a TriMesh,
    topology: &'a Topology,
    /// The vertices of each place that has more than one, in rising order.
    groups: Vec<Vec<VertexId>>,
    is_line: IdVec<EdgeId, bool>,
}

impl<'a> Touching<'a> {
    /// Of a mesh. Where whole faces lie on each other (double walls) nothing touches along a line.
    pub(crate) fn find(mesh: &'a TriMesh, topology: &'a Topology) -> Self {
        let used = mesh.positions().ids().filter(|&v| topology.fan(v).next().is_some());
        let mut by_place: Vec<(Place, VertexId)> = used.map(|v| (place(mesh.position(v)), v)).collect();
        by_place.sort_unstable();
        let same_place = by_place.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1);
        let mut groups: Vec<Vec<VertexId>> = same_place.map(|group| group.iter().map(|(_, v)| *v).collect()).collect();
        groups.sort_unstable();
        let shares_place: FxHashSet<VertexId> = groups.iter().flatten().copied().collect();
        let mut edges: FxHashMap<[Place; 2], Vec<EdgeId>> = FxHashMap::default();
        for e in topology.edge_ids().filter(|&e| topology.ends(e).iter().all(|v| shares_place.contains(v))) {
            edges.entry(rising(topology.ends(e).map(|v| place(mesh.position(v))))).or_default().push(e);
        }
        let mut is_line = IdVec::filled(false, topology.n_edges());
        for edge in edges.into_values().filter(|edges| edges.len() > 1).filter(|edges| share_no_face(mesh, topology, edges)) {
            edge.into_iter().for_each(|e| is_line[e] = true);
        }
        Self { mesh, topology, groups, is_line }
    }

    /// The edges along which sheets touch.
    pub(crate) fn lines(&self) -> impl Iterator<Item = EdgeId> {
        self.is_line.enumerate().filter(|(_, is_line)| **is_line).map(|(e, _)| e)
    }

    /// Makes corners of the ends and junctions of these lines, and where one is a corner of all in its place; on a closed line of one of them;
    /// and of single points in which sheets touch, unless there are more than `most_points`. `traced` is the network with some corners.
    pub(crate) fn set_corners<E>(
        &self,
        is_corner: &mut IdVec<VertexId, bool>,
        most_points: usize,
        traced: impl Fn(&IdVec<VertexId, bool>) -> Result<Network, E>,
    ) -> Result<(), E> {
        let network = traced(is_corner)?;
        let (on_lines, points): (Vec<_>, Vec<_>) =
            self.groups.iter().partition(|group| group.iter().any(|&v| self.degree(v) > 0));
        let is_end = |v: &VertexId| self.degree(*v) != 2 || network.corner_of_vertex[*v].is_some();
        let ends = on_lines.iter().filter(|group| group.iter().any(is_end)).flat_map(|group| group.iter());
        ends.for_each(|&v| is_corner[v] = true);
        let points: Vec<_> = points.into_iter().filter(|group| self.share_no_edge(group)).collect();
        if points.iter().map(|group| group.len()).sum::<usize>() <= most_points {
            points.into_iter().flatten().for_each(|&v| is_corner[v] = true);
        }
        let network = traced(is_corner)?;
        for arc in network.arcs.iter().filter(|arc| arc.is_loop() && self.is_line[self.topology.edge(arc.halfedges[0])]) {
            let first = arc.vertices.iter().map(|&v| place(self.mesh.position(v))).min();
            let here = self.groups.iter().find(|group| Some(place(self.mesh.position(group[0]))) == first);
            here.into_iter().flatten().for_each(|&v| is_corner[v] = true);
        }
        Ok(())
    }

    /// How many lines end at a vertex.
    fn degree(&self, v: VertexId) -> usize {
        region_map::spokes(self.topology, v).filter(|&h| self.is_line[self.topology.edge(h)]).count()
    }

    /// Do no two of some vertices in one place have neighbours in one place?
    fn share_no_edge(&self, group: &[VertexId]) -> bool {
        let around = group.iter().flat_map(|&v| self.topology.one_ring(v));
        let mut around: Vec<Place> = around.map(|w| place(self.mesh.position(w))).collect();
        around.sort_unstable();
        around.windows(2).all(|pair| pair[0] != pair[1])
    }
}

fn rising([a, b]: [Place; 2]) -> [Place; 2] {
    [a.min(b), a.max(b)]
}

/// Do no two of the faces at some edges in one place lie on each other?
fn share_no_face(mesh: &TriMesh, topology: &Topology, edges: &[EdgeId]) -> bool {
    let faces = edges.iter().flat_map(|&e| {
        let (f, g) = topology.edge_faces(e);
        [Some(f), g].into_iter().flatten()
    });
    let mut corners: Vec<[Place; 3]> = faces.map(|f| mesh.face(f).map(|v| place(mesh.position(v)))).collect();
    corners.iter_mut().for_each(|face| face.sort_unstable());
    corners.sort_unstable();
    corners.windows(2).all(|pair| pair[0] != pair[1])
}

#[cfg(test)]
mod tests {
    use crate::{FeatureOptions, detect};
    use mesh_core::{CleanOptions, Soup, TriMesh, clean};

    /// Two tetrahedra that touch in a vertex, or along an edge, or in a face; each has its own vertices.
    fn tetrahedra(common: usize) -> Soup {
        let corners = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let other = |i: usize| if i < common { corners[i] } else { corners[i].map(|x| -x) };
        let positions: Vec<[f64; 3]> = corners.into_iter().chain((0..4).map(other)).collect();
        let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        TriMesh::from_slices(&positions, &[faces, faces.map(|f| f.map(|v| v + 4))].concat()).unwrap().to_soup()
    }

    /// Corners and arcs of a soup without creases.
    fn corners_and_arcs(soup: &Soup) -> [usize; 2] {
        let cleaned = clean(soup, &CleanOptions::default()).unwrap();
        let options = FeatureOptions { strong_angle: 180.0, ..FeatureOptions::default() };
        let network = detect(&cleaned.mesh, &cleaned.topology, &[], 0.0, &options).unwrap();
        [network.corners.len(), network.arcs.len()]
    }

    /// What touches in a point has a corner there on both sides; along an edge it has an arc there on both sides.
    #[test]
    fn points_and_lines() {
        assert_eq!(corners_and_arcs(&tetrahedra(1)), [2, 0]);
        assert_eq!(corners_and_arcs(&tetrahedra(2)), [4, 2]);
    }
}
