//! [`nudged`]: vertices moved on the surface, so that the certificate refuses fewer triangles.

use crate::badness::badness;
use certify::Reference;
use glam::DVec3;
use mesh_core::{FaceId, IdVec, SurfacePoint, VertexId, walk_end, ways_around};
use region_map::{Attachment, Domain, RegionMap, Surface};
use std::collections::BTreeSet;

/// A vertex tries places in so many directions. More find more ways out, and take as much longer.
const DIRECTIONS: usize = 12;
/// How far away these places are, as shares of the mean length of the vertex' edges: from next to it to beyond its neighbours.
const REACHES: [f64; 5] = [0.02, 0.08, 0.25, 0.6, 1.2];
/// Passes over the vertices at most; each takes what the one before made possible.
const PASSES: usize = 12;
/// Where a greater share of the triangles is faulty the base mesh is wrong.
const MOST_FAULTY: f64 = 0.02;
/// A vertex at the same vertex of the surface as another one is worse than a triangle that faces against the input.
const WELDED: f64 = 2.0;

/// A domain whose vertices inside sheets have moved a little, near `faulty` triangles that the certificate would refuse, and near vertices that are
/// [`welded`]. `None` where none has moved.
///
/// The relaxation goes by the normals at the corners of a triangle. On the noise of a scan there are vertices whose normal opposes some of the faces
/// around: whatever it does, triangles stay folded for it there. The certificate looks at the face nearest to the middle of a triangle, and so does this.
pub(crate) fn nudged(input: &Reference, surface: &Surface, domain: &Domain, mut faulty: Vec<FaceId>) -> Option<Domain> {
    faulty.extend(welded(surface, domain).into_iter().flat_map(|v| domain.topology.faces_at(v)));
    if faulty.is_empty() || faulty.len() as f64 > MOST_FAULTY * domain.mesh.n_faces() as f64 {
        return None;
    }
    let mut nudging = Nudging::new(input, surface, domain);
    for _ in 0..PASSES {
        let around: BTreeSet<VertexId> = domain.topology.widened(&faulty, 1).iter().flat_map(|&f| domain.mesh.face(f)).collect();
        // All of them are tried, whatever comes of the first.
        if around.into_iter().filter(|&v| nudging.nudge(v)).count() == 0 {
            break;
        }
        faulty = domain.topology.widened(&faulty, 2).into_iter().filter(|&f| nudging.is_faulty(f)).collect();
    }
    if nudging.points == domain.region.points {
        return None;
    }
    domain.placed(surface, RegionMap { points: nudging.points, ..domain.region.clone() }).ok()
}

/// The vertices inside sheets that are at the same vertex of the surface as another one, such as the tip of a spike that many ways over the surface
/// lead to: the certificate would weld them.
pub(crate) fn welded(surface: &Surface, domain: &Domain) -> Vec<VertexId> {
    let (region, n_at) = (&domain.region, n_at(surface, &domain.region.points));
    let is_inside = |v: VertexId| matches!(region.attachments[v], Attachment::Sheet(_));
    region.vertices().filter(|&v| is_inside(v) && is_shared(surface, &n_at, region.points[v])).collect()
}

/// How many of some points are at each vertex of the surface.
fn n_at(surface: &Surface, points: &IdVec<VertexId, SurfacePoint>) -> IdVec<VertexId, u32> {
    let mut n_at = IdVec::filled(0, surface.mesh().n_vertices());
    points.iter().filter_map(|&point| vertex_at(surface, point)).for_each(|w| n_at[w] += 1);
    n_at
}

/// Whether a point with a vertex is at a vertex of the surface, and others are there, too.
fn is_shared(surface: &Surface, n_at: &IdVec<VertexId, u32>, point: SurfacePoint) -> bool {
    vertex_at(surface, point).is_some_and(|w| n_at[w] > 1)
}

/// Vertices that are being nudged.
struct Nudging<'a> {
    input: &'a Reference,
    surface: &'a Surface,
    domain: &'a Domain,
    positions: IdVec<VertexId, DVec3>,
    points: IdVec<VertexId, SurfacePoint>,
    /// How many vertices are at each vertex of the surface.
    n_at: IdVec<VertexId, u32>,
}

impl<'a> Nudging<'a> {
    fn new(input: &'a Reference, surface: &'a Surface, domain: &'a Domain) -> Self {
        let (positions, points) = (domain.mesh.positions().clone(), domain.region.points.clone());
        let n_at = n_at(surface, &points);
        Self { input, surface, domain, positions, points, n_at }
    }

    fn is_shared(&self, v: VertexId) -> bool {
        is_shared(self.surface, &self.n_at, self.points[v])
    }

    fn is_faulty(&self, f: FaceId) -> bool {
        self.badness(f) > 0.0 || self.domain.mesh.face(f).into_iter().any(|v| self.is_shared(v))
    }

    /// Puts a vertex to a point of the surface.
    fn put(&mut self, v: VertexId, point: SurfacePoint) {
        if let Some(w) = vertex_at(self.surface, self.points[v]) {
            self.n_at[w] -= 1;
        }
        (self.positions[v], self.points[v]) = (point.position(self.surface.mesh()), point);
        if let Some(w) = vertex_at(self.surface, point) {
            self.n_at[w] += 1;
        }
    }

    /// Moves a vertex inside a sheet to the place that leaves its triangles best, if one is better than its own.
    fn nudge(&mut self, v: VertexId) -> bool {
        if !matches!(self.domain.region.attachments[v], Attachment::Sheet(_)) {
            return false;
        }
        let before = self.points[v];
        let Some(mut least) = self.badness_at(v, f64::INFINITY).filter(|badness| *badness > 0.0) else { return false };
        let (mesh, topology, network) = (self.surface.mesh(), self.surface.topology(), self.surface.network());
        let mut best = before;
        for way in self.ways(v) {
            let point = walk_end(mesh, topology, before, way, |e| !network.is_barrier(e));
            self.put(v, point);
            if let Some(badness) = self.badness_at(v, least) {
                (least, best) = (badness, point);
            }
        }
        self.put(v, best);
        best != before
    }

    /// Displacements that a vertex tries: half the way and all the way to the middle of its neighbours, and all around in the plane of its face.
    fn ways(&self, v: VertexId) -> Vec<DVec3> {
        let ring: Vec<DVec3> = self.domain.topology.one_ring(v).map(|w| self.positions[w] - self.positions[v]).collect();
        let ways = ways_around(&ring, self.surface.mesh().normal(self.points[v].face), DIRECTIONS, &REACHES);
        std::iter::once(0.5 * ways[0]).chain(ways).collect()
    }

    /// How bad a vertex and the triangles at it are together; `None` where that is not less than `least`.
    fn badness_at(&self, v: VertexId, least: f64) -> Option<f64> {
        let mut faces = self.domain.topology.faces_at(v);
        let start = if self.is_shared(v) { WELDED } else { 0.0 };
        let sum = faces.try_fold(start, |sum, f| Some(sum + self.badness(f)).filter(|sum| *sum < least))?;
        (sum < least).then_some(sum)
    }

    fn badness(&self, f: FaceId) -> f64 {
        badness(self.input, self.domain.mesh.face(f).map(|v| self.positions[v]))
    }
}

/// The vertex of the surface that a point is at.
fn vertex_at(surface: &Surface, point: SurfacePoint) -> Option<VertexId> {
    (point.barycentric.max_element() == 1.0).then(|| point.nearest_vertex(surface.mesh()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use certify::faulty_faces;
    use mesh_core::TriMesh;

    /// A surface with itself as the domain, and these vertices walked so far over the surface.
    fn walked(mesh: &TriMesh, ways: &[(VertexId, DVec3)]) -> (Reference, Surface, Domain) {
        let surface = Surface::smooth(mesh.clone()).unwrap();
        let domain = Domain::identity(&surface);
        let mut region = domain.region.clone();
        for &(v, way) in ways {
            region.points[v] = walk_end(mesh, surface.topology(), region.points[v], way, |_| true);
        }
        let domain = domain.placed(&surface, region).unwrap();
        (Reference::new(mesh.clone()).unwrap(), surface, domain)
    }

    /// Half as far again as to a neighbour.
    fn over_a_neighbour(mesh: &TriMesh, f: FaceId) -> (VertexId, DVec3) {
        let [v, w, _] = mesh.face(f);
        (v, 1.5 * (mesh.position(w) - mesh.position(v)))
    }

    #[test]
    fn folds_are_mended_and_what_is_far_from_them_stays() {
        let mesh = fixtures::icosphere(16);
        for f in [0, 7, 100, 1000].map(FaceId) {
            let (v, way) = over_a_neighbour(&mesh, f);
            let (input, surface, domain) = walked(&mesh, &[(v, way)]);
            let faults = faulty_faces(&input, &domain.mesh);
            assert!(!faults.is_empty());
            let after = nudged(&input, &surface, &domain, faults.faces()).unwrap();
            assert!(faulty_faces(&input, &after.mesh).is_empty());
            after.check(surface.network()).unwrap();
            let near = domain.topology.widened(&faults.faces(), 2 * PASSES);
            let near: BTreeSet<VertexId> = near.into_iter().flat_map(|f| mesh.face(f)).collect();
            let stays = |w: &VertexId| after.mesh.position(*w) == domain.mesh.position(*w);
            assert!(mesh.positions().ids().filter(|w| !near.contains(w)).all(|w| stays(&w)));
            assert!(domain.topology.one_ring(v).any(|w| stays(&w)), "more moves than has to");
        }
    }

    /// Corners and arcs are kept exactly: a fold that only they could mend stays.
    #[test]
    fn vertices_at_corners_and_on_arcs_stay() {
        let mesh = fixtures::cube(2);
        let surface = {
            let smooth = Surface::smooth(mesh.clone()).unwrap();
            let options = features::FeatureOptions::default();
            let network = features::detect(smooth.mesh(), smooth.topology(), &[], 0.0, &options).unwrap();
            smooth.with_network(network).unwrap()
        };
        let mut domain = Domain::identity(&surface);
        let is_corner = |v: &VertexId| matches!(domain.region.attachments[*v], Attachment::Corner(_));
        let corner = mesh.positions().ids().find(is_corner).unwrap();
        let mut positions = domain.mesh.positions().clone();
        let beside = domain.topology.one_ring(corner).next().unwrap();
        positions[corner] = positions[beside] + 0.5 * (positions[beside] - positions[corner]);
        domain.mesh = domain.mesh.with_positions(positions.into_vec()).unwrap();
        let input = Reference::new(mesh).unwrap();
        let mut nudging = Nudging::new(&input, &surface, &domain);
        assert!(domain.topology.faces_at(corner).any(|f| nudging.badness(f) > 0.0));
        assert!(!nudging.nudge(corner));
        for v in domain.topology.one_ring(corner).filter(|v| !matches!(domain.region.attachments[*v], Attachment::Sheet(_))) {
            assert!(!nudging.nudge(v));
        }
    }

    #[test]
    fn nothing_moves_where_nothing_is_faulty_or_too_much() {
        let mesh = fixtures::icosphere(4);
        let (input, surface, domain) = walked(&mesh, &[]);
        assert!(nudged(&input, &surface, &domain, Vec::new()).is_none());
        let ways: Vec<_> = (0..40).map(|f| over_a_neighbour(&mesh, FaceId(5 * f))).collect();
        let (input, surface, domain) = walked(&mesh, &ways);
        let faults = faulty_faces(&input, &domain.mesh);
        assert!(faults.faces().len() as f64 > MOST_FAULTY * mesh.n_faces() as f64);
        assert!(nudged(&input, &surface, &domain, faults.faces()).is_none());
    }

    /// Two vertices at one vertex of the surface would be welded: they part.
    #[test]
    fn vertices_at_one_vertex_of_the_surface_part() {
        let mesh = fixtures::icosphere(16);
        let (v, w) = (VertexId(300), VertexId(301));
        let surface = Surface::smooth(mesh.clone()).unwrap();
        let mut domain = Domain::identity(&surface);
        domain.region.points[v] = domain.region.points[w];
        let domain = domain.placed(&surface, domain.region.clone()).unwrap();
        let input = Reference::new(mesh.clone()).unwrap();
        assert_eq!(welded(&surface, &domain), [v, w]);
        let faulty = faulty_faces(&input, &domain.mesh).faces();
        let after = nudged(&input, &surface, &domain, faulty).unwrap();
        assert!(faulty_faces(&input, &after.mesh).is_empty());
        assert!(welded(&surface, &after).is_empty());
    }
}
