//! Patches joined along their shared sites to one simplicial mesh.
//!
//! Edges with a vertex inside a patch belong to that patch alone. So only arc edges and chords between two border vertices can
//! repeat: arcs have enough segments, and every chord that repeats another edge is split at a new vertex inside its patch. Each
//! split takes one chord away and adds only edges with an inner vertex, hence this ends.

use glam::DVec2;
use mesh_core::{Id, IdVec, SurfacePoint, VertexId};
use region_map::{Chart, PatchId};
use rustc_hash::{FxHashMap, FxHashSet};

/// A flat base triangle in the chart of its patch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FlatFace {
    pub(crate) vertices: [VertexId; 3],
    pub(crate) uv: [DVec2; 3],
}

/// The base triangles of every patch, and the vertices that splitting chords added.
pub(crate) struct Patchwork {
    pub(crate) faces: IdVec<PatchId, Vec<FlatFace>>,
    /// New vertices, numbered on from the first ones: their patch and place.
    pub(crate) added: Vec<(PatchId, SurfacePoint)>,
}

type Ends = [VertexId; 2];

fn ends(a: VertexId, b: VertexId) -> Ends {
    [a.min(b), a.max(b)]
}

/// Splits chords until no edge and no triangle repeats. `arc_edges` are the base edges along arcs, `n_vertices` the number of
/// vertices so far.
pub(crate) fn make_simplicial(
    mut faces: IdVec<PatchId, Vec<FlatFace>>,
    charts: &IdVec<PatchId, Chart>,
    arc_edges: &FxHashSet<Ends>,
    n_vertices: usize,
) -> Patchwork {
    let mut added = Vec::new();
    let mut taken: FxHashSet<Ends> = arc_edges.clone();
    let mut triangles: FxHashSet<[VertexId; 3]> = FxHashSet::default();
    for p in charts.ids() {
        let list = &mut faces[p];
        for [a, b] in inner_edges(list) {
            if !taken.insert([a, b]) {
                let v = VertexId::new(n_vertices + added.len());
                let middle = split_edge(list, a, b, v);
                added.push((p, charts[p].locate(middle)));
            }
        }
        // Two patches of one triangle each, between the same three arcs, would be the same triangle twice.
        if let [only] = list[..] {
            let mut key = only.vertices;
            key.sort_unstable();
            if !triangles.insert(key) {
                let v = VertexId::new(n_vertices + added.len());
                let middle = split_face(list, v);
                added.push((p, charts[p].locate(middle)));
            }
        }
    }
    Patchwork { faces, added }
}

/// The edges that two faces of the list share, in the order of the faces.
fn inner_edges(faces: &[FlatFace]) -> Vec<Ends> {
    let mut count: FxHashMap<Ends, usize> = FxHashMap::default();
    let mut inner = Vec::new();
    for f in faces {
        for c in 0..3 {
            let key = ends(f.vertices[c], f.vertices[(c + 1) % 3]);
            let n = count.entry(key).or_default();
            *n += 1;
            if *n == 2 {
                inner.push(key);
            }
        }
    }
    inner
}

/// Splits an edge at its middle, and both faces beside it; returns the middle.
fn split_edge(faces: &mut Vec<FlatFace>, a: VertexId, b: VertexId, v: VertexId) -> DVec2 {
    let mut middle = DVec2::ZERO;
    for i in 0..faces.len() {
        let f = faces[i];
        let Some(c) = (0..3).find(|&c| ends(f.vertices[c], f.vertices[(c + 1) % 3]) == [a, b]) else { continue };
        let next = (c + 1) % 3;
        middle = f.uv[c].midpoint(f.uv[next]);
        let mut second = f;
        (second.vertices[c], second.uv[c]) = (v, middle);
        (faces[i].vertices[next], faces[i].uv[next]) = (v, middle);
        faces.push(second);
    }
    middle
}

/// Splits the only face of a list in three; returns the new point.
fn split_face(faces: &mut Vec<FlatFace>, v: VertexId) -> DVec2 {
    let f = faces[0];
    let middle = (f.uv[0] + f.uv[1] + f.uv[2]) / 3.0;
    faces.clear();
    for c in 0..3 {
        let mut part = f;
        (part.vertices[c], part.uv[c]) = (v, middle);
        faces.push(part);
    }
    middle
}
