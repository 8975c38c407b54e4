//! The last folds are mended, one vertex at a time.
//!
//! Newton's method sees the surface through its normals at the vertices. Where these change from triangle to triangle (ragged
//! borders, scan noise) its model means little, and a few triangles stay folded. There the neighbours of a fold try places all
//! around them, and take the one that leaves the best worst triangle: no derivatives, never a step back.

use crate::freedom::Freedom;
use crate::measured::Measured;
use crate::movable_domain::MovableDomain;
use crate::placed_vertex::PlacedVertex;
use crate::placement::Placement;
use glam::DVec3;
use mesh_core::{FaceId, Id as _, SurfaceIndex, VertexId, aspect_ratio, normal, ways_around};
use rayon::prelude::*;
use rustc_hash::FxHashSet;

/// Triangles worse than this (AR, negative when folded) are mended. More mends more than folds, and takes longer.
const SOUND: f64 = 0.02;
/// Beyond this share of folded triangles of a whole domain nothing is mended: the region map is wrong then, and mending would
/// take long.
const MOST_FOLDED: f64 = 0.01;
/// Passes over all vertices round folds; each takes what the one before made possible. More mend more, and cost time.
const ROUNDS: usize = 20;
/// A vertex tries places in so many directions. More may find more ways out of a fold, and cost time.
const DIRECTIONS: usize = 12;
/// How far away these places are, as shares of the mean length of the vertex' edges: from next to it to almost its neighbours.
const REACHES: [f64; 4] = [0.05, 0.15, 0.4, 0.9];

/// Mends placements of one domain.
pub(crate) struct Mender<'a> {
    pub(crate) domain: &'a MovableDomain<'a>,
    /// With more folded triangles than these the region map is wrong, not a few vertices.
    most: f64,
}

impl<'a> Mender<'a> {
    pub(crate) fn new(domain: &'a MovableDomain<'a>) -> Self {
        Self { domain, most: MOST_FOLDED * domain.topology.n_faces() as f64 }
    }

    /// The same for a part of the domain.
    pub(crate) fn of_part<'b>(&self, domain: &'b MovableDomain<'b>) -> Mender<'b> {
        Mender { domain, most: self.most }
    }

    /// Moves vertices beside folded triangles until none is folded or no move helps. The worst triangle round a vertex never gets
    /// worse.
    pub(crate) fn mended(&self, measured: Measured) -> Measured {
        // Where the normals at the corners tell of too many, the surface is not asked: it could only add to them. Otherwise it
        // is, for every triangle: one that bridges a slit may look sound.
        let qualities = self.domain.of_faces(|f| {
            let quality = aspect_ratio(measured.placement().triangle(self.domain, f));
            if measured.faces()[f].signed_area > 0.0 { quality } else { -quality }
        });
        if qualities.iter().filter(|quality| **quality < SOUND).count() as f64 > self.most {
            return measured;
        }
        let sight = Sight { domain: self.domain, index: self.domain.surface.index() };
        let in_sight = self.domain.of_faces(|f| sight.in_sight_of_surface(measured.placement(), f, qualities[f.index()]));
        let folds: Vec<FaceId> = self.domain.topology.faces().ids().filter(|f| in_sight[f.index()] < SOUND).collect();
        if folds.is_empty() {
            return measured;
        }
        let mut placement = measured.into_placement();
        self.mend(&sight, &mut placement, folds);
        Measured::new(self.domain, placement)
    }

    /// Mends these folds, and those that come of it.
    fn mend(&self, sight: &Sight, placement: &mut Placement, mut folds: Vec<FaceId>) {
        // Vertices that stayed when they were tried. As long as nothing around one moves it would stay once more.
        let mut settled = FxHashSet::default();
        for _ in 0..ROUNDS {
            if folds.is_empty() || folds.len() as f64 > self.most || self.domain.is_interrupted() {
                return;
            }
            let mut moved = Vec::new();
            for v in self.domain.around(&folds) {
                if settled.contains(&v) {
                    continue;
                }
                if sight.improve(placement, v) {
                    moved.push(v);
                    for w in self.domain.topology.one_ring(v) {
                        settled.remove(&w);
                    }
                } else {
                    settled.insert(v);
                }
            }
            if moved.is_empty() {
                return;
            }
            // Only triangles that have moved can have changed.
            let changed = self.domain.fans(&moved);
            folds.retain(|f| changed.binary_search(f).is_err());
            folds.extend(sight.folds(placement, changed));
            folds.sort_unstable();
        }
    }
}

/// Looks for folds with the surface itself: the normals at the corners do not tell of all of them.
struct Sight<'a> {
    domain: &'a MovableDomain<'a>,
    index: &'a SurfaceIndex,
}

/// The worst of the triangles round a vertex, then the sum of all.
type Score = (f64, f64);

impl Sight<'_> {
    /// Those of some triangles that are not sound, in their order.
    fn folds(&self, placement: &Placement, faces: Vec<FaceId>) -> Vec<FaceId> {
        let quality = |f: FaceId| self.in_sight_of_surface(placement, f, signed_quality(self.domain, placement, f));
        faces.into_par_iter().filter(|&f| quality(f) < SOUND).collect()
    }

    /// Moves a vertex to the best place that it finds; false where it stays.
    fn improve(&self, placement: &mut Placement, v: VertexId) -> bool {
        if matches!(self.domain.freedoms[v], Freedom::Fixed) {
            return false;
        }
        let start = placement[v];
        let (mut best, mut best_place) = (self.score(placement, v, f64::NEG_INFINITY), None);
        for way in self.ways(placement, v, &start) {
            placement.move_to(v, start);
            let placed = self.domain.displaced(placement, v, way);
            placement.move_to(v, placed);
            // What the surface says can only lower the score, and takes longest to ask.
            let worst = best.map_or(f64::NEG_INFINITY, |(worst, _)| worst);
            if self.score_by_corners(placement, v, worst) > best {
                let score = self.score(placement, v, worst);
                if score > best {
                    (best, best_place) = (score, Some(placed));
                }
            }
        }
        placement.move_to(v, best_place.unwrap_or(start));
        best_place.is_some()
    }

    /// Displacements to try: to the middle of the neighbours, and all around in the tangent plane.
    fn ways(&self, placement: &Placement, v: VertexId, placed: &PlacedVertex) -> Vec<DVec3> {
        let ring: Vec<DVec3> = self.domain.topology.one_ring(v).map(|w| placement[w].position - placed.position).collect();
        ways_around(&ring, placed.normals[0] + placed.normals[1], DIRECTIONS, &REACHES)
    }

    /// The score of a vertex, as far as the normals at the corners of its triangles tell. `None`, which is less than any score, where one of the
    /// triangles is worse than `worst`: nobody needs to know the others then.
    fn score_by_corners(&self, placement: &Placement, v: VertexId, worst: f64) -> Option<Score> {
        self.worst_and_sum(v, worst, |f| signed_quality(self.domain, placement, f))
    }

    /// The score of a vertex; `None` as above.
    fn score(&self, placement: &Placement, v: VertexId, worst: f64) -> Option<Score> {
        self.worst_and_sum(v, worst, |f| self.in_sight_of_surface(placement, f, signed_quality(self.domain, placement, f)))
    }

    fn worst_and_sum(&self, v: VertexId, worst: f64, quality: impl Fn(FaceId) -> f64) -> Option<Score> {
        let mut faces = self.domain.topology.faces_at(v);
        faces.try_fold((f64::INFINITY, 0.0), |(least, sum), f| {
            let q = quality(f);
            (q >= worst).then(|| (q.min(least), sum + q))
        })
    }

    /// The quality, made negative where the triangle faces against the surface nearest to its middle: it bridges a slit.
    ///
    /// As [`SurfaceIndex::opposes`] has it, but that another sheet in the same place excuses the triangle also where it is
    /// exactly perpendicular to it.
    fn in_sight_of_surface(&self, placement: &Placement, f: FaceId, quality: f64) -> f64 {
        let triangle = placement.triangle(self.domain, f);
        let (own, middle) = (normal(triangle), (triangle[0] + triangle[1] + triangle[2]) / 3.0);
        let opposes = |g: FaceId| self.domain.surface.mesh().normal(g).dot(own) < 0.0;
        match self.index.closest(middle) {
            Some(nearest) if quality > 0.0 && opposes(nearest.face) && !self.touches(middle, nearest.distance, opposes) => {
                -quality
            }
            _ => quality,
        }
    }

    /// Is there another sheet in the same place that does not oppose?
    fn touches(&self, middle: DVec3, distance: f64, opposes: impl Fn(FaceId) -> bool) -> bool {
        let reach = distance + self.index.sheet_distance();
        self.index.closest_within_where(middle, reach, |g| !opposes(g)).is_some()
    }
}

impl MovableDomain<'_> {
    /// The vertices of some faces and their neighbours, in rising order.
    fn around(&self, faces: &[FaceId]) -> Vec<VertexId> {
        let corners = faces.iter().flat_map(|&f| self.topology.face(f));
        let mut vertices: Vec<VertexId> = corners.flat_map(|v| self.topology.one_ring(v).chain([v])).collect();
        vertices.sort_unstable();
        vertices.dedup();
        vertices
    }
}

/// AR of a face, negative where it faces against the surface at its corners.
fn signed_quality(domain: &MovableDomain, placement: &Placement, f: FaceId) -> f64 {
    let quality = aspect_ratio(placement.triangle(domain, f));
    if placement.signed_area(domain, f) > 0.0 { quality } else { -quality }
}
