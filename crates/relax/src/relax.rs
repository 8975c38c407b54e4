//! The verb of this crate: quadric relaxation, then shape optimisation.

use crate::domain::Domain;
use crate::mend::Mender;
use crate::placement::Placement;
use crate::places::relax_places;
use crate::quadric::relax_quadric;
use crate::shape::{optimise_shape, target_areas};
use crate::{Quality, RelaxError, RelaxOptions, ShapeOptions};
use mesh_core::{FaceId, IdVec, Topology, TriMesh};
use region_map::{RegionMap, Surface};
use std::sync::OnceLock;

/// Mean quality that the shape optimisation may give up: where the start is good, it is the worst triangles that it lifts.
const SLACK: f64 = 2e-3;

/// A relaxed domain.
#[derive(Clone, Debug)]
pub struct Relaxed {
    /// The domain with its vertices at the points of the map.
    pub mesh: TriMesh,
    /// The map with new points, arc lengths and spans.
    pub map: RegionMap,
    /// The triangles that still face against the surface or have no area, in rising order.
    pub inverted: Vec<FaceId>,
    /// What was reached.
    pub report: RelaxReport,
}

/// What a relaxation reached.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RelaxReport {
    /// Quality at the start.
    pub start: Quality,
    /// Quality after the paper's relaxation.
    pub after_quadric: Quality,
    /// Quality at the end.
    pub end: Quality,
    /// Iterations of the paper's relaxation.
    pub quadric_iterations: usize,
    /// Newton steps of the shape optimisation.
    pub shape_steps: usize,
}

/// Moves the vertices of a domain mesh over the surface until its triangles are as near to equilateral as its connectivity and
/// the arcs allow.
///
/// Corners stay, vertices on arcs slide along them in their order, all others move inside their sheet. Vertices start at the
/// points of `map`; the positions of `domain` are not read. Inverted triangles are turned back where that succeeds; on the way
/// others may be turned over for a while. The result is never worse than the start: it has no more inverted triangles, and with
/// as many a mean quality that is lower by .002 at most. [`RelaxReport::end`] tells how many are left.
///
/// Fails when the map does not fit the domain or the surface.
pub fn relax(
    surface: &Surface,
    domain: &TriMesh,
    topology: &Topology,
    map: &RegionMap,
    options: &RelaxOptions,
) -> Result<Relaxed, RelaxError> {
    let mesh = domain;
    let mut domain = Domain::new(surface, topology, map)?;
    domain.hold(&options.held);
    let placement = Placement::of_map(&domain, map);
    let start = Quality::of(&placement, &domain);

    let index = OnceLock::new();
    let mender = Mender::new(&domain, &index);
    let (relaxed, quadric_iterations) = relax_quadric(&domain, placement, &options.quadric);
    let after_quadric = Quality::of(&relaxed, &domain);
    let targets = target_areas(&domain, &map.sheet_of_face, &relaxed, &options.shape.target)?;
    let (best, end, shape_steps) = best_shape(&mender, &targets, (relaxed, after_quadric), SLACK, &options.shape);
    let report = RelaxReport { start, after_quadric, end, quadric_iterations, shape_steps };
    finished(&domain, mesh, map, best, report)
}

/// Optimises the shape of the triangles around some faces, and leaves vertices more than `edges` edges away from them where they are.
///
/// For the last folds of a relaxed domain: each place is relaxed by itself, as if there were no others. Otherwise as [`relax`], without
/// the paper's relaxation.
pub fn relax_around(
    surface: &Surface,
    domain: &TriMesh,
    topology: &Topology,
    map: &RegionMap,
    places: (&[FaceId], usize),
    options: &ShapeOptions,
) -> Result<Relaxed, RelaxError> {
    let mesh = domain;
    let domain = Domain::new(surface, topology, map)?;
    let mut placement = Placement::of_map(&domain, map);
    let start = Quality::of(&placement, &domain);
    let targets = target_areas(&domain, &map.sheet_of_face, &placement, &options.target)?;
    let index = OnceLock::new();
    let shape_steps = relax_places(&Mender::new(&domain, &index), &targets, &mut placement, places, options);
    let end = Quality::of(&placement, &domain);
    finished(&domain, mesh, map, placement, RelaxReport { start, after_quadric: start, end, quadric_iterations: 0, shape_steps })
}

/// The faces of a domain that face against the surface, in rising order, with their vertices where the map has them.
///
/// Fails as [`relax`] does.
pub fn inverted(surface: &Surface, topology: &Topology, map: &RegionMap) -> Result<Vec<FaceId>, RelaxError> {
    let domain = Domain::new(surface, topology, map)?;
    Ok(inverted_of(&domain, &Placement::of_map(&domain, map)))
}

fn inverted_of(domain: &Domain, placement: &Placement) -> Vec<FaceId> {
    domain.topology.faces().ids().filter(|&f| placement.signed_area(domain, f) <= 0.0).collect()
}

/// The start with optimised shapes, or itself where it was better; its quality, and the number of Newton steps.
pub(crate) fn best_shape(
    mender: &Mender,
    targets: &IdVec<FaceId, f64>,
    (start, start_quality): (Placement, Quality),
    slack: f64,
    options: &ShapeOptions,
) -> (Placement, Quality, usize) {
    let domain = mender.domain;
    let (mut best, mut shape_steps) = shaped_and_mended(mender, targets, &start, options);
    let mut end = Quality::of(&best, domain);
    if end.inverted > 0 {
        // Untangling moves far; where it fails, the start may have been nearer to a sound mesh.
        let smooth_only = ShapeOptions { untangling_steps: 0, ..options.clone() };
        let mut mended = start.clone();
        mender.mend_folds(&mut mended);
        let (other, steps) = shaped_and_mended(mender, targets, &mended, &smooth_only);
        let quality = Quality::of(&other, domain);
        shape_steps += steps;
        if quality.is_better_than(&end) {
            (best, end) = (other, quality);
        }
    }
    let end_at_least = Quality { ar_mean: end.ar_mean + slack, ..end };
    if start_quality.is_better_than(&end_at_least) {
        (best, end) = (start, start_quality);
    }
    (best, end, shape_steps)
}

fn finished(
    domain: &Domain,
    mesh: &TriMesh,
    map: &RegionMap,
    best: Placement,
    report: RelaxReport,
) -> Result<Relaxed, RelaxError> {
    let inverted = inverted_of(domain, &best);
    let (mesh, map) = best.into_domain(domain, mesh, map)?;
    Ok(Relaxed { mesh, map, inverted, report })
}

/// Shape optimisation, and then the mending of what it left folded. Returns the number of Newton steps, too.
fn shaped_and_mended(
    mender: &Mender,
    targets: &IdVec<FaceId, f64>,
    start: &Placement,
    options: &ShapeOptions,
) -> (Placement, usize) {
    let (mut placement, steps) = optimise_shape(mender.domain, start.clone(), targets, options);
    mender.mend_folds(&mut placement);
    (placement, steps)
}
