//! The verbs of this crate: quadric relaxation, then shape optimisation.

use crate::best_shape::best_shape;
use crate::measured::Measured;
use crate::mend::Mender;
use crate::movable_domain::MovableDomain;
use crate::placement::Placement;
use crate::places::relax_places;
use crate::quadric::relax_quadric;
use crate::shape::{entangled, sheet_targets};
use crate::weights::vertex_weights;
use crate::{Quality, RelaxError, RelaxOptions, ShapeOptions};
use mesh_core::{FaceId, IdVec, VertexId};
use region_map::{Domain, Surface};

/// Mean quality (AR) that the shape optimisation may give up. More lets it lift the worst triangles of a good start at the cost
/// of all others; with less such a result is thrown away.
const SLACK: f64 = 2e-3;

/// Up to this share of entangled triangles each place is untangled by itself. More does so with places that had better make way for each other.
const FEW_ENTANGLED: f64 = 2e-3;
/// Vertices up to so many edges away from them make way then. More frees more, and takes longer.
const REACH: usize = 4;

/// A relaxed domain.
#[derive(Clone, Debug)]
pub struct Relaxed {
    /// The domain with its vertices at the points of its region map: new points, arc lengths and spans.
    pub domain: Domain,
    /// The triangles that still face against the surface or have no area, in rising order.
    pub inverted: Vec<FaceId>,
    /// What was reached.
    pub report: RelaxReport,
}

impl Relaxed {
    /// The same, with a report that begins with the relaxation that it went on from.
    pub fn after(self, before: RelaxReport) -> Self {
        Self { report: before.then(self.report), ..self }
    }
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

impl RelaxReport {
    /// The report of this relaxation and of one that went on from it.
    pub fn then(self, after: Self) -> Self {
        let quadric_iterations = self.quadric_iterations + after.quadric_iterations;
        Self { quadric_iterations, shape_steps: self.shape_steps + after.shape_steps, end: after.end, ..self }
    }
}

/// Moves the vertices of a domain over the surface until its triangles are as near to equilateral as its connectivity and the
/// arcs allow.
///
/// Corners stay, vertices on arcs slide along them in their order, all others move inside their sheet. Vertices start at the
/// points of the region map; the positions of the domain's mesh are not read. Inverted triangles are turned back where that
/// succeeds; on the way others may be turned over for a while. The result is never worse than the start: it has no more inverted
/// triangles, and with as many a mean quality that is lower by .002 at most. [`RelaxReport::end`] tells how many are left.
///
/// Fails when the region map does not fit the domain or the surface, and for an option out of its range.
pub fn relax(surface: &Surface, domain: &Domain, options: &RelaxOptions) -> Result<Relaxed, RelaxError> {
    relax_holding(surface, domain, &[], options)
}

/// Relaxes as [`relax`] does, and holds some vertices where they are.
///
/// Fails as [`relax`] does, and for a held vertex that is not in the domain.
pub fn relax_holding(
    surface: &Surface,
    domain: &Domain,
    held: &[VertexId],
    options: &RelaxOptions,
) -> Result<Relaxed, RelaxError> {
    options.check()?;
    let (movable, placed, start) = started(surface, domain, held)?;

    let (relaxed, quadric_iterations) = if options.quadric.iterations == 0 {
        (placed, 0)
    } else {
        let weights = vertex_weights(surface, domain, options.quadric.weights);
        relax_quadric(&movable, placed, &weights, &options.quadric)
    };
    let after_quadric = Quality::of(&relaxed, &movable);
    let targets = sheet_targets(&movable, &domain.region.sheet_of_face, relaxed.placement());
    let mender = Mender::new(&movable);
    let (relaxed, steps_of_places) = untangled_in_places(&mender, &targets, relaxed, options);
    let mut best = best_shape(&mender, &targets, relaxed, SLACK, &options.shape);
    best.steps += steps_of_places;
    let report = RelaxReport { start, after_quadric, end: best.quality, quadric_iterations, shape_steps: best.steps };
    finished(&movable, domain, best.measured, report)
}

/// A domain with some vertices held, where its vertices begin, and how good it is there.
fn started<'a>(
    surface: &'a Surface,
    domain: &Domain,
    held: &[VertexId],
) -> Result<(MovableDomain<'a>, Measured, Quality), RelaxError> {
    let mut movable = MovableDomain::new(surface, domain)?;
    // A vertex that is held on an arc still has a normal on each side of it.
    let placed = Measured::new(&movable, Placement::of_region(&movable, &domain.region));
    movable.hold(held)?;
    let start = Quality::of(&placed, &movable);
    Ok((movable, placed, start))
}

/// Untangles each place by itself where few triangles are entangled: else all others take as many steps for their sake. Only where the paper's
/// relaxation is left out, and so the start is relaxed: from any other, the places are not what is wrong with it.
fn untangled_in_places(
    mender: &Mender,
    targets: &IdVec<FaceId, f64>,
    start: Measured,
    options: &RelaxOptions,
) -> (Measured, usize) {
    if options.quadric.iterations > 0 || options.shape.untangling_steps == 0 {
        return (start, 0);
    }
    let entangled = entangled(mender.domain, &start);
    let most = FEW_ENTANGLED * mender.domain.topology.n_faces() as f64;
    if entangled.is_empty() || entangled.len() as f64 > most {
        return (start, 0);
    }
    let mut placement = start.into_placement();
    let steps = relax_places(mender, targets, &mut placement, (&entangled, REACH), &options.shape);
    (Measured::new(mender.domain, placement), steps)
}

/// Optimises the shape of the triangles around some faces, and leaves vertices more than `edges` edges away from them, and those that are `held`, where
/// they are.
///
/// For the last folds of a relaxed domain: each place is relaxed by itself, as if there were no others. Otherwise as [`relax`],
/// without the paper's relaxation.
///
/// Fails as [`relax`] does, and for a face or a held vertex that is not in the domain.
pub fn relax_around(
    surface: &Surface,
    domain: &Domain,
    faces: &[FaceId],
    edges: usize,
    held: &[VertexId],
    options: &ShapeOptions,
) -> Result<Relaxed, RelaxError> {
    options.check()?;
    let (movable, placed, start) = started(surface, domain, held)?;
    if let Some(&f) = faces.iter().find(|&&f| movable.topology.faces().get(f).is_none()) {
        return Err(RelaxError::NoSuchFace(f));
    }
    let mut placement = placed.into_placement();
    let targets = sheet_targets(&movable, &domain.region.sheet_of_face, &placement);
    let shape_steps = relax_places(&Mender::new(&movable), &targets, &mut placement, (faces, edges), options);
    let relaxed = Measured::new(&movable, placement);
    let end = Quality::of(&relaxed, &movable);
    finished(&movable, domain, relaxed, RelaxReport { start, after_quadric: start, end, quadric_iterations: 0, shape_steps })
}

/// The faces of a domain that face against the surface or have no area, in rising order, with their vertices where the region map
/// has them.
///
/// Fails when the region map does not fit the domain or the surface.
pub fn inverted(surface: &Surface, domain: &Domain) -> Result<Vec<FaceId>, RelaxError> {
    let movable = MovableDomain::new(surface, domain)?;
    Ok(inverted_of(&Measured::new(&movable, Placement::of_region(&movable, &domain.region))))
}

fn inverted_of(measured: &Measured) -> Vec<FaceId> {
    measured.faces().enumerate().filter(|(_, face)| face.signed_area <= 0.0).map(|(f, _)| f).collect()
}

fn finished(movable: &MovableDomain, start: &Domain, best: Measured, report: RelaxReport) -> Result<Relaxed, RelaxError> {
    let inverted = inverted_of(&best);
    Ok(Relaxed { domain: best.into_placement().into_domain(movable, start)?, inverted, report })
}
