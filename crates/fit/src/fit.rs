//! The fit: rounds of least squares, and what is taken back afterwards.

use crate::errors::Truth;
use crate::pairs::Pairs;
use crate::placement::{HALVINGS, Placement, mean_edges};
use crate::shape_guard::ShapeGuard;
use crate::system::{Element, System};
use crate::terrain::Terrain;
use crate::{Errors, FitError, FitOptions};
use glam::DVec3;
use mesh_core::{EdgeId, FaceId, Id as _, IdVec, TriMesh, VertexId};
use region_map::{Attachment, Domain, RegionMap, Surface};

/// Weight of staying at the start, against that of the samples. It decides for vertices with hardly any samples around them: with
/// less they may go anywhere, with more all others stay too far back.
const HOLD: f64 = 1e-3;
/// Weight of the triangles' shape in the first round with sliding: less brings the mesh closer, and costs quality.
///
/// Measured with the same weight in three rounds: at .02 the mean quality falls by .001 (rabbit) to .003 (rocker-arm), at .004 by
/// .002 to .008, at .001 by .007 to .015, but on fandisk by .0002.
const SHAPE: f64 = 0.02;
/// The weight of the shape is multiplied by this after a round in which the mean quality has not fallen by more than the options
/// allow: less may use up the quality in one step, more takes more rounds.
const SOFTER: f64 = 0.1;
/// How often a slide that costs too much quality is halved before it is left out: more saves a part of more slides, and takes time.
const SHORTER_SLIDES: i32 = 2;
/// Residuals count by their power 2 minus this: 0 is least squares, 1 is least absolute values. Measured on four models against
/// 0: with 0.5 the mean error falls by 1 to 4 % and the RMS rises by 0 to 1 %, with 1 it is 2 to 5 % and 2 to 9 %.
const ROBUSTNESS: f64 = 0.5;
/// Residuals below this share of the mean distance all have the same weight: less lets samples that are already near decide, more
/// is closer to least squares.
const SMALL: f64 = 0.3;
/// The conjugate gradients end when the residual has fallen to this share of the first one: less takes time, and the next round
/// starts from other distances anyway.
const TOLERANCE: f64 = 1e-2;
/// They end after so many iterations at the latest: more takes time where the matrix is bad.
const MOST_ITERATIONS: usize = 40;
/// A mean distance below this share of the diagonal is rounding.
const ROUNDING: f64 = 1e-12;
/// How often vertices are taken back where the greatest distance has grown or a face has turned over, before the fit is given
/// up: fewer give up more fits.
const MOST_RETREATS: usize = 12;

/// A domain with its vertices beside the surface.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// The domain with new points, its vertices at these points plus offset times normal.
    pub domain: Domain,
    /// Offset of every vertex along the surface's normal at its point (`SheetNormals::at`), in the units of the mesh, positive
    /// outwards; 0 at corners and on arcs.
    pub offsets: IdVec<VertexId, f64>,
    /// What was reached.
    pub report: FitReport,
}

/// What a fit reached. Lengths are in the units of the mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FitReport {
    /// Whether the fit was used; if not, the domain is as it was, and `end` tells what was not good enough.
    pub used: bool,
    /// Distances with the vertices on the surface.
    pub start: Errors,
    /// Distances after the fit.
    pub end: Errors,
    /// Mean size of the offsets.
    pub mean_offset: f64,
    /// Greatest size of an offset.
    pub max_offset: f64,
}

/// Moves the vertices inside sheets so that the distances between domain and surface, both ways, are least: along the surface's
/// normals, and a little over the surface. Vertices at corners and on arcs stay.
///
/// Vertices start at the points of the domain's region map, where its mesh has to have them. No triangle turns over or loses more
/// quality than the options allow, and the greatest distance does not grow. Where the mean distance hardly falls, the domain
/// stays as it is.
///
/// A surface that is interrupted ends it early, with a domain that nobody should use.
///
/// Fails where an option is out of its range, the domain does not fit the surface, or a vertex is outside of its sheet.
pub fn fit(surface: &Surface, domain: &Domain, options: &FitOptions) -> Result<Fitted, FitError> {
    fit_holding(surface, domain, &[], options)
}

/// As [`fit`], and the vertices of the faces in `still` stay where they are.
///
/// Fails as [`fit`] does, and where the domain has no such face.
pub fn fit_holding(surface: &Surface, domain: &Domain, still: &[FaceId], options: &FitOptions) -> Result<Fitted, FitError> {
    options.check()?;
    check(surface, domain)?;
    if let Some(&f) = still.iter().find(|f| f.index() >= domain.mesh.n_faces()) {
        return Err(FitError::NoFace(f));
    }
    let Domain { mesh: start_mesh, topology, region } = domain;
    let is_barrier = surface.topology().edge_ids().map(|e| surface.network().is_barrier(e)).collect();
    let is_span = topology.edge_ids().map(|e| topology.ends(e)).map(|[a, b]| region.span(a, b).is_some()).collect();
    let input = Terrain { mesh: surface.mesh(), topology: surface.topology(), barriers: &is_barrier };
    let fitter = Fitter { surface, input, domain, barriers: &is_span, options };

    let mut pairs = Pairs::new(surface, region, &input, &fitter.terrain(start_mesh))?;
    let truth = Truth::new(surface, start_mesh);
    let (start, turned) = (truth.errors(&pairs), truth.turned_faces(&pairs));
    let guard = ShapeGuard::new(start_mesh, topology, normals_below(surface, start_mesh, &pairs), options.quality_loss);
    let first = Placement::new(surface, domain);

    let mut now = fitter.improve(&first, &guard, &mut pairs)?;
    let retreat = |now: &mut Placement, pairs: &mut Pairs, faces: &[FaceId], round: usize| -> Result<(), FitError> {
        now.take_back(start_mesh, &first, faces, round);
        guard.hold(now, &first);
        pairs.follow(&input, &fitter.terrain(&now.mesh(start_mesh)?));
        Ok(())
    };
    if !still.is_empty() {
        retreat(&mut now, &mut pairs, still, HALVINGS)?;
    }
    for round in 0..MOST_RETREATS {
        if surface.interrupt().is_set() {
            break;
        }
        let mesh = now.mesh(start_mesh)?;
        let truth = Truth::new(surface, &mesh);
        let mut bad = truth.faces_beyond(&pairs, start.max);
        bad.extend(truth.turned_faces(&pairs).into_iter().filter(|f| turned.binary_search(f).is_err()));
        if bad.is_empty() {
            let end = truth.errors(&pairs);
            return Ok(fitter.finish(now, mesh, start, end));
        }
        // What still is bad when it is back where it was is held from around.
        retreat(&mut now, &mut pairs, &topology.widened(&bad, round.saturating_sub(HALVINGS)), round)?;
    }
    Ok(fitter.finish(first, start_mesh.clone(), start, start))
}

/// The domain fits the surface, and its vertices are inside their sheets.
fn check(surface: &Surface, domain: &Domain) -> Result<(), FitError> {
    domain.check(surface.network())?;
    for (v, attachment) in domain.region.attachments.enumerate() {
        if let Attachment::Sheet(sheet) = attachment
            && surface.network().sheet_of_face[domain.region.points[v].face] != *sheet
        {
            return Err(FitError::OtherSheet(v));
        }
    }
    Ok(())
}

/// The sum of the surface's normals below the samples of each face.
fn normals_below(surface: &Surface, domain: &TriMesh, pairs: &Pairs) -> IdVec<FaceId, DVec3> {
    let mut normals = IdVec::filled(DVec3::ZERO, domain.n_faces());
    for pair in &pairs.forward {
        normals[pair.domain.face] += surface.mesh().normal(pair.input.face);
    }
    normals
}

/// What is the same in all rounds.
struct Fitter<'a> {
    surface: &'a Surface,
    input: Terrain<'a>,
    /// Its vertices where they start.
    domain: &'a Domain,
    barriers: &'a IdVec<EdgeId, bool>,
    options: &'a FitOptions,
}

impl Fitter<'_> {
    fn terrain<'b>(&'b self, mesh: &'b TriMesh) -> Terrain<'b> {
        Terrain { mesh, topology: &self.domain.topology, barriers: self.barriers }
    }

    /// All rounds: first with sliding, then without.
    fn improve(&self, first: &Placement, guard: &ShapeGuard, pairs: &mut Pairs) -> Result<Placement, FitError> {
        let edges = mean_edges(self.domain);
        let reach = self.options.reach;
        let (mut now, mut shape) = (first.clone(), SHAPE);
        for round in 0..self.options.slides + self.options.rises {
            if self.surface.interrupt().is_set() {
                break;
            }
            let slides = round < self.options.slides;
            let mesh = now.mesh(&self.domain.mesh)?;
            let displacements = self.solve(&now, &mesh, pairs, slides.then_some(shape));
            let moved = |slide: f64| {
                let mut next = now.displaced(self.surface, &displacements, &edges, slide, reach);
                guard.hold(&mut next, &now);
                next
            };
            let fits = |next: &Placement| guard.loss(next) <= self.options.mean_quality_loss;
            let lengths = (0..=SHORTER_SLIDES).map(|i| 0.5f64.powi(i)).filter(|_| slides);
            let slid = lengths.map(|length| (length, moved(length))).find(|(_, next)| fits(next));
            // The full slide was within the loss of quality that is allowed, so the next round may bend the triangles more.
            shape *= if slid.as_ref().is_some_and(|(length, _)| *length == 1.0) { SOFTER } else { 1.0 };
            now = slid.map_or_else(|| moved(0.0), |(_, next)| next);
            pairs.follow(&self.input, &self.terrain(&now.mesh(&self.domain.mesh)?));
        }
        Ok(now)
    }

    /// The displacements for which the distances of all pairs, from a point to the plane at its place, are least. With a weight
    /// of shape, vertices may move along the surface as well.
    fn solve(&self, now: &Placement, mesh: &TriMesh, pairs: &Pairs, shape: Option<f64>) -> IdVec<VertexId, DVec3> {
        let small = SMALL * pairs.mean_distance();
        let by_face = pairs.by_domain_face(mesh.n_faces());
        let element = |f: FaceId| {
            let mut element = Element::ZERO;
            for (pair, is_forward) in by_face.pairs(f) {
                let normal = if is_forward { self.input.mesh.normal(pair.input.face) } else { mesh.normal(f) };
                let way = (pair.input.position(self.input.mesh) - pair.domain.position(mesh)).dot(normal);
                let weight = pair.area * (small / (way.abs() + small)).powf(ROBUSTNESS);
                element.ask(pair.domain.barycentric, normal, way, weight);
            }
            let area = 2.0 * self.domain.mesh.area(f);
            let moved = mesh.face(f).map(|v| mesh.position(v) - self.domain.mesh.position(v));
            element.hold(moved, shape.unwrap_or(0.0) * area, HOLD * area);
            element
        };
        let system = System::new(&self.domain.topology, now.freedoms(shape.is_some()), element);
        system.solve(TOLERANCE, MOST_ITERATIONS)
    }

    /// The result, or the domain as it was where the fit does not pay.
    fn finish(&self, now: Placement, mesh: TriMesh, start: Errors, end: Errors) -> Fitted {
        let is_exact = start.mean <= ROUNDING * self.input.mesh.diagonal();
        let used = !is_exact && end.max <= start.max && end.mean < (1.0 - self.options.least_gain) * start.mean;
        if !used {
            let offsets = IdVec::filled(0.0, self.domain.mesh.n_vertices());
            let report = FitReport { start, end, ..FitReport::default() };
            return Fitted { domain: self.domain.clone(), offsets, report };
        }
        let offsets: IdVec<VertexId, f64> = now.0.iter().map(|place| place.height).collect();
        let region = RegionMap { points: now.0.iter().map(|place| place.point).collect(), ..self.domain.region.clone() };
        let report = FitReport {
            used,
            start,
            end,
            mean_offset: offsets.iter().map(|h| h.abs()).sum::<f64>() / offsets.len().max(1) as f64,
            max_offset: offsets.iter().map(|h| h.abs()).fold(0.0, f64::max),
        };
        Fitted { domain: Domain { mesh, topology: self.domain.topology.clone(), region }, offsets, report }
    }
}
