//! Merging vertices at one position, and dropping what is no triangle before or after that.

use super::editable_mesh::EditableMesh;
use super::report::CleanReport;
use crate::{IdVec, Place, Soup, VertexId, place};
use glam::DVec3;
use rustc_hash::FxHashMap;

/// The triangles of a soup with merged vertices, without those that are out of range, not finite or collapsed.
pub(super) fn weld(soup: &Soup, report: &mut CleanReport) -> EditableMesh {
    let merged = merge_equal(&soup.positions);
    report.merged_exactly = merged.iter().enumerate().filter(|&(i, &m)| m as usize != i).count();
    // Adding 0 makes 0 of -0, here and below.
    let mut mesh = EditableMesh { positions: soup.positions.iter().map(|&p| p + 0.0).collect(), ..EditableMesh::default() };
    mesh.source_vertex = (0..soup.positions.len() as u32).collect();
    for (i, triangle) in soup.triangles.iter().enumerate() {
        if triangle.iter().any(|&v| v as usize >= soup.positions.len()) {
            report.bad_index += 1;
        } else if triangle.iter().any(|&v| !is_usable(soup.positions[v as usize])) {
            report.not_finite += 1;
        } else {
            let [a, b, c] = triangle.map(|v| VertexId(merged[v as usize]));
            if a == b || b == c || c == a {
                report.collapsed += 1;
            } else {
                mesh.faces.push([a, b, c]);
                mesh.source_face.push(i as u32);
            }
        }
    }
    mesh.turned = IdVec::filled(false, mesh.faces.len());
    mesh.merged_into = merged;
    mesh
}

/// Coordinates beyond this are taken for not finite: products of four of them would be.
const LARGEST_COORDINATE: f64 = 1e75;

/// True for a position that can be computed with.
pub(crate) fn is_usable(p: DVec3) -> bool {
    p.is_finite() && p.abs().max_element() <= LARGEST_COORDINATE
}

/// For every vertex the first one at exactly the same position (0 and -0 are the same, what is not usable stays alone).
pub(crate) fn merge_equal(positions: &[DVec3]) -> Vec<u32> {
    let mut first: FxHashMap<Place, u32> = FxHashMap::default();
    first.reserve(positions.len());
    let merge = |(i, p): (usize, &DVec3)| {
        let i = i as u32;
        if is_usable(*p) { *first.entry(place(*p)).or_insert(i) } else { i }
    };
    positions.iter().enumerate().map(merge).collect()
}
