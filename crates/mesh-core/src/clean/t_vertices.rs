//! T-vertices: vertices on the edge of a triangle beside that has none there, as where a coarse side of a box meets a fine one.

use super::cracks::tolerance;
use super::edges::edge_groups;
use super::editable_mesh::EditableMesh;
use super::report::{CleanOptions, CleanReport};
use crate::{FaceId, HalfedgeId, IdVec, VertexId};
use std::collections::BTreeMap;

/// Splits edges of the border, if that is wanted, along which another border runs through vertices of its own: both sides then have the same vertices.
///
/// Every border of both is left alone where the other one does not run along it from end to end: what only comes near stays apart.
pub(super) fn close_t_vertices(mesh: &mut EditableMesh, options: &CleanOptions, report: &mut CleanReport) {
    let Some((tolerance, _)) = tolerance(mesh, options) else { return };
    // A triangle may have such vertices on all three edges: each pass splits one.
    loop {
        let found = chains(mesh, tolerance);
        if found.is_empty() {
            return;
        }
        let n = found.values().map(|(_, chain)| chain.len()).sum::<usize>();
        if !options.close_t_vertices {
            report.open_t_vertices = n;
            return;
        }
        report.t_vertices += n;
        for (f, (h, chain)) in found {
            split(mesh, f, h, &chain);
        }
    }
}

/// For every face with such an edge one of these, and the vertices of the other border from its beginning to its end.
fn chains(mesh: &EditableMesh, tolerance: f64) -> BTreeMap<FaceId, (HalfedgeId, Vec<VertexId>)> {
    let groups = edge_groups(&mesh.faces);
    let border: Vec<_> = groups.iter().filter(|uses| uses.len() == 1).map(|uses| uses[0]).collect();
    let mut beside: IdVec<VertexId, Vec<VertexId>> =
        IdVec::filled(Vec::new(), if border.is_empty() { 0 } else { mesh.positions.len() });
    for ([a, b], _) in &border {
        beside[*a].push(*b);
        beside[*b].push(*a);
    }
    let mut found = BTreeMap::new();
    for &(_, h) in &border {
        let [a, b] = [mesh.from(h), mesh.from(h.next())];
        // Not the other two sides of a triangle without area.
        if let Some(chain) = chain(mesh, &beside, [a, b], tolerance).filter(|chain| !chain.contains(&mesh.opposite(h))) {
            found.entry(h.face()).or_insert((h, chain));
        }
    }
    found
}

/// The vertices between the ends of an edge on a border that runs along it.
fn chain(
    mesh: &EditableMesh,
    beside: &IdVec<VertexId, Vec<VertexId>>,
    [a, b]: [VertexId; 2],
    tolerance: f64,
) -> Option<Vec<VertexId>> {
    let [from, to] = [a, b].map(|v| mesh.positions[v]);
    let along = (to - from) / (to - from).length_squared();
    // The nearest first, as another border may skip some.
    let next = |v: VertexId, at: f64| {
        let ahead = beside[v].iter().filter_map(|&w| {
            let s = (mesh.positions[w] - from).dot(along);
            let is_on_edge = w == b || mesh.positions[w].distance(from.lerp(to, s)) <= tolerance;
            ([v, w] != [a, b] && s > at && s <= 1.0 && is_on_edge).then_some((s, w))
        });
        ahead.min_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)))
    };
    let (mut v, mut at, mut chain) = (a, 0.0, Vec::new());
    while let Some((s, w)) = next(v, at) {
        if w == b {
            return (!chain.is_empty()).then_some(chain);
        }
        chain.push(w);
        (v, at) = (w, s);
    }
    None
}

/// Splits a face into a fan of triangles from the corner across an edge to the vertices along that edge.
fn split(mesh: &mut EditableMesh, f: FaceId, h: HalfedgeId, chain: &[VertexId]) {
    let [a, b, tip] = [mesh.from(h), mesh.from(h.next()), mesh.opposite(h)];
    let ends: Vec<VertexId> = [a].into_iter().chain(chain.iter().copied()).chain([b]).collect();
    let mut fan = ends.windows(2).map(|pair| [pair[0], pair[1], tip]);
    if let Some(first) = fan.next() {
        mesh.faces[f] = first;
    }
    for triangle in fan {
        mesh.faces.push(triangle);
        mesh.source_face.push(mesh.source_face[f]);
        mesh.turned.push(mesh.turned[f]);
    }
}
