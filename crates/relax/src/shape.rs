//! Shape optimisation of the finest level: Newton's method with walks for steps.
//!
//! The unknowns are tangential: two at a vertex inside a sheet, one on an arc, none at a corner. Each step minimises the
//! second-order model of the energy by conjugate gradients, walks, puts back what it made bad, and is halved until the energy
//! falls. While triangles are inverted or nearly so the energy is regularised, less and less as the worst of them improves.

use crate::ShapeOptions;
use crate::energy::{Expansion, Goal, Measures, Metric};
use crate::freedom::Freedom;
use crate::measured::Measured;
use crate::movable_domain::{MovableDomain, each};
use crate::placement::Placement;
use crate::system::{Element, Pattern, System};
use glam::{DMat2, DVec2, DVec3};
use mesh_core::{FaceId, Id, IdVec, VertexId};
use region_map::SheetId;

/// Conjugate gradients lower the residual to this share: less makes each Newton step better and dearer.
const SOLVER_TOLERANCE: f64 = 0.1;
/// They take so many iterations at most: where the cap ends them early, a step is less good and cheaper.
const SOLVER_STEPS: usize = 100;
/// How often a step that does not lower the energy is halved before it is given up. More finds steps that hardly move anything.
const HALVINGS: i32 = 8;
/// Triangles below this share of the mean area around them still count as entangled: without regularisation their energy would be
/// so high that the gain of all others did not show. More leaves more of the work to the untangling, which does not look at
/// shapes alone.
const SOUND_AREA: f64 = 0.05;
/// The regularisation, as a share of the area that the worst triangle lacks. Starts with 3 to 5,340 inverted triangles (rabbit,
/// rocker arm, lion, kitten, six fixtures; up to 77 % of all) come free with shares from 0.3 to 1. The areas are shares of those
/// at the start: where they followed the present ones, triangles collapsed together with what was around them.
const REGULARISATION: f64 = 0.5;
/// So much lacking area is counted at most, as a share: where more was, one large inverted triangle made all others give way.
const MOST_LACKING: f64 = 1.0;
/// Steps spent at most on raising the least area to [`SOUND_AREA`] once no triangle is inverted. More opens more slivers, and
/// costs time.
const SOUNDING_STEPS: usize = 10;
/// Triangles below this share of that mean stay regularised to the end: they are so stiff that for the solver all others would be
/// rounding. More gives up the shapes of more triangles.
const COLLAPSED: f64 = 0.01;
/// No triangle counts for more than this while smoothing (AR .01): one with 1e30 would hide the gain of all others, and end it at
/// once. Less gives up poor triangles sooner. Measured on crank_cse: mean AR .728 to .757 after the relaxation, with
/// [`COLLAPSED`] and this.
const MOST_ENERGY: f64 = 1e4;
/// A step of untangling that lowers the energy by less than this share is idle. Less lets it go on for longer.
const LEAST_PROGRESS: f64 = 1e-4;
/// This many idle steps in a row end the untangling: more of them may get over a standstill, and cost time where
/// nothing comes free.
const MOST_IDLE: usize = 8;
/// Each step is also tried in a tamed form: triangles whose energy grows by more than this factor are put back where they were.
/// The better of both is taken. Always the tamed one stopped a rocker arm at a mean AR of .952 (what is put back holds up its
/// neighbours), never a rabbit at .858; the better of both gave .960 and .958. That rabbit, from a folded start, still stalls
/// between .94 and .96, depending on its start.
const MOST_GROWTH: f64 = 10.0;
/// Where no step lowers the energy, this share of one is taken, and all triangles are put back that got worse by it. More moves
/// farther where little is put back.
const TAMED_SHARE: f64 = 0.5;
/// What an inverted triangle costs, and any other at most, in energies of equilateral ones. More makes edits that undo a fold
/// dearer to refuse.
const MOST_COST: f64 = 100.0;
/// This many steps in a row that gain less than the tolerance end the smoothing. More lets it get over a standstill, and costs
/// time.
const MOST_SMALL_GAINS: usize = 3;

/// Optimises the shape of all triangles. Returns where they are then, and the number of Newton steps.
pub(crate) fn optimise_shape(
    domain: &MovableDomain,
    start: Measured,
    targets: &IdVec<FaceId, f64>,
    options: &ShapeOptions,
) -> (Measured, usize) {
    let mut optimiser = Optimiser::new(domain, start, targets, options);
    let untangling = optimiser.untangle(options);
    let smoothing = optimiser.smooth(options);
    (optimiser.now, untangling + smoothing)
}

/// The triangles that are inverted or nearly so, against what is around them.
pub(crate) fn entangled(domain: &MovableDomain, measured: &Measured) -> Vec<FaceId> {
    let scales = local_areas(domain, measured.placement());
    domain.topology.faces().ids().filter(|&f| measured.faces()[f].signed_area < SOUND_AREA * scales[f.index()]).collect()
}

/// The areas wanted of all faces of a domain: the means over their sheets.
pub(crate) fn sheet_targets(domain: &MovableDomain, sheets: &IdVec<FaceId, SheetId>, start: &Placement) -> IdVec<FaceId, f64> {
    let means = sheet_means(domain, sheets, start);
    sheets.iter().map(|s| means[s.index()]).collect()
}

/// By how much the energies of all faces exceed the least one, at most [`MOST_COST`].
pub(crate) fn costs(measured: &Measured, targets: &IdVec<FaceId, f64>, options: &ShapeOptions) -> Vec<f64> {
    measured.faces().enumerate().map(|(f, face)| cost(face, targets[f], options)).collect()
}

/// The same of one face that shall have an area of `target`.
pub(crate) fn cost(face: &Measures, target: f64, options: &ShapeOptions) -> f64 {
    let metric = Metric { power: options.power.max(1.0), size_weight: options.size_weight.max(0.0), cap: f64::INFINITY };
    face.energy(Goal { target, eps: 0.0 }, &metric).min(MOST_COST) - (1.0 + metric.size_weight)
}

struct Optimiser<'a> {
    domain: &'a MovableDomain<'a>,
    pattern: Pattern,
    targets: &'a IdVec<FaceId, f64>,
    metric: Metric,
    /// Regularisation of each face, an area.
    eps: IdVec<FaceId, f64>,
    now: Measured,
}

/// Where a step leads to.
#[derive(Clone)]
struct Trial {
    measured: Measured,
    /// Of all triangles.
    energies: Vec<f64>,
}

/// A step that lowers the energy.
struct Step {
    before: f64,
    after: f64,
    trial: Trial,
}

impl<'a> Optimiser<'a> {
    fn new(domain: &'a MovableDomain<'a>, now: Measured, targets: &'a IdVec<FaceId, f64>, options: &ShapeOptions) -> Self {
        let metric = Metric { power: 1.0, size_weight: options.size_weight.max(0.0), cap: f64::INFINITY };
        let eps = IdVec::filled(0.0, domain.topology.n_faces());
        Self { domain, pattern: Pattern::new(&domain.topology), targets, metric, eps, now }
    }

    /// Steps on the regularised energy until no triangle is inverted or nearly so. Returns their number.
    fn untangle(&mut self, options: &ShapeOptions) -> usize {
        let scales = local_areas(self.domain, self.now.placement());
        let (mut steps, mut upright_steps, mut idle) = (0, 0, 0);
        while steps < options.untangling_steps && upright_steps < SOUNDING_STEPS && idle < MOST_IDLE {
            if self.domain.is_interrupted() {
                break;
            }
            let worst = self.signed_areas().zip(&scales).map(|(area, scale)| area / scale).fold(f64::INFINITY, f64::min);
            if worst >= SOUND_AREA {
                break;
            }
            let lacking = (SOUND_AREA - worst).min(MOST_LACKING);
            self.eps = scales.iter().map(|scale| REGULARISATION * lacking * scale).collect();
            let upright = worst > 0.0;
            let Some(step) = self.step(upright, &self.energies(&self.now)) else { break };
            idle = if step.before - step.after < LEAST_PROGRESS * step.before { idle + 1 } else { 0 };
            self.now = step.trial.measured;
            steps += 1;
            upright_steps += usize::from(upright);
        }
        // What is still inverted or next to it stays regularised, so that all others can go on.
        let eps = |(area, scale): (f64, &f64)| if area > COLLAPSED * scale { 0.0 } else { REGULARISATION * SOUND_AREA * scale };
        self.eps = self.signed_areas().zip(&scales).map(eps).collect();
        steps
    }

    /// Steps on the energy itself until it hardly falls, or the cap. Returns their number.
    fn smooth(&mut self, options: &ShapeOptions) -> usize {
        self.metric.power = options.power.max(1.0);
        self.metric.cap = MOST_ENERGY;
        let least = (1.0 + self.metric.size_weight) * self.domain.topology.n_faces() as f64;
        let (mut small_gains, mut energies) = (0, self.energies(&self.now));
        for steps in 0..options.steps {
            if self.domain.is_interrupted() {
                return steps;
            }
            let Some(step) = self.step(true, &energies) else { return steps };
            let is_small = step.before - step.after < options.tolerance * (step.before - least);
            (self.now, energies) = (step.trial.measured, step.trial.energies);
            small_gains = if is_small { small_gains + 1 } else { 0 };
            if small_gains == MOST_SMALL_GAINS {
                return steps + 1;
            }
        }
        options.steps
    }

    /// One Newton step from the present energies; `None` when no step lowers their sum. With `hold` no triangle that faces with
    /// the surface is turned over.
    fn step(&self, hold: bool, present: &[f64]) -> Option<Step> {
        let before = present.iter().sum();
        let frames = self.frames();
        let system = System::assemble(&self.pattern, &self.domain.topology, &self.elements(&frames));
        let solution = system.solve(SOLVER_TOLERANCE, SOLVER_STEPS);
        // No vertex' way is cut short by itself: where a whole region slides, that would squeeze it (measured on the rabbit: .930
        // after 30 steps instead of .979).
        let trial = |share: f64| {
            let way = |v: VertexId| {
                let ([x, y], d) = (frames[v], share * solution[v.index()]);
                d.x * x + d.y * y
            };
            let mut measured = Measured::new(self.domain, self.now.placement().displaced(self.domain, way));
            if hold {
                measured.hold_upright(self.domain, &self.now);
            }
            Trial { energies: self.energies(&measured), measured }
        };
        let gain = |trial: Trial| {
            let after = trial.energies.iter().sum();
            (after < before).then_some(Step { before, after, trial })
        };
        let shares = (0..=HALVINGS).map(|halvings| 0.5f64.powi(halvings));
        let step = shares.into_iter().find_map(|share| gain(self.better_tamed_or_not(trial(share), present)));
        // Where a few triangles hold up all others these go on alone.
        step.or_else(|| gain(self.tamed(trial(TAMED_SHARE), present, 1.0)))
    }

    /// The trial as it is, or with all triangles put back where they were whose energy grew much beyond the one before.
    fn better_tamed_or_not(&self, wild: Trial, before: &[f64]) -> Trial {
        if wild.energies.iter().zip(before).all(|(after, before)| *after <= MOST_GROWTH * before) {
            return wild;
        }
        let tamed = self.tamed(wild.clone(), before, MOST_GROWTH);
        let is_better = tamed.energies.iter().sum::<f64>() < wild.energies.iter().sum();
        if is_better { tamed } else { wild }
    }

    /// The trial with all triangles put back where they were whose energy grew by more than a factor, then those for which this
    /// does, until there are none.
    fn tamed(&self, mut trial: Trial, before: &[f64], most_growth: f64) -> Trial {
        let grew = |trial: &Trial, f: FaceId| trial.energies[f.index()] > most_growth * before[f.index()];
        let mut bad: Vec<FaceId> = self.domain.topology.faces().ids().filter(|&f| grew(&trial, f)).collect();
        while !bad.is_empty() {
            let changed = trial.measured.put_back(self.domain, self.now.placement(), &bad);
            for &f in &changed {
                trial.energies[f.index()] = self.energy(&trial.measured, f);
            }
            bad = changed.into_iter().filter(|&f| grew(&trial, f)).collect();
        }
        trial
    }

    fn goal(&self, f: FaceId) -> Goal {
        Goal { target: self.targets[f], eps: self.eps[f] }
    }

    fn energy(&self, measured: &Measured, f: FaceId) -> f64 {
        measured.faces()[f].energy(self.goal(f), &self.metric)
    }

    /// The energies of all faces.
    fn energies(&self, measured: &Measured) -> Vec<f64> {
        self.domain.of_faces(|f| self.energy(measured, f))
    }

    /// The signed areas of all faces.
    fn signed_areas(&self) -> impl Iterator<Item = f64> {
        self.now.faces().iter().map(|face| face.signed_area)
    }

    /// The directions that each free vertex can move in: two, one and 0, or both 0.
    fn frames(&self) -> IdVec<VertexId, [DVec3; 2]> {
        let frame = |v: VertexId| {
            let placed = &self.now.placement()[v];
            match &self.domain.freedoms[v] {
                Freedom::Fixed => [DVec3::ZERO; 2],
                Freedom::Arc(on_arc) => [self.domain.arc_direction(on_arc, placed.t), DVec3::ZERO],
                Freedom::Sheet => match placed.normals[0].try_normalize() {
                    Some(normal) => normal.any_orthonormal_pair().into(),
                    None => [DVec3::ZERO; 2],
                },
            }
        };
        IdVec::from_vec(each(self.domain.freedoms.len(), frame))
    }

    /// What each triangle adds to the system.
    fn elements(&self, frames: &IdVec<VertexId, [DVec3; 2]>) -> Vec<Element> {
        self.domain.of_faces(|f| {
            let frames = self.domain.topology.face(f).map(|v| frames[v]);
            let corners = self.now.placement().triangle(self.domain, f);
            element(&self.now.faces()[f].expansion(corners, self.goal(f), &self.metric), &frames)
        })
    }
}

/// The second-order model of a triangle's energy in the frames of its corners.
fn element(e: &Expansion, frames: &[[DVec3; 2]; 3]) -> Element {
    let into_frame = |i: usize, g: DVec3| DVec2::new(frames[i][0].dot(g), frames[i][1].dot(g));
    let [l, a, g] = [e.lengths, e.areas, e.gradient].map(|d| [0, 1, 2].map(|i| into_frame(i, d[i])));
    let block = |i: usize, j: usize| {
        let [x, y] = frames[j].map(|axis| into_frame(i, axis));
        let m = if i == j { 4.0 } else { -2.0 };
        DMat2::from_cols(x, y) * (m * e.stiffness)
            + outer(e.ll * l[i] + e.la * a[i], l[j])
            + outer(e.la * l[i] + e.aa * a[i], a[j])
    };
    Element {
        diagonal: [0, 1, 2].map(|i| block(i, i)),
        off_diagonal: [block(0, 1), block(1, 2), block(2, 0)],
        right: g.map(|g| -g),
    }
}

fn outer(a: DVec2, b: DVec2) -> DMat2 {
    DMat2::from_cols(a * b.x, a * b.y)
}

/// The mean unsigned area of the faces of every sheet.
pub(crate) fn sheet_means(domain: &MovableDomain, sheets: &IdVec<FaceId, SheetId>, placement: &Placement) -> Vec<f64> {
    let mut sums = vec![(0.0, 0usize); domain.surface.network().n_sheets];
    for f in domain.topology.faces().ids() {
        let (sum, n) = &mut sums[sheets[f].index()];
        *sum += mesh_core::area(placement.triangle(domain, f));
        *n += 1;
    }
    sums.into_iter().map(|(sum, n)| sum / n.max(1) as f64).collect()
}

/// For every face the mean unsigned area of the faces around its corners: the scale of the places where triangles fold.
fn local_areas(domain: &MovableDomain, placement: &Placement) -> Vec<f64> {
    let areas: Vec<f64> = domain.of_faces(|f| mesh_core::area(placement.triangle(domain, f)));
    let around = |f: FaceId| domain.topology.face(f).into_iter().flat_map(|v| domain.topology.faces_at(v));
    domain.of_faces(|f| {
        let (sum, n) = around(f).fold((0.0, 0), |(sum, n), g| (sum + areas[g.index()], n + 1));
        sum / f64::from(n)
    })
}
