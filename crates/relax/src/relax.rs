//! The verb of this crate: quadric relaxation, then shape optimisation.

use crate::domain::Domain;
use crate::mend::Mender;
use crate::placement::Placement;
use crate::quadric::relax_quadric;
use crate::shape::{optimise_shape, target_areas};
use crate::{Quality, RelaxError, RelaxOptions, ShapeOptions};
use mesh_core::{Topology, TriMesh};
use region_map::{RegionMap, Surface};

/// Mean quality that the shape optimisation may give up: where the start is good, it is the worst triangles that it lifts.
const SLACK: f64 = 2e-3;

/// A relaxed domain.
#[derive(Clone, Debug)]
pub struct Relaxed {
    /// The domain with its vertices at the points of the map.
    pub mesh: TriMesh,
    /// The map with new points, arc lengths and spans.
    pub map: RegionMap,
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
    let domain = Domain::new(surface, topology, map)?;
    let start = Placement::of_map(&domain, map);
    let start_quality = Quality::of(&start, &domain);

    let (relaxed, quadric_iterations) = relax_quadric(&domain, start, &options.quadric);
    let after_quadric = Quality::of(&relaxed, &domain);
    let mender = Mender::new(&domain);
    let (mut best, mut shape_steps) = shaped_and_mended(&domain, map, &mender, &relaxed, &options.shape)?;
    let mut end = Quality::of(&best, &domain);
    if end.inverted > 0 {
        // Untangling moves far; where it fails, the start may have been nearer to a sound mesh.
        let smooth_only = ShapeOptions { untangling_steps: 0, ..options.shape.clone() };
        let mut mended = relaxed.clone();
        mender.mend_folds(&mut mended);
        let (other, steps) = shaped_and_mended(&domain, map, &mender, &mended, &smooth_only)?;
        let quality = Quality::of(&other, &domain);
        shape_steps += steps;
        if quality.is_better_than(&end) {
            (best, end) = (other, quality);
        }
    }
    let end_at_least = Quality { ar_mean: end.ar_mean + SLACK, ..end };
    if after_quadric.is_better_than(&end_at_least) {
        (best, end) = (relaxed, after_quadric);
    }
    let (mesh, map) = best.into_domain(&domain, mesh, map)?;
    let report = RelaxReport { start: start_quality, after_quadric, end, quadric_iterations, shape_steps };
    Ok(Relaxed { mesh, map, report })
}

/// Shape optimisation, and then the mending of what it left folded. Returns the number of Newton steps, too.
fn shaped_and_mended(
    domain: &Domain,
    map: &RegionMap,
    mender: &Mender,
    start: &Placement,
    options: &ShapeOptions,
) -> Result<(Placement, usize), RelaxError> {
    let targets = target_areas(domain, &map.sheet_of_face, start, &options.target)?;
    let (mut placement, steps) = optimise_shape(domain, start.clone(), &targets, options);
    mender.mend_folds(&mut placement);
    Ok((placement, steps))
}
