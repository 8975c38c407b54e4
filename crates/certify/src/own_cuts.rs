//! Where does a mesh cut itself? In small pieces along the curves: of the faces that intersect others, long edges are halved, the pieces that still
//! intersect others are kept, and so on.

use crate::intersections::self_intersecting;
use mesh_core::{FaceId, IdVec, TriMesh, VertexId};
use rustc_hash::FxHashMap;

/// The pieces have edges of this share of the diagonal at most. Less tells cuts nearer to those of the original from them, and takes longer.
pub(crate) const SIZE: f64 = 2.5e-3;
/// With so many pieces no edge is halved any more. Where sheets lie in one place pieces cover all of it: more would take seconds and hundreds of
/// megabytes, and larger ones cover the same. Curves seldom take a tenth as many.
const MOST_PIECES: usize = 100_000;

/// Small pieces of a mesh along the curves where it cuts itself. `cutting` are its faces that intersect others.
pub(crate) fn pieces(mesh: &TriMesh, cutting: &[FaceId], diagonal: f64) -> TriMesh {
    let mut pieces =
        Pieces { positions: mesh.positions().clone(), faces: cutting.iter().map(|&f| mesh.face(f)).collect(), done: Vec::new() };
    while pieces.faces.len() < MOST_PIECES && pieces.halve(SIZE * diagonal) {}
    pieces.faces.append(&mut pieces.done);
    pieces.mesh()
}

struct Pieces {
    positions: IdVec<VertexId, glam::DVec3>,
    /// They intersect others.
    faces: Vec<[VertexId; 3]>,
    /// No part of them does, once they were halved: they touched others, and rounding has parted them.
    done: Vec<[VertexId; 3]>,
}

impl Pieces {
    fn mesh(&self) -> TriMesh {
        let faces = self.faces.iter().map(|f| f.map(|v| v.0)).collect();
        TriMesh::new(self.positions.iter().copied().collect(), faces)
            .expect("corners are distinct, and middles of checked positions")
    }

    /// Halves all edges above a length, and keeps what still intersects others. False where no edge is that long.
    fn halve(&mut self, longest: f64) -> bool {
        let mut middles = FxHashMap::default();
        let mut parts = Vec::new();
        for (parent, &[a, b, c]) in self.faces.iter().enumerate() {
            let [ab, bc, ca] = [[a, b], [b, c], [c, a]].map(|edge| middle(&mut self.positions, &mut middles, edge, longest));
            parts.extend(split([a, b, c], [ab, bc, ca]).into_iter().map(|part| (parent, part)));
        }
        if middles.is_empty() {
            return false;
        }
        let parents = std::mem::replace(&mut self.faces, parts.iter().map(|(_, part)| *part).collect());
        let meeting = self_intersecting(&self.mesh());
        let mut is_left = vec![false; parents.len()];
        self.faces = meeting.iter().map(|f| parts[f.0 as usize]).map(|(parent, part)| (is_left[parent] = true, part).1).collect();
        self.done.extend(parents.into_iter().zip(is_left).filter(|(_, is_left)| !is_left).map(|(face, _)| face));
        true
    }
}

/// The middle of an edge above a length, the same one from both sides.
fn middle(
    positions: &mut IdVec<VertexId, glam::DVec3>,
    middles: &mut FxHashMap<[VertexId; 2], VertexId>,
    [a, b]: [VertexId; 2],
    longest: f64,
) -> Option<VertexId> {
    let (a, b) = (a.min(b), a.max(b));
    let ends = [positions[a], positions[b]];
    if ends[0].distance(ends[1]) <= longest {
        return None;
    }
    Some(*middles.entry([a, b]).or_insert_with(|| positions.push(ends[0].midpoint(ends[1]))))
}

/// A triangle cut at the middles of its edges, where they have one.
fn split([a, b, c]: [VertexId; 3], middles: [Option<VertexId>; 3]) -> Vec<[VertexId; 3]> {
    match middles {
        [None, None, None] => vec![[a, b, c]],
        [Some(ab), None, None] => vec![[a, ab, c], [ab, b, c]],
        [Some(ab), Some(bc), None] => vec![[ab, b, bc], [a, ab, bc], [a, bc, c]],
        [Some(ab), Some(bc), Some(ca)] => vec![[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]],
        // The others are these, turned.
        [ab, bc, ca] => split([b, c, a], [bc, ca, ab]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_shapes::{crossing_cubes, joined, moved, square};
    use glam::DVec3;

    /// However a triangle is split, its parts have its area and its orientation.
    #[test]
    fn parts_cover_their_triangle() {
        let corners = [DVec3::ZERO, DVec3::new(3.0, 0.0, 0.0), DVec3::new(1.0, 2.0, 0.0)];
        let mut positions: IdVec<VertexId, DVec3> = corners.into_iter().collect();
        let ids = [0, 1, 2].map(VertexId);
        let middles = [0, 1, 2].map(|i| positions.push(corners[i].midpoint(corners[(i + 1) % 3])));
        for cut in 0..8 {
            let parts = split(ids, [0, 1, 2].map(|i| (cut >> i & 1 == 1).then_some(middles[i])));
            assert_eq!(parts.len(), 1 + (cut as u32).count_ones() as usize);
            let areas: Vec<f64> = parts.iter().map(|p| mesh_core::vector_area(p.map(|v| positions[v])).z).collect();
            assert!(areas.iter().all(|area| *area > 0.0) && (areas.iter().sum::<f64>() - 3.0).abs() < 1e-12);
        }
    }

    /// The pieces are small, and lie where the cubes cut each other: on the surface of both.
    #[test]
    fn pieces_follow_the_curve() {
        let both = crossing_cubes();
        let found = pieces(&both, &self_intersecting(&both), 0.05 / SIZE);
        assert!(found.n_faces() > 50);
        let on = |p: DVec3, low: DVec3| (p - low).min_element().min((low + 1.0 - p).min_element()).abs();
        for f in found.faces().ids() {
            assert!(found.triangle(f).iter().all(|p| p.distance(found.centroid(f)) < 0.05));
            let p = found.centroid(f);
            assert!(on(p, DVec3::ZERO) < 0.06 && on(p, DVec3::new(0.5, 0.6, 0.7)) < 0.06, "{p}");
        }
    }

    /// Squares that lie on each other in part: pieces cover that part, and are no more than that many times four.
    #[test]
    fn sheets_in_one_place_have_a_bounded_number_of_pieces() {
        let both = joined(&square(), &moved(&square(), |p| p + DVec3::new(0.05, 0.02, 0.0)));
        let found = pieces(&both, &self_intersecting(&both), both.diagonal());
        assert!((MOST_PIECES..4 * MOST_PIECES).contains(&found.n_faces()), "{}", found.n_faces());
        let area: f64 = found.faces().ids().map(|f| found.area(f)).sum();
        assert!(area > 2.0 * 0.95 * 0.98 && area < 2.0, "{area}");
    }
}
