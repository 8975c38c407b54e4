//! Samples of both surfaces, each with its place on the other one.

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
/// Samples of the input for each domain face: as many as the other way.
const SAMPLES_BACK: usize = SAMPLES.len();
/// Of so many samples with a place on an input face the nearest one is the start for a sample of the input on this face.
const MOST_STARTS: usize = 32;
/// A pair counts in the fit when it is at most so far apart, as a share of the domain triangle's mean edge: further away lies another part
/// of the surface, or one that the domain does not reach.
const NEAR: f64 = 0.5;
/// A pair counts in the fit when the cosine of the angle between its faces is at least this.
const FACING: f64 = 0.3;
/// The golden ratio's fraction: its multiples spread evenly over 0 to 1.
const SPREAD: f64 = 0.618_033_988_749_895;

/// A point of the domain and one of the input: one is a sample, the other its closest point in the sheet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    pub(crate) domain: SurfacePoint,
    pub(crate) input: SurfacePoint,
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
    /// Samples of both, each with its place.
    pub(crate) fn new(surface: &Surface, region: &RegionMap, input: &Terrain, domain: &Terrain) -> Self {
        let faces: Vec<FaceId> = domain.mesh.faces().ids().collect();
        let on_face = |f: FaceId| {
            let starts = starts(surface, region, domain.mesh.face(f), region.sheet_of_face[f]);
            SAMPLES.map(|barycentric| {
                let area = domain.mesh.area(f) / SAMPLES.len() as f64;
                let sample = SurfacePoint { face: f, barycentric };
                first_pair(input, domain, &starts, sample, area)
            })
        };
        let mut forward = faces.into_par_iter().map(on_face).collect::<Vec<_>>().into_flattened();
        let back = samples_of_input(input.mesh, SAMPLES_BACK * domain.mesh.n_faces());
        let seeds = Seeds::new(input, domain.mesh, &forward);
        let backward = back.into_par_iter().map(|(sample, area)| seeds.pair(input, domain, sample, area)).collect();
        forward.extend(vertex_pairs(region, domain));
        let mut pairs = Self { forward, backward };
        pairs.follow(input, domain);
        pairs
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

/// Sorts values by faces, those of one face in their order: start of every face's part and the end of the last, and the values.
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
    /// Whether the fit counts it.
    fn counts(&self) -> bool {
        self.is_sound && self.area > 0.0
    }

    /// True for the sample in the middle of a domain face.
    pub(crate) fn is_middle(&self) -> bool {
        self.domain.barycentric == SAMPLES[0]
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
            Attachment::Corner(c) => starts.extend(surface.topology().fan(surface.network().corners[c]).map(HalfedgeId::face)),
        }
    }
    starts.retain(|&f| surface.network().sheet_of_face[f] == sheet);
    starts
}

/// A sample of the domain with its place, found from the best of some faces.
fn first_pair(input: &Terrain, domain: &Terrain, starts: &[FaceId], sample: SurfacePoint, area: f64) -> Pair {
    let p = sample.position(domain.mesh);
    let feet = starts.iter().map(|&f| input.foot(f, p));
    let start = feet.min_by(|a: &Foot, b| a.squared_distance.total_cmp(&b.squared_distance));
    // The corners of a face are in its sheet; without any, the pair is not sound and stays out.
    let input = start.map_or(SurfacePoint::at_corner(FaceId(0), 0), |foot| foot.point);
    Pair { domain: sample, input, area, distance: f64::INFINITY, is_sound: false }
}

/// The vertices inside sheets.
fn vertex_pairs(region: &RegionMap, domain: &Terrain) -> Vec<Pair> {
    let free = region.vertices().filter(|&v| matches!(region.attachments[v], Attachment::Sheet(_)));
    let pair = |v: VertexId| {
        let h = domain.topology.fan(v).next()?;
        let sample = SurfacePoint::at_corner(h.face(), h.corner());
        Some(Pair { domain: sample, input: region.points[v], area: 0.0, distance: 0.0, is_sound: false })
    };
    free.filter_map(pair).collect()
}

/// About `n` points spread by area with the area of each, and after them the vertices, without one.
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

/// Where the samples of the domain are, by faces of the input: starts for the samples of the input.
struct Seeds {
    /// Start of each face's part of `sorted`, and the end of the last.
    begin: Vec<usize>,
    /// Position and domain face of the samples.
    sorted: Vec<(DVec3, u32)>,
    /// For a face without samples the domain face of the nearest one, by number of faces on the way.
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

    /// A sample of the input with its place.
    fn pair(&self, input: &Terrain, domain: &Terrain, sample: SurfacePoint, area: f64) -> Pair {
        let p = sample.position(input.mesh);
        let own = &self.sorted[self.begin[sample.face.index()]..self.begin[sample.face.index() + 1]];
        let some = own.iter().step_by(own.len() / MOST_STARTS + 1);
        let nearest = some.min_by(|a, b| a.0.distance_squared(p).total_cmp(&b.0.distance_squared(p))).map(|s| FaceId(s.1));
        let start = nearest.or(self.spread[sample.face]);
        let place = start.map_or(SurfacePoint::at_corner(FaceId(0), 0), |f| domain.foot(f, p).point);
        Pair { domain: place, input: sample, area, distance: f64::INFINITY, is_sound: false }
    }
}
