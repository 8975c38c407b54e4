//! Triangles on the same three vertices.

use super::edges::edge_groups;
use super::editable_mesh::{EditableMesh, Twins};
use super::report::CleanReport;
use crate::measure::area;
use crate::partition::Partition;
use crate::{FaceId, IdVec, VertexId};

/// Where repeated triangles lie on a surface that is manifold without them, the first of each stays, whichever way the others
/// face. Done before anything is oriented: neighbours of repeated triangles would not find each other.
///
/// Repeated triangles that share edges are judged together: one edge of three different triangles, and all may be sides of
/// different parts, such as the common wall of two solids.
pub(super) fn drop_second_layers(mesh: &mut EditableMesh, report: &mut CleanReport) {
    let first = first_copies(mesh);
    let mut repeated = IdVec::<FaceId, bool>::filled(false, mesh.faces.len());
    for f in first.ids().filter(|&f| first[f] != f) {
        repeated[first[f]] = true;
    }
    let mut parts = Partition::<FaceId>::of_singles(mesh.faces.len());
    let mut branching = Vec::new();
    for uses in edge_groups(&mesh.faces).iter() {
        let mut different: Vec<FaceId> = uses.iter().map(|&(_, h)| first[h.face()]).collect();
        different.sort_unstable();
        different.dedup();
        let is_branch = different.len() > 2;
        different.retain(|&f| repeated[f]);
        different.windows(2).for_each(|w| parts.join(w[0], w[1]));
        branching.extend(different.first().filter(|_| is_branch));
    }
    let mut stays = IdVec::<FaceId, bool>::filled(false, mesh.faces.len());
    for f in branching {
        stays[parts.part(f)] = true;
    }
    let drop = first.ids().map(|f| first[f] != f && !stays[parts.part(first[f])]).collect();
    report.repeated += mesh.drop_faces(&drop);
}

/// Drops pairs of triangles on each other that are joined along an edge of their own and hang on single triangles by their
/// other edges: a fold without extent, left by tessellators. What they hang on closes without them.
pub(super) fn drop_flaps(mesh: &mut EditableMesh, report: &mut CleanReport) {
    let copies = copies(mesh);
    if copies.iter().all(|&n| n == 1) {
        return;
    }
    let mut own_edges = IdVec::<FaceId, u32>::filled(0, mesh.faces.len());
    let mut edges_on_singles = own_edges.clone();
    for uses in edge_groups(&mesh.faces).iter() {
        for &(_, h) in uses {
            let apex = mesh.opposite(h);
            let mut others = uses.iter().filter(|(_, g)| mesh.opposite(*g) != apex).peekable();
            if others.peek().is_none() {
                own_edges[h.face()] += 1;
            } else if others.all(|(_, g)| copies[g.face()] == 1) {
                edges_on_singles[h.face()] += 1;
            }
        }
    }
    let flap = |f: FaceId| copies[f] == 2 && matches!((own_edges[f], edges_on_singles[f]), (1, 2) | (2, 1));
    let drop: IdVec<FaceId, bool> = mesh.faces.ids().map(flap).collect();
    let width = |f: FaceId| {
        let [a, b, c] = mesh.triangle(f);
        2.0 * area([a, b, c]) / a.distance(b).max(b.distance(c)).max(c.distance(a)).max(f64::MIN_POSITIVE)
    };
    report.flap_width =
        drop.enumerate().filter(|(_, is_flap)| **is_flap).map(|(f, _)| width(f)).fold(report.flap_width, f64::max);
    report.flaps += mesh.drop_faces(&drop);
}

/// Of triangles on the same vertices that face the same way the first stays.
pub(super) fn drop_same_way(mesh: &mut EditableMesh, report: &mut CleanReport) {
    let cycle = |f: [VertexId; 3]| {
        let least = (0..3).min_by_key(|&c| f[c]).unwrap_or(0);
        [f[least], f[(least + 1) % 3], f[(least + 2) % 3]]
    };
    let mut drop = IdVec::filled(false, mesh.faces.len());
    for group in groups_by(mesh, cycle).chunk_by(|a, b| a.0 == b.0) {
        for &(_, f) in &group[1..] {
            drop[f] = true;
        }
    }
    report.repeated += mesh.drop_faces(&drop);
}

/// Of two triangles on each other that are sides of one leaf (a double sheet, as in foliage) the first stays, and a leaf
/// that lies on others altogether goes. True when anything was dropped, so that the rest must be paired anew.
pub(super) fn drop_double_sheets(mesh: &mut EditableMesh, twins: &Twins, report: &mut CleanReport) -> bool {
    let groups = groups_by(mesh, sorted);
    let pairs: Vec<[FaceId; 2]> = groups.windows(2).filter(|w| w[0].0 == w[1].0).map(|w| [w[0].1, w[1].1]).collect();
    if pairs.is_empty() {
        return false;
    }
    let leaf = leaves(mesh, twins);
    let mut drop = IdVec::filled(false, mesh.faces.len());
    let mut copy_elsewhere = IdVec::<FaceId, Option<FaceId>>::filled(None, mesh.faces.len());
    for &[f, g] in &pairs {
        if leaf[f] == leaf[g] {
            drop[g] = true;
        } else {
            (copy_elsewhere[f], copy_elsewhere[g]) = (Some(g), Some(f));
        }
    }
    let gone = redundant(&leaf, &copy_elsewhere);
    for f in drop.ids() {
        drop[f] |= gone[leaf[f]];
    }
    let dropped = mesh.drop_faces(&drop);
    report.repeated += dropped;
    dropped > 0
}

/// Marks the leaves of which every face has a copy in a leaf that stays. Of two equal leaves the later one goes.
fn redundant(leaf: &IdVec<FaceId, FaceId>, copy_elsewhere: &IdVec<FaceId, Option<FaceId>>) -> IdVec<FaceId, bool> {
    let mut faces = IdVec::<FaceId, Vec<FaceId>>::filled(Vec::new(), leaf.len());
    for f in leaf.ids() {
        faces[leaf[f]].push(f);
    }
    let mut gone = IdVec::filled(false, leaf.len());
    for part in leaf.ids().rev().filter(|&f| leaf[f] == f) {
        gone[part] = faces[part].iter().all(|&f| copy_elsewhere[f].is_some_and(|g| !gone[leaf[g]]));
    }
    gone
}

/// The part of every face when faces connect across paired halfedges, named by its first face.
fn leaves(mesh: &EditableMesh, twins: &Twins) -> IdVec<FaceId, FaceId> {
    let mut parts = Partition::<FaceId>::of_singles(mesh.faces.len());
    for h in twins.ids() {
        if let Some(twin) = twins[h] {
            parts.join(h.face(), twin.face());
        }
    }
    mesh.faces.ids().map(|f| parts.part(f)).collect()
}

/// For every face how many faces, itself included, have its vertices.
fn copies(mesh: &EditableMesh) -> IdVec<FaceId, usize> {
    let mut copies = IdVec::filled(1, mesh.faces.len());
    for group in groups_by(mesh, sorted).chunk_by(|a, b| a.0 == b.0) {
        for &(_, f) in group {
            copies[f] = group.len();
        }
    }
    copies
}

/// For every face the first one on its vertices, facing either way.
fn first_copies(mesh: &EditableMesh) -> IdVec<FaceId, FaceId> {
    let mut first: IdVec<FaceId, FaceId> = mesh.faces.ids().collect();
    for group in groups_by(mesh, sorted).chunk_by(|a, b| a.0 == b.0) {
        group.iter().for_each(|&(_, f)| first[f] = group[0].1);
    }
    first
}

fn sorted(mut f: [VertexId; 3]) -> [VertexId; 3] {
    f.sort_unstable();
    f
}

/// The faces sorted by a key of their vertices, then by id.
fn groups_by(mesh: &EditableMesh, key: impl Fn([VertexId; 3]) -> [VertexId; 3]) -> Vec<([VertexId; 3], FaceId)> {
    let mut groups: Vec<_> = mesh.faces.enumerate().map(|(f, &v)| (key(v), f)).collect();
    groups.sort_unstable();
    groups
}
