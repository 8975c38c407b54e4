//! What corners, vertices and faces have, taken from where they are on the source.

use crate::correspond::{Correspondence, PARTS};
use crate::source::interpolate;
use glam::DVec3;
use mesh_core::TriMesh;

/// Values at one vertex that differ by less than this share of their range are the same.
const SAME: f64 = 1e-6;

/// What the corners of each face of `mesh` have, of what those of the source's triangles have. Corners at one vertex whose values differ by
/// rounding have the same.
///
/// The correspondence must be that of the mesh, and `values` have an entry for each triangle of the source's soup.
pub fn corner_values<const N: usize>(mesh: &TriMesh, at: &Correspondence, values: &[[[f64; N]; 3]]) -> Vec<[[f64; N]; 3]> {
    let value = |f: usize, c: usize| interpolate(at.barycentric[f][c].into(), &values[at.triangles[f][c] as usize]);
    let mut carried: Vec<[[f64; N]; 3]> = (0..mesh.n_faces()).map(|f| [0, 1, 2].map(|c| value(f, c))).collect();
    let tolerance = SAME * range(values);
    let mut seen: Vec<Vec<[f64; N]>> = vec![Vec::new(); mesh.n_vertices()];
    for (face, values) in mesh.faces().iter().zip(&mut carried) {
        for (v, value) in face.iter().zip(values) {
            let known = &mut seen[v.0 as usize];
            let is_same = |other: &&[f64; N]| other.iter().zip(&*value).all(|(a, b)| (a - b).abs() <= tolerance);
            match known.iter().find(is_same) {
                Some(other) => *value = *other,
                None => known.push(*value),
            }
        }
    }
    carried
}

/// The difference between the greatest and the least number.
fn range<const N: usize>(values: &[[[f64; N]; 3]]) -> f64 {
    let finite = || values.iter().flatten().flatten().copied().filter(|x| x.is_finite());
    finite().fold(f64::NEG_INFINITY, f64::max) - finite().fold(f64::INFINITY, f64::min)
}

/// What each vertex of `mesh` has, of what the vertices of the soup (with these triangles) have. Where corners at a vertex are on different
/// sides of a cut, the first one counts: nothing is mixed across it. A vertex without faces has 0.
pub fn vertex_values<const N: usize>(
    mesh: &TriMesh,
    at: &Correspondence,
    triangles: &[[u32; 3]],
    values: &[[f64; N]],
) -> Vec<[f64; N]> {
    let of_corners = |i: usize| triangles[i].map(|v| values[v as usize]);
    first_corners(mesh, at, |triangle, weights| interpolate(inside(weights), &of_corners(triangle)), [0.0; N])
}

/// The label of each vertex of `mesh`: that of the corner of the triangle that counts most there.
pub fn vertex_labels(mesh: &TriMesh, at: &Correspondence, triangles: &[[u32; 3]], labels: &[f64]) -> Vec<f64> {
    first_corners(mesh, at, |triangle, weights| labels[triangles[triangle][weights.max_position()] as usize], 0.0)
}

/// What each face of `mesh` has, of what the triangles of the soup have: what most of its area lies on. Of several with as much area that at its
/// middle, or the first.
pub fn face_values<T: Copy + PartialEq>(at: &Correspondence, values: &[T]) -> Vec<T> {
    let most = |parts: &[u32; PARTS]| {
        let of_parts = parts.map(|triangle| values[triangle as usize]);
        let share = |value: &T| of_parts.iter().filter(|other| *other == value).count();
        let mut best = of_parts[0];
        for value in &of_parts[1..] {
            if share(value) > share(&best) {
                best = *value;
            }
        }
        best
    };
    at.parts.iter().map(most).collect()
}

/// For each vertex what its corner in the face of lowest number has.
fn first_corners<T: Copy>(mesh: &TriMesh, at: &Correspondence, value: impl Fn(usize, DVec3) -> T, without: T) -> Vec<T> {
    let mut of_vertices = vec![None; mesh.n_vertices()];
    for (f, face) in mesh.faces().iter().enumerate() {
        for (c, v) in face.iter().enumerate() {
            let slot = &mut of_vertices[v.0 as usize];
            if slot.is_none() {
                *slot = Some(value(at.triangles[f][c] as usize, at.barycentric[f][c].into()));
            }
        }
    }
    of_vertices.into_iter().map(|value| value.unwrap_or(without)).collect()
}

/// The weights made not negative: values other than texture coordinates do not go on beyond a border.
fn inside(weights: DVec3) -> DVec3 {
    let clamped = weights.max(DVec3::ZERO);
    clamped / clamped.element_sum()
}
