//! Distances between domain and input, and where the domain faces the wrong way.

use crate::pairs::{Pair, Pairs};
use glam::DVec3;
use mesh_core::{FaceId, SHEET_DISTANCE, SurfaceIndex, SurfacePoint, TriMesh};
use rayon::prelude::*;
use region_map::Surface;
use std::cell::OnceCell;

/// Distances between domain and input, in the units of the mesh: of both directions the greater one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Errors {
    /// Mean over the area.
    pub mean: f64,
    /// The greatest at samples and vertices.
    pub max: f64,
}

/// The true distances of samples: to the closest point anywhere, not only in the sheet. They are never greater than those of the
/// pairs, and only asked for where it matters.
pub(crate) struct Truth<'a> {
    surface: &'a Surface,
    domain: &'a TriMesh,
    domain_index: OnceCell<SurfaceIndex>,
}

impl<'a> Truth<'a> {
    pub(crate) fn new(surface: &'a Surface, domain: &'a TriMesh) -> Self {
        Self { surface, domain, domain_index: OnceCell::new() }
    }

    /// Mean and greatest distance. Where pairs are not sound, the true distance counts.
    pub(crate) fn errors(&self, pairs: &Pairs) -> Errors {
        let unsound = self.distances(pairs, |pair| !pair.is_sound);
        let mean = [&pairs.forward, &pairs.backward].into_iter().zip(unsound).map(|(pairs, unsound)| {
            let (mut sum, mut area) = (0.0, 0.0);
            for pair in pairs.iter().filter(|pair| pair.is_sound) {
                sum += pair.area * pair.distance;
                area += pair.area;
            }
            for Measured { pair, distance, .. } in unsound {
                sum += pairs[pair].area * distance;
                area += pairs[pair].area;
            }
            if area > 0.0 { sum / area } else { 0.0 }
        });
        Errors { mean: mean.fold(0.0, f64::max), max: self.greatest(pairs) }
    }

    /// The domain faces at samples whose true distance is above a limit, in rising order.
    pub(crate) fn faces_beyond(&self, pairs: &Pairs, limit: f64) -> Vec<FaceId> {
        let [forward, backward] = self.distances(pairs, |pair| pair.distance > limit);
        let forward = forward.into_iter().filter(|s| s.distance > limit).map(|s| pairs.forward[s.pair].domain.face);
        let backward = backward.into_iter().filter(|s| s.distance > limit).map(|s| s.face);
        let mut faces: Vec<FaceId> = forward.chain(backward).collect();
        faces.sort_unstable();
        faces.dedup();
        faces
    }

    /// The domain faces whose normal opposes that of the input at the point closest to their middle, in rising order. Where a
    /// sound pair is so near that no other sheet can hide it, the input is not asked.
    pub(crate) fn turned_faces(&self, pairs: &Pairs) -> Vec<FaceId> {
        let hidden = SHEET_DISTANCE * self.surface.mesh().diagonal();
        let is_asked = |pair: &&Pair| pair.is_middle && (!pair.is_sound || pair.distance > hidden);
        let asked: Vec<SurfacePoint> = pairs.forward.iter().filter(is_asked).map(|pair| pair.domain).collect();
        let is_turned = |middle: &SurfacePoint| {
            self.surface.index().nearest_opposes(middle.position(self.domain), self.domain.normal(middle.face))
        };
        if !asked.is_empty() {
            self.surface.index(); // built here, not by one of the threads while the others wait
        }
        asked.into_par_iter().filter(is_turned).map(|middle| middle.face).collect()
    }

    /// True distances are at most those of the pairs, so only the pairs that are furthest apart need to be asked.
    fn greatest(&self, pairs: &Pairs) -> f64 {
        let all = || pairs.forward.iter().chain(&pairs.backward);
        let (mut greatest, mut above) = (0.0, all().map(|pair| pair.distance).fold(0.0, f64::max));
        while greatest < above {
            let least = if above > f64::MIN_POSITIVE { 0.5 * above.min(f64::MAX) } else { 0.0 };
            let distances = self.distances(pairs, |pair| pair.distance > least && pair.distance <= above);
            greatest = distances.iter().flatten().map(|s| s.distance).fold(greatest, f64::max);
            above = least;
        }
        greatest
    }

    /// The true distances of some pairs of both directions.
    fn distances(&self, pairs: &Pairs, which: impl Fn(&Pair) -> bool + Sync) -> [Vec<Measured>; 2] {
        let chosen =
            [&pairs.forward, &pairs.backward].map(|pairs| (0..pairs.len()).filter(|&i| which(&pairs[i])).collect::<Vec<usize>>());
        let [forward, backward] = chosen;
        let domain_index = || self.domain_index.get_or_init(|| SurfaceIndex::new(self.domain));
        [
            measure(forward, || self.surface.index(), |i| pairs.forward[i].domain.position(self.domain)),
            measure(backward, domain_index, |i| pairs.backward[i].input.position(self.surface.mesh())),
        ]
    }
}

/// The true distance of a pair.
struct Measured {
    /// The index of the pair in its direction.
    pair: usize,
    /// The face of the other mesh that is the closest.
    face: FaceId,
    distance: f64,
}

/// The closest points to the positions of some pairs, on a mesh whose index is only built when there is a pair.
fn measure<'a>(
    chosen: Vec<usize>,
    index: impl FnOnce() -> &'a SurfaceIndex,
    position: impl Fn(usize) -> DVec3 + Sync,
) -> Vec<Measured> {
    if chosen.is_empty() {
        return Vec::new();
    }
    let index = index();
    let measured = |pair: usize| index.closest(position(pair)).map(|c| Measured { pair, face: c.face, distance: c.distance });
    chosen.into_par_iter().filter_map(measured).collect()
}
