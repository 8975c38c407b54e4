//! Where the corners of a mesh are on the mesh that it was made of.

use crate::Source;
use glam::DVec3;
use mesh_core::{EdgeId, FaceId, IdVec, SurfaceIndex, SurfacePoint, TriMesh, barycentric, closest_on_triangle};
use rayon::prelude::*;
use rustc_hash::FxHashSet;

/// Where the faces and corners of a mesh are on the triangles of the source's soup.
#[derive(Clone, Debug, PartialEq)]
pub struct Correspondence {
    /// The triangles at the middles of the equal parts of each face, that at its own middle first.
    pub parts: Vec<[u32; PARTS]>,
    /// The triangle that each corner of each face has its values from.
    pub triangles: Vec<[u32; 3]>,
    /// Barycentric coordinates of the corner in that triangle, of sum 1. Some are negative where the face reaches over a cut or a border.
    pub barycentric: Vec<[[f64; 3]; 3]>,
}

/// Equal parts of a face by which its share in triangles is measured: those of two subdivisions.
pub const PARTS: usize = 16;

/// How far corners are pulled towards the middle of their face to find their side of a cut, as a share of the way.
const PULL: f64 = 0.05;
/// Faces within so many times the distance of the farthest corner from the middle are looked at.
const REACH: f64 = 1.1;
/// A face that faces along is taken instead of the nearest one as long as it is no farther than this many sizes of the face.
const OTHER_SIDE: f64 = 1.0;
/// Beyond a border values go on linearly, up to weights of this size. More would come of slivers alone, and then the border's own value counts.
const MOST_BEYOND: f64 = 20.0;
/// A weight that is nothing.
const ON_SIDE: f64 = 1e-9;

/// Finds where the faces of `mesh` are on the source, by the nearest points that face the same way.
///
/// All corners of a face come from the part of the source around its middle that no cut separates from it (`cuts`, by edges of the cleaned mesh):
/// a face never has its values from both sides. Where it reaches over a cut, the values of its side go on linearly.
pub fn correspond(source: &Source, cuts: &IdVec<EdgeId, bool>, mesh: &TriMesh) -> Correspondence {
    let finder = Finder { source, cuts, index: source.index(), normals: source.cleaned.mesh.normals() };
    let faces: Vec<FaceId> = mesh.faces().ids().collect();
    let found: Vec<Found> = faces.par_iter().map(|&f| finder.find(mesh, f)).collect();
    let triangle = |f: FaceId| source.cleaned.source_face[f];
    Correspondence {
        parts: found.iter().map(|found| found.parts.map(triangle)).collect(),
        triangles: found.iter().map(|found| found.corners.map(|(f, _)| triangle(f))).collect(),
        barycentric: found.iter().map(|found| found.corners.map(|(f, w)| source.in_triangle(f, w).to_array())).collect(),
    }
}

/// Where a face is on the cleaned mesh: the face at the middle of each part, and for each corner a face and weights in it.
struct Found {
    parts: [FaceId; PARTS],
    corners: [(FaceId, DVec3); 3],
}

struct Finder<'a> {
    source: &'a Source<'a>,
    cuts: &'a IdVec<EdgeId, bool>,
    index: &'a SurfaceIndex,
    normals: IdVec<FaceId, DVec3>,
}

impl Finder<'_> {
    fn find(&self, mesh: &TriMesh, f: FaceId) -> Found {
        let (centre, corners) = (mesh.centroid(f), mesh.triangle(f));
        let size = corners.iter().map(|p| p.distance(centre)).fold(0.0, f64::max);
        let (middle, off) = self.middle(centre, mesh.normal(f), size);
        let around = self.around(&[middle], centre, REACH * size + off);
        let corner = |p: DVec3| {
            let pulled = p.lerp(centre, PULL);
            let (side, off) = self.nearest(&around, pulled);
            let near = self.around(&[side], p, REACH * p.distance(pulled) + off.max(self.nearest(&around, p).1));
            let (face, _) = self.nearest(&near, p);
            (face, self.weights(face, p))
        };
        let mut parts = middles_of_parts(corners).map(|p| self.nearest(&around, p).0);
        parts[0] = middle;
        Found { parts, corners: corners.map(corner) }
    }

    /// The face at the middle of a face of this normal and size, and its distance.
    fn middle(&self, centre: DVec3, normal: DVec3, size: f64) -> (FaceId, f64) {
        let nearest = self.index.closest(centre).map_or((FaceId(0), 0.0), |c| (c.face, c.distance));
        if self.normals[nearest.0].dot(normal) > 0.0 {
            return nearest;
        }
        let reach = nearest.1 + OTHER_SIDE * size;
        let along = self.index.closest_within_where(centre, reach, |f| self.normals[f].dot(normal) > 0.0);
        along.map_or(nearest, |c| (c.face, c.distance))
    }

    /// The faces that are within a distance of a point and connected to the first ones by others that are, without a cut between; the first ones are
    /// always there.
    fn around(&self, first: &[FaceId], point: DVec3, distance: f64) -> Vec<FaceId> {
        let topology = &self.source.cleaned.topology;
        let mut seen: FxHashSet<FaceId> = first.iter().copied().collect();
        let (mut found, mut next) = (first.to_vec(), 0);
        while let Some(&f) = found.get(next) {
            next += 1;
            for h in topology.halfedges(f) {
                let Some(twin) = topology.twin(h).filter(|_| !self.cuts[topology.edge(h)]) else { continue };
                let g = twin.face();
                if seen.insert(g) && self.distance(g, point) <= distance {
                    found.push(g);
                }
            }
        }
        found
    }

    fn distance(&self, f: FaceId, point: DVec3) -> f64 {
        let barycentric = closest_on_triangle(point, self.source.cleaned.mesh.triangle(f));
        SurfacePoint { face: f, barycentric }.position(&self.source.cleaned.mesh).distance(point)
    }

    /// The nearest of some faces, and its distance; of equal ones that of lowest number.
    fn nearest(&self, faces: &[FaceId], point: DVec3) -> (FaceId, f64) {
        let measured = faces.iter().map(|&f| (f, self.distance(f, point)));
        measured.min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0))).unwrap_or((FaceId(0), 0.0))
    }

    /// Weights of the corners of a face at a point: those of its nearest point, but beyond a side where the surface or its values end, those that go on
    /// linearly.
    fn weights(&self, f: FaceId, point: DVec3) -> DVec3 {
        let (topology, triangle) = (&self.source.cleaned.topology, self.source.cleaned.mesh.triangle(f));
        let nearest = closest_on_triangle(point, triangle);
        let ends_at_side = topology.halfedges(f).into_iter().any(|h| {
            let is_end = topology.is_border_edge(topology.edge(h)) || self.cuts[topology.edge(h)];
            is_end && nearest[(h.corner() + 2) % 3].abs() < ON_SIDE
        });
        let beyond = barycentric(point, triangle);
        if ends_at_side && beyond.abs().max_element() <= MOST_BEYOND { beyond } else { nearest }
    }
}

/// The middles of the equal parts of a triangle, its own first.
fn middles_of_parts([a, b, c]: [DVec3; 3]) -> [DVec3; PARTS] {
    let quarters = |[a, b, c]: [DVec3; 3]| {
        let (ab, bc, ca) = (a.midpoint(b), b.midpoint(c), c.midpoint(a));
        [[bc, ca, ab], [a, ab, ca], [b, bc, ab], [c, ca, bc]]
    };
    let mut middles = quarters([a, b, c]).into_iter().flat_map(quarters).map(|[a, b, c]| (a + b + c) / 3.0);
    std::array::from_fn(|_| middles.next().unwrap_or(a))
}

impl Source<'_> {
    /// Weights in a face of the cleaned mesh as weights in its triangle of the soup.
    fn in_triangle(&self, f: FaceId, weights: DVec3) -> DVec3 {
        let [a, b, c] = self.corners[f];
        weights.x * a + weights.y * b + weights.z * c
    }
}
