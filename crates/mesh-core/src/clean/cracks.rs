//! Cracks: borders that run along each other at a distance of rounding.

use super::edges::edge_groups;
use super::editable_mesh::EditableMesh;
use super::report::{CleanOptions, CleanReport};
use crate::{Bounds, IdVec, VertexId};
use glam::DVec3;
use rustc_hash::FxHashMap;

/// A smaller tolerance merges nothing: it is below the rounding of coordinates, and cells of this size could not be numbered.
const LEAST_SHARE: f64 = 1e-15;

/// Merges vertices on borders that are within the tolerance, and drops the faces that collapse.
pub(super) fn close_cracks(mesh: &mut EditableMesh, options: &CleanOptions, report: &mut CleanReport) {
    let Some((tolerance, origin)) = tolerance(mesh, options) else { return };
    let merged = merge_near(mesh, &border_vertices(mesh), tolerance, origin);
    if merged.is_empty() {
        return;
    }
    report.merged_by_tolerance = merged.len();
    for v in mesh.faces.iter_mut().flatten() {
        *v = *merged.get(v).unwrap_or(v);
    }
    // Vertices still have the numbers of the soup here.
    for v in &mut mesh.merged_into {
        *v = merged.get(&VertexId(*v)).map_or(*v, |w| w.0);
    }
    let collapsed: IdVec<_, bool> = mesh.faces.iter().map(|&[a, b, c]| a == b || b == c || c == a).collect();
    report.collapsed += mesh.drop_faces(&collapsed);
}

/// The tolerance as a length, and the least coordinates that there are. `None` where nothing is to be merged.
pub(super) fn tolerance(mesh: &EditableMesh, options: &CleanOptions) -> Option<(f64, DVec3)> {
    let bounds = Bounds::of(mesh.faces.iter().flatten().map(|&v| mesh.positions[v]))?;
    let tolerance = options.weld_tolerance * bounds.diagonal();
    let is_wanted = options.weld_tolerance >= LEAST_SHARE && tolerance > 0.0 && tolerance.is_finite();
    is_wanted.then_some((tolerance, bounds.min))
}

/// The ends of edges of one face, in the order of their positions: that of the numbering shall not matter.
fn border_vertices(mesh: &EditableMesh) -> Vec<VertexId> {
    let groups = edge_groups(&mesh.faces);
    let mut border: Vec<VertexId> = groups.iter().filter(|uses| uses.len() == 1).flat_map(|uses| uses[0].0).collect();
    border.sort_unstable();
    border.dedup();
    let key = |&v: &VertexId| mesh.positions[v].to_array();
    border.sort_by(|v, w| key(v).partial_cmp(&key(w)).unwrap_or(std::cmp::Ordering::Equal));
    border
}

/// What every vertex merges into that does: the nearest one before it that stands for itself and is within the tolerance. So no vertex
/// moves further than that.
fn merge_near(mesh: &EditableMesh, vertices: &[VertexId], tolerance: f64, origin: DVec3) -> FxHashMap<VertexId, VertexId> {
    let cell = |p: DVec3| ((p - origin) / tolerance).floor().to_array().map(|x| x as i64);
    let mut standing: FxHashMap<[i64; 3], Vec<VertexId>> = FxHashMap::default();
    let mut merged = FxHashMap::default();
    for &v in vertices {
        let p = mesh.positions[v];
        let near = cells_around(cell(p)).filter_map(|c| standing.get(&c)).flatten();
        let by_distance = near.map(|&w| (mesh.positions[w].distance(p), w)).filter(|&(d, _)| d <= tolerance);
        match by_distance.min_by(|a, b| a.0.total_cmp(&b.0)) {
            Some((_, w)) => {
                merged.insert(v, w);
            }
            None => standing.entry(cell(p)).or_default().push(v),
        }
    }
    merged
}

fn cells_around([x, y, z]: [i64; 3]) -> impl Iterator<Item = [i64; 3]> {
    (0..27).map(move |i| [x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1])
}
