//! One vertex for every fan.

use super::edges::edge_groups;
use super::editable_mesh::{EditableMesh, Twins};
use crate::{FaceId, HalfedgeId, Id, IdVec, VertexId};

/// Gives every fan of faces around a vertex a vertex of its own, at the same position.
///
/// Two different edges may still have the same two ends, as where a surface touches itself along one edge. All of them but the
/// first get a vertex in their middle. Returns how many these are.
pub(super) fn split(mesh: &mut EditableMesh, twins: &Twins) -> usize {
    split_vertices(mesh, twins);
    let middles = Middles::of_doubled_edges(mesh, twins);
    middles.insert(mesh);
    middles.count
}

/// Numbers the fans by their old vertex, then by their first face.
fn split_vertices(mesh: &mut EditableMesh, twins: &Twins) {
    let mut fan_of = IdVec::<HalfedgeId, Option<usize>>::filled(None, twins.len());
    let mut fans: Vec<(VertexId, usize)> = Vec::with_capacity(mesh.positions.len());
    for h in twins.ids() {
        if fan_of[h].is_none() {
            mark_fan(h, twins, &mut fan_of, fans.len());
            fans.push((mesh.from(h), fans.len()));
        }
    }
    fans.sort_unstable();
    let mut new = vec![VertexId(0); fans.len()];
    for (i, &(_, fan)) in fans.iter().enumerate() {
        new[fan] = VertexId::new(i);
    }
    mesh.positions = fans.iter().map(|&(v, _)| mesh.positions[v]).collect();
    mesh.source_vertex = fans.iter().map(|&(v, _)| mesh.source_vertex[v]).collect();
    for h in twins.ids() {
        if let Some(fan) = fan_of[h] {
            mesh.faces[h.face()][h.corner()] = new[fan];
        }
    }
}

/// Marks the halfedges that start at the same vertex as `h` and are reached from it over paired edges.
fn mark_fan(h: HalfedgeId, twins: &Twins, fan_of: &mut IdVec<HalfedgeId, Option<usize>>, fan: usize) {
    fan_of[h] = Some(fan);
    let mut at = h;
    while let Some(next) = twins[at.prev()] {
        if next == h {
            return;
        }
        fan_of[next] = Some(fan);
        at = next;
    }
    at = h;
    while let Some(twin) = twins[at] {
        at = twin.next();
        fan_of[at] = Some(fan);
    }
}

/// New vertices in the middle of edges.
struct Middles {
    count: usize,
    on: IdVec<HalfedgeId, Option<VertexId>>,
}

impl Middles {
    /// Adds the vertices to the mesh, but not yet to its faces.
    fn of_doubled_edges(mesh: &mut EditableMesh, twins: &Twins) -> Self {
        let mut middles = Self { count: 0, on: IdVec::filled(None, twins.len()) };
        for uses in edge_groups(&mesh.faces).iter() {
            let ([a, b], first) = uses[0];
            for &(_, h) in &uses[1..] {
                if twins[h] == Some(first) || middles.on[h].is_some() {
                    continue;
                }
                let middle = mesh.positions.push(mesh.positions[a].midpoint(mesh.positions[b]));
                mesh.source_vertex.push(mesh.source_vertex[a]);
                middles.count += 1;
                middles.on[h] = Some(middle);
                if let Some(twin) = twins[h] {
                    middles.on[twin] = Some(middle);
                }
            }
        }
        middles
    }

    fn insert(&self, mesh: &mut EditableMesh) {
        for f in (0..mesh.faces.len()).map(FaceId::new) {
            let sides = [0, 1, 2].map(|c| self.on[HalfedgeId::of(f, c)]);
            if sides.iter().any(Option::is_some) {
                split_face(mesh, f, sides);
            }
        }
    }
}

/// Splits a face at the given vertices on its sides. The first piece takes its place, others are added.
fn split_face(mesh: &mut EditableMesh, f: FaceId, sides: [Option<VertexId>; 3]) {
    let [a, b, c] = mesh.faces[f];
    let Some(side) = sides.iter().position(Option::is_some) else { return };
    // From here on the side is the first one, as in the drawing of a, b, c.
    let ([a, b, c], [middle, bc, ca]) = match side {
        0 => ([a, b, c], sides),
        1 => ([b, c, a], [sides[1], sides[2], sides[0]]),
        _ => ([c, a, b], [sides[2], sides[0], sides[1]]),
    };
    let Some(middle) = middle else { return };
    mesh.faces[f] = [a, middle, c];
    let other = mesh.faces.push([middle, b, c]);
    mesh.source_face.push(mesh.source_face[f]);
    mesh.turned.push(mesh.turned[f]);
    split_face(mesh, f, [None, None, ca]);
    split_face(mesh, other, [None, bc, None]);
}
