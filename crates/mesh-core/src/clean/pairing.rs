//! Which faces go on into each other across every edge.

use super::edges::{EdgeUse, edge_groups};
use super::editable_mesh::{EditableMesh, Twins};
use super::mend::is_flat;
use crate::{HalfedgeId, IdVec};
use glam::DVec3;
use std::f64::consts::PI;

pub(super) struct Pairing {
    pub(super) twins: Twins,
    /// Edges of more than two faces.
    pub(super) non_manifold_edges: usize,
    /// Edges of two faces that disagree on the direction and are cut.
    pub(super) orientation_cuts: usize,
    /// Edges of more than two faces where a face is left without partner.
    pub(super) leaf_cuts: usize,
}

/// Pairs the halfedges of every edge, each with one that runs the other way.
///
/// Where more than two faces meet: if they alternate around the edge like the sides of solids that touch there, each goes on
/// into the one across the inside, so that every solid keeps its own closed surface. Otherwise the flattest pairs are made
/// first, so that a wall that stands on a surface is cut off and the surface stays whole.
pub(super) fn pair(mesh: &EditableMesh) -> Pairing {
    let twins = IdVec::filled(None, 3 * mesh.faces.len());
    let mut pairing = Pairing { twins, non_manifold_edges: 0, orientation_cuts: 0, leaf_cuts: 0 };
    for uses in edge_groups(&mesh.faces).iter() {
        match *uses {
            [_] => {}
            [(_, g), (_, h)] if mesh.from(g) != mesh.from(h) => pairing.join(g, h),
            [_, _] => pairing.orientation_cuts += 1,
            _ => pairing.join_several(mesh, uses),
        }
    }
    pairing
}

/// A face at an edge, seen along the edge.
#[derive(Clone, Copy)]
struct Page {
    /// Direction around the edge, in radians.
    angle: f64,
    /// True for a face whose back is on its counter-clockwise side.
    forward: bool,
    halfedge: HalfedgeId,
}

impl Pairing {
    fn join(&mut self, g: HalfedgeId, h: HalfedgeId) {
        self.twins[g] = Some(h);
        self.twins[h] = Some(g);
    }

    fn join_several(&mut self, mesh: &EditableMesh, uses: &[EdgeUse]) {
        self.non_manifold_edges += 1;
        let pages = pages_around(mesh, uses);
        let n = pages.len();
        if (0..n).all(|i| pages[i].forward != pages[(i + 1) % n].forward) {
            for i in (0..n).filter(|&i| pages[i].forward) {
                self.join(pages[i].halfedge, pages[(i + 1) % n].halfedge);
            }
        } else {
            self.join_flattest(mesh, &pages);
        }
        self.leaf_cuts += usize::from(uses.iter().any(|&(_, h)| self.twins[h].is_none()));
    }

    fn join_flattest(&mut self, mesh: &EditableMesh, pages: &[Page]) {
        let mut pairs = Vec::new();
        for f in pages.iter().filter(|p| p.forward) {
            for b in pages.iter().filter(|p| !p.forward) {
                let between = (f.angle - b.angle).abs();
                let turn = (between - PI).abs();
                // Two faces that lie on each other are the two sides of a sheet and go on elsewhere.
                if mesh.opposite(f.halfedge) != mesh.opposite(b.halfedge) {
                    pairs.push((turn, f.halfedge, b.halfedge));
                }
            }
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        for (_, f, b) in pairs {
            if self.twins[f].is_none() && self.twins[b].is_none() {
                self.join(f, b);
            }
        }
    }
}

/// The faces around an edge, counter-clockwise against its direction. Of two that lie on each other the one with its back
/// clockwise comes first: nothing is between them, so what is inside is on their far sides.
fn pages_around(mesh: &EditableMesh, uses: &[EdgeUse]) -> Vec<Page> {
    // The direction is that of the positions, so that renumbering the vertices changes nothing.
    let ends = uses[0].0.map(|v| mesh.positions[v]);
    let [start, end] = if ends[0].to_array() < ends[1].to_array() { ends } else { [ends[1], ends[0]] };
    let axis = (end - start).normalize_or_zero();
    let out = |h: HalfedgeId| (mesh.positions[mesh.opposite(h)] - start).reject_from_normalized(axis);
    let x = out(uses[0].1).try_normalize().unwrap_or_else(|| any_normal(axis));
    let y = axis.cross(x);
    let page = |&(_, halfedge): &EdgeUse| {
        let p = out(halfedge);
        // The front of a face whose halfedge runs along the axis is on its counter-clockwise side.
        let forward = mesh.positions[mesh.from(halfedge)] != start;
        // A face without area has no direction.
        let angle = if is_flat(mesh, halfedge.face()) { 0.0 } else { p.dot(y).atan2(p.dot(x)) };
        Page { angle, forward, halfedge }
    };
    let mut pages: Vec<_> = uses.iter().map(page).collect();
    pages.sort_by(|a, b| a.angle.total_cmp(&b.angle).then((a.forward, a.halfedge).cmp(&(b.forward, b.halfedge))));
    pages
}

fn any_normal(axis: DVec3) -> DVec3 {
    if axis == DVec3::ZERO { DVec3::X } else { axis.any_orthonormal_vector() }
}
