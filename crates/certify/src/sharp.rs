//! The sharp edges that a person sees, and how much of their length a remeshed surface keeps.
//!
//! Many edges over 40 degrees are none that anybody would call sharp: the noise of a scan, or the horn of a cow in large triangles. An edge
//! is seen as sharp when the surface also turns between points at some distance on both sides of it, and when it goes on for a while.

use crate::creases::{ORIGINAL_CREASE_DEGREES, REMESHED_CREASE_DEGREES, dihedral, segment_index};
use crate::edges::{Edges, Side};
use crate::union_find::UnionFind;
use glam::DVec3;
use mesh_core::{FaceId, Id as _, SurfaceIndex, TriMesh, VertexId};
use rayon::prelude::*;

/// How far from an edge the surface is looked at, in mean edge lengths of the remeshed surface: what it can tell from a round edge.
const REACH: f64 = 0.75;
/// The least such distance, in diagonals: what a person can tell from a round edge in a picture of the whole. More takes narrow steps for round.
const LEAST_REACH: f64 = 0.002;
/// The greatest such distance, in diagonals. More looks at other parts than those beside the edge.
const GREATEST_REACH: f64 = 0.01;
/// Between both sides the surface turns by more than this, in degrees.
const LEAST_TURN: f64 = 30.0;
/// Connected sharp edges are at least this long, in diagonals.
const LEAST_LENGTH: f64 = 0.02;
/// A point is kept when a crease of the remeshed surface is nearer than this, in diagonals.
const NEAR: f64 = 2e-3;
/// A point is on an edge when it is nearer than this, in diagonals: rounding of a point on it is far less.
const ON: f64 = 1e-9;
/// Points on all sharp edges.
const SAMPLES: usize = 20_000;

/// The edges of a mesh that a person sees as sharp.
#[derive(Clone, Debug)]
pub struct SharpEdges {
    segments: Vec<[DVec3; 2]>,
    /// At equal distances along them.
    points: Vec<DVec3>,
    /// Their length, in the units of the mesh.
    length: f64,
    diagonal: f64,
}

/// What a remeshed surface keeps of sharp edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SharpCover {
    /// The share of their length that has a crease of the remeshed surface beside it.
    pub share: f64,
    /// Their length in the original, in diagonals.
    pub length: f64,
}

/// A cylinder has sharp edges of 3.6 diagonals, a cube of 7, a cow of 1 where its ears and legs begin.
const FEW: f64 = 1.5;

/// Share of the length of sharp edges that is kept where none is seen to be missing.
pub const ACCEPTED_SHARP_COVER: f64 = 0.98;
/// What is missing is hardly seen where it is shorter than this in all, in diagonals: half of the shortest edge that is seen as sharp.
const LITTLE: f64 = 0.01;

impl SharpCover {
    /// Whether nobody misses what is not kept.
    pub fn is_enough(self) -> bool {
        self.share >= ACCEPTED_SHARP_COVER || self.missing() < LITTLE
    }

    /// The length of what is not kept, in diagonals.
    pub fn missing(self) -> f64 {
        (1.0 - self.share) * self.length
    }

    /// Whether they are so short that they do not make the shape.
    pub fn are_few(self) -> bool {
        self.length < FEW
    }
}

impl SharpEdges {
    /// Those of an original, as far as a surface with edges of this mean length can tell them from round ones. The original is connected by
    /// index, and the length is in its units.
    pub fn new(original: &TriMesh, mean_edge: f64) -> Self {
        let diagonal = original.diagonal();
        let reach = (REACH * mean_edge).clamp(LEAST_REACH * diagonal, GREATEST_REACH * diagonal);
        let seen = seen(original, reach, LEAST_LENGTH * diagonal);
        Self { points: points_along(&seen), length: total_length(&seen), segments: seen, diagonal }
    }

    /// Which of some segments have their middle on them: of the edges of a refined original those that are parts of them.
    pub fn hold(&self, segments: &[[DVec3; 2]]) -> Vec<bool> {
        let Some(index) = segment_index(&self.segments) else { return vec![false; segments.len()] };
        let is_on = |[a, b]: &[DVec3; 2]| index.closest_within(a.midpoint(*b), ON * self.diagonal).is_some();
        segments.par_iter().map(is_on).collect()
    }

    /// No edges.
    pub fn none() -> Self {
        Self { segments: Vec::new(), points: Vec::new(), length: 0.0, diagonal: 0.0 }
    }

    /// Their length, in the units of the mesh.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// What a remeshed surface keeps of them; `None` where there are none.
    pub fn cover(&self, remeshed: &TriMesh) -> Option<SharpCover> {
        let n = self.points.len();
        let share = (n - self.uncovered(remeshed).len()) as f64 / n as f64;
        (n > 0).then_some(SharpCover { share, length: self.length / self.diagonal })
    }

    /// The faces of a remeshed surface where it has no crease beside them, in rising order. None where it keeps this share of their length.
    pub fn missed(&self, remeshed: &TriMesh, enough: f64) -> Vec<FaceId> {
        let uncovered = self.uncovered(remeshed);
        if uncovered.len() as f64 <= (1.0 - enough) * self.points.len() as f64 {
            return Vec::new();
        }
        let index = SurfaceIndex::new(remeshed);
        let mut faces: Vec<FaceId> = uncovered.into_par_iter().filter_map(|p| Some(index.closest(p)?.face)).collect();
        faces.sort_unstable();
        faces.dedup();
        faces
    }

    /// Points on them with no crease of a remeshed surface beside them.
    fn uncovered(&self, remeshed: &TriMesh) -> Vec<DVec3> {
        if self.points.is_empty() {
            return Vec::new();
        }
        let creases = creases(remeshed, REMESHED_CREASE_DEGREES);
        let Some(index) = segment_index(&creases.iter().map(|c| c.segment(remeshed)).collect::<Vec<_>>()) else {
            return self.points.clone();
        };
        let is_near = |p: &DVec3| index.closest(*p).is_some_and(|c| c.distance < NEAR * self.diagonal);
        self.points.par_iter().copied().filter(|p| !is_near(p)).collect()
    }
}

fn total_length(segments: &[[DVec3; 2]]) -> f64 {
    segments.iter().map(|[a, b]| a.distance(*b)).sum()
}

/// The mean length of the edges of a mesh, those of the border half as much as others; 0 without faces.
pub fn mean_edge(mesh: &TriMesh) -> f64 {
    let sides = mesh.faces().iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let sum: f64 = sides.map(|[a, b]| mesh.distance(a, b)).sum();
    sum / (3 * mesh.n_faces()).max(1) as f64
}

/// An edge of two faces.
struct Crease {
    ends: [VertexId; 2],
    faces: [FaceId; 2],
}

impl Crease {
    fn segment(&self, mesh: &TriMesh) -> [DVec3; 2] {
        self.ends.map(|v| mesh.position(v))
    }
}

/// The edges of two faces whose angle is greater, whichever way the faces look.
fn creases(mesh: &TriMesh, degrees: f64) -> Vec<Crease> {
    let crease = |sides: &[Side]| match *sides {
        [one, other] if dihedral(mesh, sides)? > degrees => Some(Crease { ends: one.ends, faces: [one.face, other.face] }),
        _ => None,
    };
    Edges::of(mesh.faces()).iter().filter_map(crease).collect()
}

/// The segments of the edges that a person sees as sharp.
fn seen(mesh: &TriMesh, reach: f64, least_length: f64) -> Vec<[DVec3; 2]> {
    let mut creases = creases(mesh, ORIGINAL_CREASE_DEGREES);
    if creases.is_empty() {
        return Vec::new();
    }
    let index = SurfaceIndex::new(mesh);
    let turns = |crease: &Crease| {
        let [one, other] = crease.faces.map(|face| normal_beside(mesh, &index, crease, face, reach));
        one.dot(other) < LEAST_TURN.to_radians().cos()
    };
    let turning: Vec<bool> = creases.par_iter().map(turns).collect();
    let mut turning = turning.into_iter();
    creases.retain(|_| turning.next() == Some(true));
    let mut runs = UnionFind::new(mesh.n_vertices());
    creases.iter().for_each(|crease| runs.join(crease.ends[0].index(), crease.ends[1].index()));
    let mut length = vec![0.0; mesh.n_vertices()];
    for crease in &creases {
        length[runs.find(crease.ends[0].index())] += mesh.distance(crease.ends[0], crease.ends[1]);
    }
    creases.retain(|crease| length[runs.find(crease.ends[0].index())] >= least_length);
    creases.iter().map(|crease| crease.segment(mesh)).collect()
}

/// The mean normal of the surface at some distance from an edge, on the side of one of its faces.
fn normal_beside(mesh: &TriMesh, index: &SurfaceIndex, crease: &Crease, face: FaceId, reach: f64) -> DVec3 {
    let [from, to] = crease.segment(mesh);
    let (middle, along) = (from.midpoint(to), (to - from).normalize_or_zero());
    let across = mesh.normal(face).cross(along);
    let away = if (mesh.centroid(face) - middle).dot(across) < 0.0 { -across } else { across };
    let mut sum = DVec3::ZERO;
    for a in [0.5, 1.0, 1.5] {
        for b in [-0.5, 0.0, 0.5] {
            let nearest = index.closest(middle + reach * (a * away + b * along));
            sum += nearest.map_or(DVec3::ZERO, |c| mesh.normal(c.face));
        }
    }
    sum.normalize_or_zero()
}

/// Points at equal distances along all segments.
fn points_along(segments: &[[DVec3; 2]]) -> Vec<DVec3> {
    let step = total_length(segments) / SAMPLES as f64;
    let (mut points, mut next) = (Vec::new(), 0.5 * step);
    for &[a, b] in segments {
        let length = a.distance(b);
        while next < length && length > 0.0 {
            points.push(a.lerp(b, next / length));
            next += step;
        }
        next -= length;
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip of `n` x `n` squares of side 1 over `height(x)`.
    fn strip(n: usize, height: impl Fn(f64, f64) -> f64) -> TriMesh {
        let at = |i: usize| ((i % (n + 1)) as f64, (i / (n + 1)) as f64);
        let positions = (0..(n + 1) * (n + 1)).map(at).map(|(x, y)| DVec3::new(x, y, height(x, y))).collect();
        let corner = |x: usize, y: usize| (y * (n + 1) + x) as u32;
        let squares = (0..n * n).map(|i| (i % n, i / n));
        let split = |(x, y): (usize, usize)| {
            let [a, b, c, d] = [corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)];
            [[a, b, c], [a, c, d]]
        };
        TriMesh::new(positions, squares.flat_map(split).collect()).unwrap()
    }

    fn roof(x: f64) -> f64 {
        -(x - 10.0).abs()
    }

    #[test]
    fn the_ridge_of_a_roof_is_seen_and_kept() {
        let mesh = strip(20, |x, _| roof(x));
        let seen = seen(&mesh, 0.3, 1.0);
        assert_eq!(seen.len(), 20);
        assert!(seen.iter().flatten().all(|p| p.x == 10.0));
        let sharp = SharpEdges::new(&mesh, mean_edge(&mesh));
        let share = |remeshed: &TriMesh| sharp.cover(remeshed).unwrap().share;
        assert_eq!(share(&mesh), 1.0);
        assert!((sharp.length() - 20.0).abs() < 1e-9);
        // Half an edge of it is on it, and an edge that leaves it is not.
        let [on, across] = [[10.0, 3.0, 0.0], [11.0, 3.0, -1.0]].map(|to| [DVec3::new(10.0, 3.5, 0.0), to.into()]);
        assert_eq!(sharp.hold(&[on, across]), [true, false]);
        assert_eq!(SharpEdges::none().hold(&[on]), [false]);
        // A flat surface keeps nothing, one with half of the ridge half of it.
        assert_eq!(share(&strip(20, |_, _| 0.0)), 0.0);
        let half = share(&strip(20, |x, y| if y < 10.5 { roof(x) } else { -20.0 }));
        assert!((half - 0.5).abs() < 0.05, "{half}");
        // What is missed are the faces below the other half.
        let half = strip(20, |x, y| if y < 10.5 { roof(x) } else { -20.0 });
        let missed = sharp.missed(&half, 0.99);
        assert!(!missed.is_empty() && sharp.missed(&mesh, 0.99).is_empty() && sharp.missed(&half, 0.4).is_empty());
    }

    #[test]
    fn noise_and_crumbs_are_not_seen() {
        // Every square bends by more than 40 degrees somewhere, but never the surface as a whole.
        let noise = |x: f64, y: f64| if (x + 2.0 * y) % 3.0 == 0.0 { 0.5 } else { 0.0 };
        let rough = strip(100, noise);
        assert!(creases(&rough, ORIGINAL_CREASE_DEGREES).len() > 1000);
        assert_eq!(SharpEdges::new(&rough, mean_edge(&rough)).cover(&rough), None);
        let crumb = strip(100, |x, y| if y == 50.0 && (x == 50.0 || x == 51.0) { 0.9 } else { 0.0 });
        assert!(!creases(&crumb, ORIGINAL_CREASE_DEGREES).is_empty());
        assert_eq!(seen(&crumb, 1.0, 10.0).len(), 0);
    }
}
