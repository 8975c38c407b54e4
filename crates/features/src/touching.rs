//! Points where a surface touches itself: several vertices of a manifold mesh in one place.
//!
//! Cleaning leaves them where sheets of the input meet in a single vertex (holes that share a corner, two cones tip to tip). As corners they
//! stay where they are, and what touched still touches.

use glam::DVec3;
use mesh_core::{Id as _, Topology, TriMesh, VertexId};

/// The vertices that share their place with others and no edge with them: where edges coincide as well, sheets touch along a line. None where
/// there are more than `most`.
pub(crate) fn touching_points(mesh: &TriMesh, topology: &Topology, most: usize) -> Vec<VertexId> {
    let bits = |v: VertexId| mesh.position(v).to_array().map(f64::to_bits);
    let used = |v: &VertexId| topology.fan(*v).next().is_some();
    let mut by_place: Vec<VertexId> = mesh.positions().ids().filter(used).collect();
    by_place.sort_unstable_by_key(|&v| (bits(v), v.index()));
    let groups = by_place.chunk_by(|&v, &w| bits(v) == bits(w)).filter(|group| group.len() > 1);
    let touching: Vec<VertexId> = groups.filter(|group| share_no_edge(mesh, topology, group)).flatten().copied().collect();
    if touching.len() > most { Vec::new() } else { touching }
}

/// Do no two of some vertices in one place have neighbours in one place?
fn share_no_edge(mesh: &TriMesh, topology: &Topology, group: &[VertexId]) -> bool {
    let mut around: Vec<DVec3> = group.iter().flat_map(|&v| topology.one_ring(v)).map(|w| mesh.position(w)).collect();
    around.sort_unstable_by_key(|p| p.to_array().map(f64::to_bits));
    around.windows(2).all(|pair| pair[0] != pair[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two tetrahedra that touch in a vertex, or along an edge; each has its own vertices.
    fn tetrahedra(along_edge: bool) -> (TriMesh, Topology) {
        let far = if along_edge { [0.0, 0.0, 1.0] } else { [0.0, 0.0, -1.0] };
        let positions = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
            [0.0, 0.0, 0.0],
            [-1.0, 0.0, 0.0],
            [0.0, -1.0, 0.0],
            far,
        ];
        let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        let other = faces.map(|f| f.map(|v| v + 4));
        let mesh = TriMesh::from_slices(&positions, &[faces, other].concat()).unwrap();
        let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
        (mesh, topology)
    }

    #[test]
    fn points_are_found_and_lines_are_not() {
        let (mesh, topology) = tetrahedra(false);
        assert_eq!(touching_points(&mesh, &topology, 9), [VertexId(0), VertexId(4)]);
        assert_eq!(touching_points(&mesh, &topology, 1), []);
        let (mesh, topology) = tetrahedra(true);
        assert_eq!(touching_points(&mesh, &topology, 9), []);
    }
}
