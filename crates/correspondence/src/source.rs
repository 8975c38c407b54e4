//! From the result to the input: a face for every vertex, and where it is over that face's plane.

use glam::DVec3;
use mesh_core::{
    Cleaned, FaceId, HalfedgeId, IdVec, Soup, SurfaceIndex, SurfacePoint, VertexId, barycentric, closest_on_triangle, normal,
    vector_area,
};
use std::sync::OnceLock;

/// Height over length of a triangle that is not asked for a normal where another one is near: rounding turns it.
const NEEDLE: f64 = 1e-6;
/// Steps downhill at most. A vertex goes on where its start is near it; more than a few steps are rare, and this ends what goes round in
/// a circle by rounding.
const MOST_STEPS: usize = 10_000;
/// A step downhill must come nearer by this share of the distance: less is rounding.
const NEARER: f64 = 1e-9;

/// A start is reached where it is this close to its face, as a share of the diagonal: coordinates of files are rounded by less.
const REACHED: f64 = 1e-6;
/// Faces look the same way where the cosine between their normals is above this.
const SAME_WAY: f64 = 0.5;

/// Where a vertex of the result is on the input's surface, about: the search for its face starts there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// A face of the cleaned mesh, on the same sheet as the vertex and near it.
    pub face: FaceId,
    /// The place of the surface that the vertex belongs to. The vertex itself may be off the surface.
    pub position: DVec3,
}

/// Where a vertex is over a triangle of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Over {
    /// The face of the cleaned mesh.
    pub(crate) face: FaceId,
    /// Barycentric coordinates, in the triangle as it was read, of the vertex's foot on its plane.
    pub(crate) barycentric: DVec3,
    /// How far the vertex is off that plane, along the normal of the triangle as it was read.
    pub(crate) offset: f64,
}

/// The input: as it was read, and as it was cleaned.
#[derive(Clone, Copy, Debug)]
pub struct Source<'a> {
    /// As it was read.
    pub soup: &'a Soup,
    /// What cleaning made of that soup.
    pub cleaned: &'a Cleaned,
}

/// Finds the triangles of the input that vertices are over.
pub(crate) struct Finder<'a> {
    soup: &'a Soup,
    cleaned: &'a Cleaned,
    /// The connected part of every face.
    part: IdVec<FaceId, u32>,
    reached: f64,
    /// Made when it is first needed, which it hardly ever is.
    index: OnceLock<SurfaceIndex>,
}

impl<'a> Finder<'a> {
    pub(crate) fn new(&Source { soup, cleaned }: &Source<'a>) -> Self {
        let (part, _) = cleaned.topology.components();
        Self { soup, cleaned, part, reached: REACHED * cleaned.mesh.diagonal(), index: OnceLock::new() }
    }

    /// What a vertex at `p` is over, where the result has this unit normal.
    ///
    /// The search goes from face to face, first downhill to where the vertex is on the surface, then to where that is nearest to `p`. So it
    /// never jumps to another sheet in the same place. The second way crosses no edge to a face that faces against the first.
    pub(crate) fn over(&self, start: Start, p: DVec3, normal: DVec3) -> Over {
        let on_surface = self.on_surface(start, normal);
        let facing = self.cleaned.mesh.normal(on_surface);
        let agrees = |f: FaceId| self.cleaned.mesh.normal(f).dot(facing) > 0.0;
        let nearest = self.downhill(on_surface, p, agrees);
        self.measured(self.with_normal(nearest, p, agrees), p)
    }

    /// The face where a start is on the surface.
    ///
    /// The way may end before a hole of a plane, in which the start has a face on the other side, or beside a rim that a flip went across. Then it
    /// goes on from the nearest face of the same part that faces as the result does there.
    fn on_surface(&self, start: Start, normal: DVec3) -> FaceId {
        let found = self.downhill(start.face, start.position, |_| true);
        let left = self.nearest(found, start.position).0;
        if left <= self.reached {
            return found;
        }
        let (mesh, index) = (&self.cleaned.mesh, self.index.get_or_init(|| SurfaceIndex::new(&self.cleaned.mesh)));
        let may_be = |f: FaceId| self.part[f] == self.part[start.face] && mesh.normal(f).dot(normal) > SAME_WAY;
        index.closest_within_where(start.position, left, may_be).map_or(found, |closest| closest.face)
    }

    /// The face from which no neighbour that may be entered is nearer to `p`.
    fn downhill(&self, start: FaceId, p: DVec3, may_enter: impl Fn(FaceId) -> bool) -> FaceId {
        let (mut face, (mut distance, mut weights)) = (start, self.nearest(start, p));
        for _ in 0..MOST_STEPS {
            let better = |f: &FaceId| may_enter(*f) && self.nearest(*f, p).0 < distance * (1.0 - NEARER);
            let mut neighbours = self.neighbours(face, weights);
            neighbours.retain(better);
            let by_distance = |f: &FaceId, g: &FaceId| self.nearest(*f, p).0.total_cmp(&self.nearest(*g, p).0).then(f.cmp(g));
            let Some(next) = neighbours.into_iter().min_by(by_distance) else { break };
            face = next;
            (distance, weights) = self.nearest(next, p);
        }
        face
    }

    /// The distance of a face from a point, and the weights of its point that is nearest.
    fn nearest(&self, f: FaceId, p: DVec3) -> (f64, DVec3) {
        let triangle = self.cleaned.mesh.triangle(f);
        let barycentric = closest_on_triangle(p, triangle);
        (SurfacePoint { face: f, barycentric }.interpolate(triangle).distance(p), barycentric)
    }

    /// The faces that share with a face its point with these weights: none inside, one across an edge, the fan at a corner.
    fn neighbours(&self, f: FaceId, weights: DVec3) -> Vec<FaceId> {
        let topology = &self.cleaned.topology;
        let is_zero = weights.to_array().map(|w| w == 0.0);
        match is_zero.iter().filter(|zero| **zero).count() {
            0 => Vec::new(),
            1 => {
                let opposite = is_zero.iter().position(|zero| *zero).unwrap_or(0);
                let across = topology.twin(HalfedgeId::of(f, (opposite + 1) % 3));
                across.map(HalfedgeId::face).into_iter().collect()
            }
            _ => self.fan(self.cleaned.mesh.face(f)[weights.max_position()]),
        }
    }

    fn fan(&self, v: VertexId) -> Vec<FaceId> {
        self.cleaned.topology.faces_at(v).collect()
    }

    /// The same face where its triangle is no needle; else, of those around it that are none, the nearest.
    fn with_normal(&self, f: FaceId, p: DVec3, agrees: impl Fn(FaceId) -> bool) -> FaceId {
        if !is_needle(self.triangle(f)) {
            return f;
        }
        let around = self.cleaned.mesh.face(f).into_iter().flat_map(|v| self.fan(v));
        let others = around.filter(|&g| agrees(g) && !is_needle(self.triangle(g)));
        let nearest = others.min_by(|&g, &h| self.nearest(g, p).0.total_cmp(&self.nearest(h, p).0).then(g.cmp(&h)));
        nearest.unwrap_or(f)
    }

    /// The triangle of a face as it was read.
    fn triangle(&self, f: FaceId) -> [DVec3; 3] {
        self.soup.triangles[self.cleaned.source_face[f] as usize].map(|v| self.soup.positions[v as usize])
    }

    /// Where a point is over the triangle of a face.
    fn measured(&self, face: FaceId, p: DVec3) -> Over {
        let triangle = self.triangle(face);
        let normal = normal(triangle);
        let offset = (p - triangle[0]).dot(normal);
        Over { face, barycentric: barycentric(p - offset * normal, triangle), offset }
    }
}

/// Whether a triangle is so flat that rounding turns its normal.
fn is_needle([a, b, c]: [DVec3; 3]) -> bool {
    let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
    let height = 2.0 * vector_area([a, b, c]).length();
    // What is not a number is a needle.
    height.is_nan() || longest.is_nan() || height <= NEEDLE * longest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_and_flat_triangles_are_no_needles_yet() {
        let triangle @ [a, b, _] = [[3.0, 2.0, 1.0], [4.0, 2.5, 1.25], [3.5, 2.25, 1.125 + 2e-6]].map(DVec3::from);
        assert!(is_needle([a, b, a.midpoint(b)]) && !is_needle(triangle));
    }
}
