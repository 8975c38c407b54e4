//! [`Source`]: a cleaned mesh that knows the triangles it was made of.

use glam::DVec3;
use mesh_core::{Cleaned, EdgeId, FaceId, HalfedgeId, IdVec, Soup, SurfaceIndex, closest_on_triangle};
use std::sync::OnceLock;

/// A cleaned mesh, and where the corners of its faces are on the triangles that it was made of.
#[derive(Debug)]
pub struct Source<'a> {
    pub(crate) cleaned: &'a Cleaned,
    /// Barycentric coordinates of the corners of each face in its triangle.
    pub(crate) corners: IdVec<FaceId, [DVec3; 3]>,
    index: OnceLock<SurfaceIndex>,
}

impl<'a> Source<'a> {
    /// Of a soup and what cleaning made of it.
    pub fn new(soup: &Soup, cleaned: &'a Cleaned) -> Self {
        let of_face = |f: FaceId| {
            let vertices = soup.triangles[cleaned.source_face[f] as usize];
            let triangle = vertices.map(|v| soup.positions[v as usize]);
            cleaned.mesh.triangle(f).map(|p| match triangle.iter().position(|&q| q == p) {
                Some(corner) => DVec3::AXES[corner],
                None => closest_on_triangle(p, triangle),
            })
        };
        let corners = cleaned.mesh.faces().ids().map(of_face).collect();
        Self { cleaned, corners, index: OnceLock::new() }
    }

    /// The index of the cleaned mesh, built when it is first asked for.
    pub(crate) fn index(&self) -> &SurfaceIndex {
        self.index.get_or_init(|| SurfaceIndex::new(&self.cleaned.mesh))
    }

    /// The edges of the cleaned mesh at which the values on both sides are not the same: further apart than `tolerance` at one of its ends, or there
    /// on one side and not a number on the other. `values` has those at the corners of each triangle of the soup.
    pub fn seams<const N: usize>(&self, values: &[[[f64; N]; 3]], tolerance: f64) -> IdVec<EdgeId, bool> {
        let value = |h: HalfedgeId, corner: usize| {
            let triangle = self.cleaned.source_face[h.face()] as usize;
            interpolate(self.corners[h.face()][corner], &values[triangle])
        };
        let differ = |a: [f64; N], b: [f64; N]| {
            a.iter()
                .zip(b)
                .any(|(a, b)| if a.is_nan() || b.is_nan() { a.is_nan() != b.is_nan() } else { (a - b).abs() > tolerance })
        };
        let next = |corner: usize| (corner + 1) % 3;
        self.edges_where(|h, twin| {
            let [start, end] = [(h.corner(), next(twin.corner())), (next(h.corner()), twin.corner())];
            [start, end].into_iter().any(|(a, b)| differ(value(h, a), value(twin, b)))
        })
    }

    /// The edges of the cleaned mesh at which labels of the triangles of the soup change.
    pub fn label_borders(&self, labels: &[u32]) -> IdVec<EdgeId, bool> {
        let label = |h: HalfedgeId| labels[self.cleaned.source_face[h.face()] as usize];
        self.edges_where(|h, twin| label(h) != label(twin))
    }

    /// The edges of the cleaned mesh that are hard by smoothing groups of the triangles of the soup: the groups change, or there is none (0).
    pub fn group_borders(&self, groups: &[u32]) -> IdVec<EdgeId, bool> {
        let group = |h: HalfedgeId| groups[self.cleaned.source_face[h.face()] as usize];
        self.edges_where(|h, twin| group(h) != group(twin) || group(h) == 0)
    }

    /// Positions of the ends of some edges of the cleaned mesh.
    pub fn ends_of(&self, edges: &IdVec<EdgeId, bool>) -> Vec<[DVec3; 2]> {
        let ends = |e| self.cleaned.topology.ends(e).map(|v| self.cleaned.mesh.position(v));
        self.cleaned.topology.edge_ids().filter(|&e| edges[e]).map(ends).collect()
    }

    fn edges_where(&self, holds: impl Fn(HalfedgeId, HalfedgeId) -> bool) -> IdVec<EdgeId, bool> {
        let topology = &self.cleaned.topology;
        let is_one = |e| {
            let h = topology.halfedge(e);
            topology.twin(h).is_some_and(|twin| holds(h, twin))
        };
        topology.edge_ids().map(is_one).collect()
    }
}

/// The weighted mean of what corners have. A corner without weight does not count, even if it has nothing.
pub(crate) fn interpolate<const N: usize>(weights: DVec3, values: &[[f64; N]; 3]) -> [f64; N] {
    let parts = |i: usize| (0..3).filter(move |&c| weights[c] != 0.0).map(move |c| (weights[c], values[c][i]));
    std::array::from_fn(|i| match parts(i).next() {
        // A corner's own value comes out as it is.
        Some((1.0, value)) if parts(i).count() == 1 => value,
        _ => parts(i).map(|(weight, value)| weight * value).sum(),
    })
}
