//! Normals for shading.

use glam::DVec3;
use mesh_core::{EdgeId, HalfedgeId, IdVec, Topology, TriMesh, VertexId, angles};

/// Unit normals at the three corners of each face: the mean of the normals of the faces around the vertex, weighted by their angles there, over
/// those that no hard edge separates from the face.
///
/// Corners of a vertex that nothing separates have the same normal to the last bit. Where the mean has no direction it is the face's own normal.
///
/// The topology must be that of the mesh, and `is_hard` have an entry for each of its edges.
///
/// The weights are those of G. Thürmer and C. Wüthrich, *Computing vertex normals from polygonal facets* (1998): the normal does not depend on how
/// flat parts are cut into triangles.
pub fn corner_normals(mesh: &TriMesh, topology: &Topology, is_hard: &IdVec<EdgeId, bool>) -> Vec<[[f64; 3]; 3]> {
    let normals = mesh.normals();
    let mut of_corners: Vec<[[f64; 3]; 3]> = normals.iter().map(|n| [n.to_array(); 3]).collect();
    for v in mesh.positions().ids() {
        for group in smooth_groups(topology, is_hard, v) {
            let weighted = |h: &HalfedgeId| angles(mesh.triangle(h.face()))[h.corner()] * normals[h.face()];
            let mean: DVec3 = group.iter().map(weighted).sum();
            let Some(unit) = mean.try_normalize() else { continue };
            for h in group {
                of_corners[h.face().0 as usize][h.corner()] = unit.to_array();
            }
        }
    }
    of_corners
}

/// The corners at a vertex in groups that hard edges separate, each in order around the vertex.
fn smooth_groups(topology: &Topology, is_hard: &IdVec<EdgeId, bool>, v: VertexId) -> Vec<Vec<HalfedgeId>> {
    let fan: Vec<HalfedgeId> = topology.fan(v).collect();
    // The edge of a halfedge of the fan lies between its face and the one before it.
    let ends = |h: HalfedgeId| topology.twin(h).is_none() || is_hard[topology.edge(h)];
    let start = fan.iter().position(|&h| ends(h)).unwrap_or(0);
    let mut groups: Vec<Vec<HalfedgeId>> = Vec::new();
    for i in 0..fan.len() {
        let h = fan[(start + i) % fan.len()];
        match groups.last_mut() {
            Some(group) if !ends(h) => group.push(h),
            _ => groups.push(vec![h]),
        }
    }
    groups
}
