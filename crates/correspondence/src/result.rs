//! From the input to the result: the nearest point that faces the same way.

use glam::DVec3;
use mesh_core::{Cleaned, FaceId, Id as _, IdVec, SurfaceIndex, SurfacePoint, TriMesh, VertexId};
use rayon::prelude::*;

/// A point that faces the same way is taken though another one is nearer by so many mean edges of the result: of the two sides of a thin
/// plate, the other may be the nearer one.
const SLACK: f64 = 1.0;

/// The nearest point of the result for every vertex of the cleaned mesh: in the same connected part, and on a face that faces the same
/// way, where there is one near.
pub(crate) fn nearest_points(
    cleaned: &Cleaned,
    result: &TriMesh,
    cleaned_face: &IdVec<VertexId, FaceId>,
) -> IdVec<VertexId, Option<SurfacePoint>> {
    let (part, _) = cleaned.topology.components();
    let parts: IdVec<FaceId, u32> = result.faces().iter().map(|face| part[cleaned_face[face[0]]]).collect();
    let normals = result.normals();
    let slack = SLACK * mean_edge(result);
    let index = SurfaceIndex::new(result);
    let nearest = |v: usize| {
        let v = VertexId::new(v);
        let (p, facing, own) = (cleaned.mesh.position(v), facing(cleaned, v), part[any_face(cleaned, v)?]);
        let nearest = index.closest_where(p, |f| parts[f] == own)?;
        let agrees = |f: FaceId| parts[f] == own && normals[f].dot(facing) > 0.0;
        let agreeing = if agrees(nearest.face) { None } else { index.closest_within_where(p, nearest.distance + slack, agrees) };
        Some(agreeing.unwrap_or(nearest).point())
    };
    let points: Vec<_> = (0..cleaned.mesh.n_vertices()).into_par_iter().map(nearest).collect();
    IdVec::from_vec(points)
}

/// The mean of the normals around a vertex by areas, of any length.
fn facing(cleaned: &Cleaned, v: VertexId) -> DVec3 {
    let around = cleaned.topology.faces_at(v);
    around.map(|f| mesh_core::vector_area(cleaned.mesh.triangle(f))).sum()
}

fn any_face(cleaned: &Cleaned, v: VertexId) -> Option<FaceId> {
    cleaned.topology.faces_at(v).next()
}

fn mean_edge(mesh: &TriMesh) -> f64 {
    let sides = mesh.faces().iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    sides.map(|[a, b]| mesh.distance(a, b)).sum::<f64>() / (3 * mesh.n_faces()).max(1) as f64
}
