//! Samples of both surfaces, each with its place on the other one.

use crate::FitError;
use crate::terrain::{Foot, Terrain};
use glam::DVec3;
use mesh_core::{FaceId, HalfedgeId, Id, IdVec, SurfacePoint, TriMesh, VertexId};
use rayon::prelude::*;
use region_map::{Attachment, RegionMap, SheetId, Surface};
use std::collections::VecDeque;

/// Samples of a domain face: the middles of its four children.
const SAMPLES: [DVec3; 4] = [
    DVec3::splat(1.0 / 3.0),
    DVec3::new(2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0),
    DVec3::new(1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0),
    DVec3::new(1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0),
];
/// Which of them is in the middle of the face.
const MIDDLE: usize = 0;
/// Samples of the input for each domain face: as many as the other way.
const SAMPLES_BACK: usize = SAMPLES.len();
/// A sample of the input starts at the domain face that the nearest sample on its own face came from. At most so many are
/// compared.
const MOST_STARTS: usize = 32;
/// A pair counts in the fit when it is at most so far apart, as a share of the domain triangle's mean edge: further away lies
/// another part of the surface, or one that the domain does not reach.
const NEAR: f64 = 0.5;
/// A pair counts in the fit when the cosine of the angle between its faces is at least this.
const FACING: f64 = 0.3;
/// The fraction of the golden ratio. Fractions of its multiples spread evenly over 0 to 1.
const SPREAD: f64 = 0.618_033_988_749_895;

/// A point of the domain and one of the input: one is a sample, the other its closest point in the sheet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    pub(crate) domain: SurfacePoint,
    pub(crate) input: SurfacePoint,
    /// True for the sample in the middle of a domain face.
    pub(crate) is_middle: bool,
    /// The area that the sample stands for; 0 for vertices, which only count for the greatest distance.
    pub(crate) area: f64,
    pub(crate) distance: f64,
    /// Whether the two are near and face the same way.
    pub(crate) is_sound: bool,
}

/// All samples.
#[derive(Clone, Debug)]
pub(crate) struct Pairs {
    /// Samples of the domain.
    pub(crate) forward: Vec<Pair>,
    /// Samples of the input.
    pub(crate) backward: Vec<Pair>,
}

impl Pairs {
    /// Samples of both, each with its place. Fails where a sample has no face of its sheet to start from on the other mesh.
    pub(crate) fn new(surface: &Surface, region: &RegionMap, input: &Terrain, domain: &Terrain) -> Result<Self, FitError> {
        let faces: Vec<FaceId> = domain.mesh.faces().ids().collect();
        let on_face = |f: FaceId| {
            let starts = starts(surface, region, domain.mesh.face(f), region.sheet_of_face[f]);
            let area = domain.mesh.area(f) / SAMPLES.len() as f64;
            let pair = |i: usize| {
                let sample = SurfacePoint { face: f, barycentric: SAMPLES[i] };
                let place = nearest_foot(input, &starts, sample.position(domain.mesh))?.point;
                Some(Pair { is_middle: i == MIDDLE, ..Pair::new(sample, place, area) })
            };
            (0..SAMPLES.len()).map(pair).collect::<Option<Vec<Pair>>>().ok_or(FitError::OutsideSheet(f))
        };
        let on_faces: Vec<_> = faces.into_par_iter().map(on_face).collect();
        let mut forward = on_faces.into_iter().collect::<Result<Vec<Vec<Pair>>, FitError>>()?.concat();
        let back = samples_of_input(input.mesh, SAMPLES_BACK * domain.mesh.n_faces());
        let seeds = Seeds::new(input, domain.mesh, &forward);
        let placed: Vec<_> =
            back.into_par_iter().map(|(sample, area)| seeds.pair(surface, input, domain, sample, area)).collect();
        let backward = placed.into_iter().collect::<Result<_, FitError>>()?;
        forward.extend(vertex_pairs(region, domain));
        let mut pairs = Self { forward, backward };
        pairs.follow(input, domain);
        Ok(pairs)
    }

    /// The mean distance of the samples of the domain that count.
    pub(crate) fn mean_distance(&self) -> f64 {
        let (mut sum, mut area) = (0.0, f64::MIN_POSITIVE);
        for pair in self.forward.iter().filter(|pair| pair.counts()) {
            sum += pair.area * pair.distance;
            area += pair.area;
        }
        sum / area
    }

    /// The pairs that count, by the faces of the domain.
    pub(crate) fn by_domain_face(&self, n_faces: usize) -> ByFace<'_> {
        let all = || self.forward.iter().chain(&self.backward).enumerate().filter(|(_, pair)| pair.counts());
        let (begin, order) = sorted_by_face(all().map(|(i, pair)| (pair.domain.face, i as u32)), n_faces);
        ByFace { pairs: self, begin, order }
    }

    /// Lets every sample find its place anew, from where it was, after the domain has moved.
    pub(crate) fn follow(&mut self, input: &Terrain, domain: &Terrain) {
        self.forward.par_iter_mut().for_each(|pair| {
            let foot = input.closest_from(pair.input.face, pair.domain.position(domain.mesh));
            pair.input = foot.point;
            pair.judge(foot.squared_distance, input.mesh, domain.mesh);
        });
        self.backward.par_iter_mut().for_each(|pair| {
            let foot = domain.closest_from(pair.domain.face, pair.input.position(input.mesh));
            pair.domain = foot.point;
            pair.judge(foot.squared_distance, input.mesh, domain.mesh);
        });
    }
}

/// The pairs that count, by the faces of the domain.
pub(crate) struct ByFace<'a> {
    pairs: &'a Pairs,
    begin: Vec<usize>,
    order: Vec<u32>,
}

impl ByFace<'_> {
    /// The pairs of a face, and whether their samples are the domain's.
    pub(crate) fn pairs(&self, f: FaceId) -> impl Iterator<Item = (&Pair, bool)> {
        let Pairs { forward, backward } = self.pairs;
        self.order[self.begin[f.index()]..self.begin[f.index() + 1]].iter().map(move |&i| {
            let i = i as usize;
            forward.get(i).map_or_else(|| (&backward[i - forward.len()], false), |pair| (pair, true))
        })
    }
}

/// Sorts values by their faces, and leaves those of one face in their order. The first list has where the values of each face
/// begin, and at its end where the last ones end; the second has the values.
fn sorted_by_face<T: Copy + Default>(values: impl Iterator<Item = (FaceId, T)> + Clone, n_faces: usize) -> (Vec<usize>, Vec<T>) {
    let mut begin = vec![0; n_faces + 1];
    values.clone().for_each(|(f, _)| begin[f.index() + 1] += 1);
    for i in 0..n_faces {
        begin[i + 1] += begin[i];
    }
    let mut at = begin.clone();
    let mut sorted = vec![T::default(); begin[n_faces]];
    for (f, value) in values {
        sorted[at[f.index()]] = value;
        at[f.index()] += 1;
    }
    (begin, sorted)
}

impl Pair {
    /// A pair that is not measured yet.
    fn new(domain: SurfacePoint, input: SurfacePoint, area: f64) -> Self {
        Self { domain, input, is_middle: false, area, distance: f64::INFINITY, is_sound: false }
    }

    /// Whether the fit counts it.
    fn counts(&self) -> bool {
        self.is_sound && self.area > 0.0
    }

    fn judge(&mut self, squared_distance: f64, input: &TriMesh, domain: &TriMesh) {
        let [a, b, c] = domain.triangle(self.domain.face);
        let edge = (a.distance(b) + b.distance(c) + c.distance(a)) / 3.0;
        self.distance = squared_distance.sqrt();
        self.is_sound = self.distance <= NEAR * edge && input.normal(self.input.face).dot(mesh_core::normal([a, b, c])) >= FACING;
    }
}

/// Input faces of a sheet that the corners of a domain face are on.
fn starts(surface: &Surface, region: &RegionMap, corners: [VertexId; 3], sheet: SheetId) -> Vec<FaceId> {
    let mut starts = Vec::new();
    for v in corners {
        match region.attachments[v] {
            Attachment::Sheet(_) => starts.push(region.points[v].face),
            Attachment::Arc { arc, t } => {
                let sides = surface.network().arcs[arc].sides(surface.topology(), t);
                starts.extend(sides.into_iter().flatten().map(HalfedgeId::face));
            }
            Attachment::Corner(c) => starts.extend(surface.topology().faces_at(surface.network().corners[c])),
        }
    }
    starts.retain(|&f| surface.network().sheet_of_face[f] == sheet);
    starts
}

/// The nearest of the feet of a position on some faces.
fn nearest_foot(input: &Terrain, faces: &[FaceId], p: DVec3) -> Option<Foot> {
    let feet = faces.iter().map(|&f| input.foot(f, p));
    feet.min_by(|a, b| a.squared_distance.total_cmp(&b.squared_distance))
}

/// The vertices inside sheets.
fn vertex_pairs(region: &RegionMap, domain: &Terrain) -> Vec<Pair> {
    let free = region.vertices().filter(|&v| matches!(region.attachments[v], Attachment::Sheet(_)));
    let pair = |v: VertexId| {
        let h = domain.topology.fan(v).next()?;
        let sample = SurfacePoint::at_corner(h.face(), h.corner());
        Some(Pair::new(sample, region.points[v], 0.0))
    };
    free.filter_map(pair).collect()
}

/// About `n` points spread evenly over the area, each with the area that it stands for. After them come the vertices, with the
/// area 0.
fn samples_of_input(mesh: &TriMesh, n: usize) -> Vec<(SurfacePoint, f64)> {
    let step = mesh.total_area() / n.max(1) as f64;
    let mut samples = Vec::with_capacity(n + mesh.n_vertices());
    let (mut before, mut next) = (0.0, 0.5 * step);
    for f in mesh.faces().ids() {
        let area = mesh.area(f);
        while next < before + area && samples.len() < n {
            // Uniform in a triangle (Osada et al., *Shape distributions*, 2002, section 4.1).
            let (s, t) = (((next - before) / area).sqrt(), (samples.len() as f64 * SPREAD).fract());
            samples.push((SurfacePoint::new(f, DVec3::new(1.0 - s, s * (1.0 - t), s * t)), step));
            next += step;
        }
        before += area;
    }
    let mut is_taken = IdVec::<VertexId, bool>::filled(false, mesh.n_vertices());
    for (f, corners) in mesh.faces().enumerate() {
        for (c, v) in corners.iter().enumerate() {
            if !std::mem::replace(&mut is_taken[*v], true) {
                samples.push((SurfacePoint::at_corner(f, c), 0.0));
            }
        }
    }
    samples
}

/// The samples of the domain by the faces of the input that they are on: there the samples of the input start.
struct Seeds {
    /// Where the samples on each face begin in `sorted`, and at its end where the last ones end.
    begin: Vec<usize>,
    /// Position and domain face of the samples.
    sorted: Vec<(DVec3, u32)>,
    /// For every face the domain face of a sample on it, or of the one that is the fewest faces away inside the sheet.
    spread: IdVec<FaceId, Option<FaceId>>,
}

impl Seeds {
    fn new(input: &Terrain, domain: &TriMesh, forward: &[Pair]) -> Self {
        let places = forward.iter().map(|pair| (pair.input.face, (pair.domain.position(domain), pair.domain.face.0)));
        let (begin, sorted) = sorted_by_face(places, input.mesh.n_faces());
        let seed = |f: FaceId| sorted[begin[f.index()]..begin[f.index() + 1]].first().map(|s| FaceId(s.1));
        let mut spread: IdVec<FaceId, Option<FaceId>> = input.mesh.faces().ids().map(seed).collect();
        let mut queue: VecDeque<FaceId> = spread.enumerate().filter(|(_, s)| s.is_some()).map(|(f, _)| f).collect();
        while let Some(f) = queue.pop_front() {
            for twin in input.topology.halfedges(f).into_iter().filter_map(|h| input.across(h)) {
                if spread[twin.face()].is_none() {
                    spread[twin.face()] = spread[f];
                    queue.push_back(twin.face());
                }
            }
        }
        Self { begin, sorted, spread }
    }

    /// A sample of the input with its place. Fails where the domain has no face in its sheet.
    fn pair(
        &self,
        surface: &Surface,
        input: &Terrain,
        domain: &Terrain,
        sample: SurfacePoint,
        area: f64,
    ) -> Result<Pair, FitError> {
        let p = sample.position(input.mesh);
        let own = &self.sorted[self.begin[sample.face.index()]..self.begin[sample.face.index() + 1]];
        let some = own.iter().step_by(own.len() / MOST_STARTS + 1);
        let nearest = some.min_by(|a, b| a.0.distance_squared(p).total_cmp(&b.0.distance_squared(p))).map(|s| FaceId(s.1));
        let start = nearest.or(self.spread[sample.face]);
        let start = start.ok_or_else(|| FitError::EmptySheet(surface.network().sheet_of_face[sample.face]))?;
        Ok(Pair::new(domain.foot(start, p).point, sample, area))
    }
}
