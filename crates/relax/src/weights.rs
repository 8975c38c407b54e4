//! Weights of the neighbours in the centroid (paper, section 4.3.2).

use crate::Weights;
use crate::movable_domain::each;
use mesh_core::{HalfedgeId, IdVec, VertexId};
use region_map::{Attachment, Domain, Surface};
use std::f64::consts::FRAC_PI_3;

/// Triangles round a regular vertex inside a sheet.
const INSIDE: f64 = 6.0;
/// Triangles on each side of a regular vertex on an arc; a border has one side.
const BESIDE_ARC: f64 = 3.0;
/// A vertex that has fewer or more triangles than its place asks for by this much is not regular. At a corner the number that the place asks for
/// is rarely whole.
const REGULAR: f64 = 0.51;
/// Weights are smooth when none changes by more than this share of itself from one sweep to the next. Less takes more sweeps.
const SMOOTH: f64 = 1e-3;
/// Sweeps at most; more reach farther than any base triangle of a few levels.
const MOST_SWEEPS: usize = 1000;

/// The weight of every vertex, positive.
///
/// The domain is one of this surface ([`Domain::check`]).
pub(crate) fn vertex_weights(surface: &Surface, domain: &Domain, weights: Weights) -> IdVec<VertexId, f64> {
    match weights {
        Weights::Uniform => IdVec::filled(1.0, domain.topology.n_vertices()),
        Weights::Adaptive => adaptive(surface, domain),
    }
}

/// The cube of the valence at irregular vertices, as if all places asked for six triangles, and smooth between them.
///
/// The paper averages the neighbours' *valences* once, which undoes the cube that it has just taken; here it is their weights, until these are
/// smooth. And the paper takes 6 for the ideal valence everywhere; a regular vertex on a border would then be an irregular one.
fn adaptive(surface: &Surface, domain: &Domain) -> IdVec<VertexId, f64> {
    let n = domain.topology.n_vertices();
    let crowding: Vec<Crowding> = each(n, |v| Crowding::at(surface, domain, v));
    let mut weights: IdVec<VertexId, f64> = crowding.iter().map(|c| (INSIDE * c.ratio).powi(3)).collect();
    let crowding: IdVec<VertexId, Crowding> = IdVec::from_vec(crowding);
    let mean = |weights: &IdVec<VertexId, f64>, v: VertexId| {
        let (sum, n) = domain.topology.one_ring(v).fold((0.0, 0), |(sum, n), w| (sum + weights[w], n + 1));
        if crowding[v].is_regular && n > 0 { sum / f64::from(n) } else { weights[v] }
    };
    for _ in 0..MOST_SWEEPS {
        let next: IdVec<VertexId, f64> = IdVec::from_vec(each(n, |v| mean(&weights, v)));
        let is_smooth = weights.iter().zip(&next).all(|(before, after)| (after - before).abs() <= SMOOTH * before);
        weights = next;
        if is_smooth || surface.interrupt().is_set() {
            break;
        }
    }
    weights
}

/// How many triangles a vertex has, against what its place asks for.
#[derive(Clone, Copy)]
struct Crowding {
    /// The one over the other: 1 at a regular vertex.
    ratio: f64,
    is_regular: bool,
}

impl Crowding {
    fn at(surface: &Surface, domain: &Domain, v: VertexId) -> Self {
        let sides = sides(domain, v);
        let (triangles, ideal) = match domain.region.attachments[v] {
            Attachment::Sheet(_) => (sides, INSIDE),
            Attachment::Arc { .. } => (sides, BESIDE_ARC),
            Attachment::Corner(c) => {
                let angle = surface.topology().fan(surface.network().corners[c]).map(|h| angle(surface, h)).sum::<f64>();
                (vec![sides.iter().sum()], (angle / FRAC_PI_3).max(1.0))
            }
        };
        let ratio = triangles.iter().map(|&n| n as f64 / ideal).sum::<f64>() / triangles.len().max(1) as f64;
        Self { ratio, is_regular: triangles.iter().all(|&n| (n as f64 - ideal).abs() < REGULAR) }
    }
}

/// The number of triangles on each side of the arcs at a vertex; all of them where it is on none.
fn sides(domain: &Domain, v: VertexId) -> Vec<usize> {
    let fan: Vec<HalfedgeId> = domain.topology.fan(v).collect();
    let is_on_arc = |h: HalfedgeId| domain.region.span(v, domain.topology.to(h)).is_some();
    let start = fan.iter().position(|&h| is_on_arc(h)).unwrap_or(0);
    let mut sides: Vec<usize> = Vec::new();
    for &h in fan[start..].iter().chain(&fan[..start]) {
        match sides.last_mut() {
            Some(last) if !is_on_arc(h) => *last += 1,
            _ => sides.push(1),
        }
    }
    sides
}

/// The angle of a face of the surface at the start of one of its halfedges, in radians.
fn angle(surface: &Surface, h: HalfedgeId) -> f64 {
    let (mesh, topology) = (surface.mesh(), surface.topology());
    let [at, to, opposite] = [topology.from(h), topology.to(h), topology.opposite(h)].map(|v| mesh.position(v));
    (to - at).angle_between(opposite - at)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use mesh_core::{Topology, TriMesh};
    use region_map::{ArcKind, Network};

    /// The weights of a surface as a domain over itself.
    fn weights(surface: &Surface) -> (Domain, IdVec<VertexId, f64>) {
        let domain = Domain::identity(surface);
        let weights = vertex_weights(surface, &domain, Weights::Adaptive);
        (domain, weights)
    }

    #[test]
    fn uniform_weights_are_one() {
        let surface = Surface::smooth(fixtures::icosphere(1)).unwrap();
        let domain = Domain::identity(&surface);
        assert!(vertex_weights(&surface, &domain, Weights::Uniform).iter().all(|&w| w == 1.0));
    }

    /// An icosahedron has twelve vertices of valence 5 and nothing else: all weights between them are theirs, where the paper's single average
    /// leaves 216 two edges away.
    #[test]
    fn weights_between_irregular_vertices_are_diffused_until_they_are_smooth() {
        let surface = Surface::smooth(fixtures::icosphere(8)).unwrap();
        let (domain, weights) = weights(&surface);
        let (irregular, regular): (Vec<_>, Vec<_>) = weights.enumerate().partition(|(v, _)| domain.topology.valence(*v) == 5);
        assert!(irregular.len() == 12 && irregular.iter().all(|(_, w)| **w == 125.0));
        assert!(
            regular.iter().all(|(_, w)| (125.0..140.0).contains(*w)),
            "{:?}",
            regular.iter().map(|r| r.1).max_by(|a, b| a.total_cmp(b))
        );
    }

    /// A strip of equilateral triangles, three rows high: borders have half of the triangles, corners a third or a sixth, and yet all weights are
    /// those of a regular vertex.
    #[test]
    fn borders_and_corners_are_regular_in_a_regular_triangulation() {
        let up = DVec3::new(0.5, 0.75f64.sqrt(), 0.0);
        let positions: Vec<[f64; 3]> =
            (0..4).flat_map(|y| (0..5).map(move |x| (DVec3::X * f64::from(x) + up * f64::from(y)).to_array())).collect();
        let cell = |x: u32, y: u32| [[0, 1, 5], [1, 6, 5]].map(|t| t.map(|v| v + x + 5 * y));
        let faces: Vec<[u32; 3]> = (0..3).flat_map(|y| (0..4).flat_map(move |x| cell(x, y))).collect();
        let mesh = TriMesh::from_slices(&positions, &faces).unwrap();
        let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
        let (borders, is_corner) = (ArcKind::by_angle(&mesh, &topology, 40.0), |v: VertexId| [0, 4, 15, 19].contains(&v.0));
        let network = Network::trace(&mesh, &topology, &borders, is_corner, Vec::new()).unwrap();
        let surface = Surface::new(mesh, topology, network).unwrap();
        let (_, weights) = weights(&surface);
        assert!(weights.iter().all(|w| (w - 216.0).abs() < 1e-9), "{weights:?}");
    }

    /// A vertex on a crease with three triangles on one side and five on the other is not regular: the mean of both sides counts.
    #[test]
    fn both_sides_of_a_crease_count() {
        // A roof: its ridge from (-1, 0, 1) over the apex to (1, 0, 1), eaves on both sides at height 0.
        let left = [[-1.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
        let right = [[-1.0, -1.0, 0.0], [-0.4, -1.0, 0.0], [0.4, -1.0, 0.0], [1.0, -1.0, 0.0]];
        let mut positions = vec![[0.0, 0.0, 1.0], [-1.0, 0.0, 1.0], [1.0, 0.0, 1.0]];
        positions.extend(left);
        positions.extend(right);
        // Round vertex 0, counter-clockwise from above: 2, 4, 3, 1, 5, 6, 7, 8.
        let ring = [2, 4, 3, 1, 5, 6, 7, 8];
        let faces: Vec<[u32; 3]> = (0..8).map(|i| [0, ring[i], ring[(i + 1) % 8]]).collect();
        let surface = Surface::with_creases(TriMesh::from_slices(&positions, &faces).unwrap(), 40.0).unwrap();
        let domain = Domain::identity(&surface);
        let mut counts = sides(&domain, VertexId(0));
        counts.sort_unstable();
        assert_eq!(counts, [3, 5]);
        assert!(matches!(domain.region.attachments[VertexId(0)], Attachment::Arc { .. }));
        let crowding = Crowding::at(&surface, &domain, VertexId(0));
        assert!(!crowding.is_regular && (crowding.ratio - 8.0 / 6.0).abs() < 1e-12);
    }
}
