//! [`Raised`]: vertices that stand a little off the surface, so that the triangles at them have an area.

use crate::badness::badness;
use certify::{Faults, Reference, faulty_faces_among};
use glam::DVec3;
use mesh_core::{FaceId, TriMesh, VertexId};
use region_map::{Attachment, Domain, Surface};
use std::collections::{BTreeMap, BTreeSet};

/// A vertex stands at most this share of the input's diagonal off the surface, about as far as the fit moves some. More pulls triangles
/// onto sheets beside their own: with .002 a figure was .006 from the input at its mouth. With less, more results are refused.
const MOST: f64 = 6e-4;
/// Offsets that are tried each way: the greatest, half of it, and so on.
const TRIED: i32 = 8;
/// Passes over the vertices at most.
const PASSES: usize = 4;
/// Where a greater share of the triangles is faulty the base mesh is wrong.
const MOST_FAULTY: f64 = 0.02;

/// Offsets of vertices along the surface's normals at their points, in the units of the mesh, positive outwards. Only vertices inside sheets have any:
/// corners and arcs are kept exactly.
///
/// A scan may have threads and fins that are a thousandth of an edge thick. All triangles on such a thread are without area on any base mesh that one
/// would wish for, and no place on the surface is better than another. A hundredth of an edge off it there is room.
#[derive(Clone, Debug, Default)]
pub(crate) struct Raised(BTreeMap<VertexId, f64>);

impl Raised {
    /// Raises vertices of the triangles that the certificate would refuse, where that leaves fewer of them. Returns what is left, too.
    pub(crate) fn new(input: &Reference, surface: &Surface, domain: &Domain, faults: Faults) -> (Self, Faults) {
        let faces = faults.faces();
        if faces.is_empty() || faces.len() as f64 > MOST_FAULTY * domain.mesh.n_faces() as f64 {
            return (Self::default(), faults);
        }
        let mut raising = Raising { input, surface, domain, offsets: BTreeMap::new() };
        let mut faulty = faces.clone();
        for _ in 0..PASSES {
            let corners: BTreeSet<VertexId> = faulty.iter().flat_map(|&f| domain.mesh.face(f)).collect();
            corners.iter().for_each(|&v| raising.raise(v));
            faulty = faces_at(domain, corners).into_iter().filter(|&f| raising.badness(f) > 0.0).collect();
            if faulty.is_empty() {
                break;
            }
        }
        let raised = Self(raising.offsets.iter().map(|(&v, &offset)| (v, offset)).filter(|(_, offset)| *offset != 0.0).collect());
        let looked_at = [faces, raised.faces(domain)].concat();
        let left = faulty_faces_among(input, &raised.mesh(surface, domain), &looked_at);
        if left.faces().len() < faults.faces().len() { (raised, left) } else { (Self::default(), faults) }
    }

    /// The triangles at raised vertices, in rising order.
    pub(crate) fn faces(&self, domain: &Domain) -> Vec<FaceId> {
        faces_at(domain, self.0.keys().copied()).into_iter().collect()
    }

    /// The mesh of a domain with these vertices raised; all of them are at their points of the surface before.
    pub(crate) fn mesh(&self, surface: &Surface, domain: &Domain) -> TriMesh {
        let mut positions = domain.mesh.positions().clone();
        for (&v, &offset) in &self.0 {
            positions[v] += offset * normal(surface, domain, v);
        }
        domain.mesh.with_positions(positions.into_vec()).unwrap_or_else(|_| domain.mesh.clone())
    }

    /// The vertices with their offsets.
    pub(crate) fn offsets(&self) -> impl Iterator<Item = (VertexId, f64)> {
        self.0.iter().map(|(&v, &offset)| (v, offset))
    }

    /// Greatest size of an offset.
    pub(crate) fn greatest(&self) -> f64 {
        self.0.values().fold(0.0, |most: f64, offset| most.max(offset.abs()))
    }

    /// What to tell of them; `None` where no vertex is raised.
    pub(crate) fn warning(&self, diagonal: f64) -> Option<String> {
        let percent = 100.0 * self.greatest() / diagonal;
        let n = self.0.len();
        (n > 0).then(|| format!("{n} vertices stand up to {percent:.4} % of the diagonal off the surface, where triangles on it would have no area"))
    }
}

/// The triangles at some vertices.
fn faces_at(domain: &Domain, vertices: impl IntoIterator<Item = VertexId>) -> BTreeSet<FaceId> {
    vertices.into_iter().flat_map(|v| domain.topology.faces_at(v)).collect()
}

/// The normal that a vertex is raised along.
fn normal(surface: &Surface, domain: &Domain, v: VertexId) -> DVec3 {
    surface.normals().at(domain.region.points[v])
}

/// Vertices that are being raised.
struct Raising<'a> {
    input: &'a Reference,
    surface: &'a Surface,
    domain: &'a Domain,
    offsets: BTreeMap<VertexId, f64>,
}

impl Raising<'_> {
    /// Gives a vertex the offset that makes its triangles best, the least of equals. None to one at a corner or on an arc.
    fn raise(&mut self, v: VertexId) {
        if !matches!(self.domain.region.attachments[v], Attachment::Sheet(_)) {
            return;
        }
        let most = MOST * self.input.diagonal();
        let sizes = (0..TRIED).rev().map(|halvings| most * 0.5f64.powi(halvings));
        let mut best = (f64::INFINITY, 0.0);
        for offset in [0.0].into_iter().chain(sizes.flat_map(|size| [size, -size])) {
            self.offsets.insert(v, offset);
            let badness = faces_at(self.domain, [v]).into_iter().map(|f| self.badness(f)).sum();
            if badness < best.0 {
                best = (badness, offset);
            }
        }
        self.offsets.insert(v, best.1);
    }

    fn badness(&self, f: FaceId) -> f64 {
        badness(self.input, self.domain.mesh.face(f).map(|v| self.position(v)))
    }

    fn position(&self, v: VertexId) -> DVec3 {
        let offset = self.offsets.get(&v).map(|offset| offset * normal(self.surface, self.domain, v));
        self.domain.mesh.position(v) + offset.unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use certify::faulty_faces;

    /// A tube of five sides, closed by a point at each end, along x from -.1 to 1.
    fn tube(radius: f64) -> TriMesh {
        let around = |i: u32, x: f64| {
            let angle = f64::from(i) * std::f64::consts::TAU / 5.0;
            DVec3::new(x, radius * angle.cos(), radius * angle.sin())
        };
        let rings = [0.0, 0.3, 0.6, 0.9].into_iter().flat_map(|x| (0..5).map(move |i| around(i, x)));
        let positions = rings.chain([DVec3::new(-0.1, 0.0, 0.0), DVec3::X]).collect();
        let side = |k: u32, i: u32| {
            let [a, b, c, d] = [5 * k + i, 5 * k + (i + 1) % 5, 5 * k + 5 + (i + 1) % 5, 5 * k + 5 + i];
            [[a, c, b], [a, d, c]]
        };
        let sides = (0..3).flat_map(|k| (0..5).flat_map(move |i| side(k, i)));
        let ends = (0..5).flat_map(|i| [[i, (i + 1) % 5, 20], [15 + (i + 1) % 5, 15 + i, 21]]);
        TriMesh::new(positions, sides.chain(ends).collect()).unwrap()
    }

    /// All triangles of a tube that is thin as a thread are without area. The sphere beside it says how thin that is.
    #[test]
    fn the_triangles_of_a_thread_get_an_area() {
        let (thread, sphere) = (tube(1e-5), fixtures::icosphere(12));
        let n = thread.n_vertices() as u32;
        let beside = sphere.positions().iter().map(|p| 40.0 * *p + DVec3::splat(60.0));
        let positions = thread.positions().iter().copied().chain(beside).collect();
        let faces = thread.faces().iter().map(|f| f.map(|v| v.0)).chain(sphere.faces().iter().map(|f| f.map(|v| v.0 + n)));
        let mesh = TriMesh::new(positions, faces.collect()).unwrap();
        let surface = Surface::smooth(mesh.clone()).unwrap();
        let domain = Domain::identity(&surface);
        let input = Reference::new(mesh.clone()).unwrap();
        let faults = faulty_faces(&input, &mesh);
        assert_eq!(faults.degenerate.len(), thread.n_faces());

        let (raised, left) = Raised::new(&input, &surface, &domain, faults);
        let after = raised.mesh(&surface, &domain);
        assert!(left.is_empty() && faulty_faces(&input, &after).is_empty(), "{left:?}");
        assert!(raised.warning(input.diagonal()).is_some());
        let moved = |v: VertexId| mesh.position(v).distance(after.position(v));
        assert!(mesh.positions().ids().all(|v| moved(v) <= 1.001 * MOST * input.diagonal()));
        assert!(mesh.positions().ids().skip(n as usize).all(|v| moved(v) == 0.0));
    }

    /// A fold as large as its triangles is none that an offset mends: nothing moves.
    #[test]
    fn what_does_not_help_is_left_out() {
        let mesh = fixtures::icosphere(8);
        let surface = Surface::smooth(mesh.clone()).unwrap();
        let input = Reference::new(mesh.clone()).unwrap();
        let mut positions = mesh.positions().clone();
        let folded = mesh.face(FaceId(7));
        let [p, q] = [positions[folded[0]], positions[folded[1]]];
        positions[folded[0]] = q + 0.5 * (q - p);
        let domain = Domain { mesh: mesh.with_positions(positions.into_vec()).unwrap(), ..Domain::identity(&surface) };
        let faults = faulty_faces(&input, &domain.mesh);
        assert!(!faults.is_empty() && faults.faces().len() < 12);
        let (raised, left) = Raised::new(&input, &surface, &domain, faults.clone());
        assert!(raised.warning(1.0).is_none() && left == faults, "{left:?}");
    }
}
