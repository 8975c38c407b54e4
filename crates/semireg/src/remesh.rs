//! The verbs: one loop over the plan, which keeps the best candidate.

use crate::attempt::Remedy;
use crate::base::{BaseStages, Method, Proposals, Setting, given, paper};
use crate::best::Best;
use crate::finish::{finished, paper_finished};
use crate::goal::{Goal, reached};
use crate::input::Input;
use crate::progress::{OnProgress, Watch, watched};
use crate::relaxation::Relaxation;
use crate::remeshed::{Based, Remeshed};
use crate::rescue::{Budget, Growth, Loss, PLAN, finest, growth};
use crate::run::Run;
use crate::verdict::Verdict;
use crate::{Error, Options};
use certify::Shortcoming;
use mesh_core::Soup;
use std::ops::ControlFlow;
use std::time::Instant;

/// Remeshes a soup of triangles: all stages, then the certificate. Nothing is returned that does not pass it.
///
/// Where a result is not right, other base meshes are tried (other creases, more vertices), and the best is kept: the report's attempts tell
/// what was tried. Large results have fewer tries.
pub fn remesh(soup: &Soup, options: &Options) -> Result<Remeshed, Error> {
    remeshed(soup, options, Watch::default())
}

/// The same, with a caller that follows the run and can end it.
///
/// `on_progress` is called on a thread of its own, at the start of each stage and about 20 times a second. When it breaks, the run ends
/// with [`Error::Cancelled`] as soon as its present step is done: that is a fraction of a second, on a million triangles a second or two.
///
/// ```
/// use semireg::{Error, Options, remesh_with};
/// use std::ops::ControlFlow;
///
/// let soup = fixtures::cube(3).to_soup();
/// let until_search = &mut |p: semireg::Progress| if p.stage == "search" { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
/// assert!(matches!(remesh_with(&soup, &Options::default(), until_search), Err(Error::Cancelled)));
/// ```
pub fn remesh_with(soup: &Soup, options: &Options, on_progress: &mut OnProgress<'_>) -> Result<Remeshed, Error> {
    watched(on_progress, |watch| remeshed(soup, options, watch))
}

/// The same as [`remesh_with`], with a result of a size that the caller names. `base_vertices`, `levels` and `max_distance` of the options are
/// not asked; [`Report::sizes`](crate::Report) tells what was tried.
///
/// Where a number or an edge length cannot be met, as corners and curves take more base vertices, the nearest result is returned with a
/// warning. Fails where no result keeps to a greatest error, and for a goal out of its range.
pub fn remesh_to(soup: &Soup, goal: &Goal, options: &Options, on_progress: &mut OnProgress<'_>) -> Result<Remeshed, Error> {
    watched(on_progress, |watch| {
        let (start, mut run) = (Instant::now(), Run::new(watch));
        let interrupt = run.interrupt().clone();
        let cleaned = run.stage("clean", || mesh_core::clean_until(soup, &options.clean, &interrupt))?;
        let mut make = |sized: &Options| best_of_plan(&Input::new(soup, sized, &mut run)?, sized, &mut run);
        let remeshed = reached(&cleaned, goal, options, &mut make)?;
        Ok(timed(remeshed, start, run))
    })
}

/// The stages from cleaning to the base mesh. Where there is none, the next setting of the plan is tried, and the warnings say so.
pub fn base(soup: &Soup, options: &Options) -> Result<Based, Error> {
    based(soup, options, Watch::default())
}

/// The same, with a caller that follows the run and can end it, as with [`remesh_with`].
pub fn base_with(soup: &Soup, options: &Options, on_progress: &mut OnProgress<'_>) -> Result<Based, Error> {
    watched(on_progress, |watch| based(soup, options, watch))
}

fn remeshed(soup: &Soup, options: &Options, watch: Watch) -> Result<Remeshed, Error> {
    let (start, mut run) = (Instant::now(), Run::new(watch));
    let input = Input::new(soup, options, &mut run)?;
    let remeshed = best_of_plan(&input, options, &mut run)?;
    Ok(timed(remeshed, start, run))
}

/// A result at the end of its run.
fn timed(mut remeshed: Remeshed, start: Instant, run: Run) -> Remeshed {
    (remeshed.report.seconds, remeshed.report.attempts) = run.end(start.elapsed().as_secs_f64());
    remeshed
}

fn based(soup: &Soup, options: &Options, watch: Watch) -> Result<Based, Error> {
    let (start, mut run) = (Instant::now(), Run::new(watch));
    let input = Input::new(soup, options, &mut run)?;
    let stages = first_base(&input, options, &mut run)?;
    let (seconds, attempts) = run.end(start.elapsed().as_secs_f64());
    Ok(Based { stages, attempts, seconds })
}

/// Tries the settings of the plan, and both base meshes of each, until a result is certified and has lost no part of the input. Where no number
/// of base vertices is asked for, it then gets more of them as long as it is too coarse for the shape. The best is returned when the plan or the
/// budget is at its end.
fn best_of_plan(input: &Input, options: &Options, run: &mut Run) -> Result<Remeshed, Error> {
    let budget = Budget::new(input.asked, input.levels);
    let sized = Options { levels: Some(input.levels), ..options.clone() };
    let mut tries = Tries { input, options: &sized, budget, needed: 0, times: 1.0, best: Best::new() };
    let start = Instant::now();
    match only_base(input, &sized, run) {
        Some(made) => drop(tries.only(made, start, run)),
        None => {
            let _ = tries.plan(options, run);
            if options.base_vertices.is_none() {
                tries.grow(options.levels.is_none(), run);
            }
        }
    }
    let (mut remeshed, warnings) = tries.best.end()?;
    remeshed.report.warnings.splice(..0, warnings);
    Ok(remeshed)
}

/// What is tried, and the best that has come of it.
struct Tries<'a> {
    input: &'a Input,
    /// With the number of levels.
    options: &'a Options,
    budget: Budget,
    /// Base vertices that corners and arcs took so far at most.
    needed: usize,
    /// How many times the base vertices asked for were tried at most.
    times: f64,
    best: Best<Remeshed>,
}

impl Tries<'_> {
    /// Tries the settings of the plan until a result has all parts of the input. Where neither base vertices nor levels are `asked` for, the finest base
    /// mesh comes second, or first where the others are too coarse.
    fn plan(&mut self, asked: &Options, run: &mut Run) -> ControlFlow<()> {
        let is_size_ours = asked.base_vertices.is_none() && asked.levels.is_none();
        let finer = finest(self.input.asked, self.options.levels()).filter(|_| is_size_ours);
        for (remedy, setting) in &PLAN {
            self.setting(*remedy, setting, self.untried(finer), run)?;
            if let Some(step) = self.untried(finer) {
                self.grown(step, run)?;
            }
        }
        ControlFlow::Continue(())
    }

    /// A finer base mesh, if none as fine was tried and the budget bears it.
    fn untried(&self, finer: Option<Growth>) -> Option<Growth> {
        finer.filter(|step| step.times > self.times && self.budget.bears(*step))
    }

    /// Tries the base meshes of a setting, and before them the finer one if they are too coarse. Breaks where nothing more shall be tried.
    fn setting(&mut self, remedy: Remedy, setting: &Setting, finer: Option<Growth>, run: &mut Run) -> ControlFlow<()> {
        let budget = self.budget;
        let admits = |vertices, faces| budget.admits(vertices, faces);
        let mut start = Instant::now();
        let mut proposals = match Proposals::new(self.input, self.options, setting, self.needed, &admits, run) {
            Ok(proposals) => proposals,
            Err(e) => return self.no_base(remedy, e, start, run),
        };
        if let Some(step) = finer
            && proposals.are_coarse(run)
        {
            self.grown(step, run)?;
            start = Instant::now();
        }
        for remedy in [remedy, Remedy::OtherBase] {
            if self.budget.is_spent() {
                return ControlFlow::Break(());
            }
            match proposals.next(run) {
                Ok(Some(stages)) => {
                    self.needed = self.needed.max(stages.counts.needed);
                    self.base(self.options, remedy, &stages, start, run)?;
                }
                Ok(None) => break,
                // Where one way led to a base mesh other settings may help.
                Err(e) if remedy == Remedy::OtherBase => drop(self.no_base(remedy, e, start, run)),
                Err(e) => return self.no_base(remedy, e, start, run),
            }
            start = Instant::now();
        }
        ControlFlow::Continue(())
    }

    /// Tries more base vertices than before as long as the best result is too coarse for the shape, and they help much.
    fn grow(&mut self, are_levels_ours: bool, run: &mut Run) {
        let Some(Verdict::Short { shortcomings }) = self.best.verdict() else { return };
        let is_poor = shortcomings.iter().any(|s| matches!(s, Shortcoming::MeanShape(_) | Shortcoming::LeastShape(_)));
        for step in growth(self.input.asked, self.options.levels(), are_levels_ours, is_poor) {
            let Some(before) = self.best.verdict().cloned() else { return };
            if step.times <= self.times {
                continue;
            }
            if !matches!(before, Verdict::Short { .. }) || !self.budget.bears(step) {
                return;
            }
            let next = self.grown(step, run);
            if next.is_break() && !self.best.verdict().is_some_and(|now| now.is_far_better_than(&before)) {
                return;
            }
        }
    }

    /// Tries a base mesh with more vertices. Breaks where nothing more shall be tried.
    fn grown(&mut self, step: Growth, run: &mut Run) -> ControlFlow<()> {
        self.times = self.times.max(step.times);
        let (start, setting) = (Instant::now(), step.setting());
        let options = Options { levels: Some(step.levels), ..self.options.clone() };
        let made = Proposals::new(self.input, &options, &setting, self.needed, &|_, _| Ok(()), run);
        match made.and_then(|mut proposals| proposals.next(run)) {
            Ok(Some(stages)) => self.base(&options, step.remedy(), &stages, start, run),
            Ok(None) => ControlFlow::Break(()),
            Err(e) => self.no_base(step.remedy(), e, start, run),
        }
    }

    /// Tries the only base mesh that there is.
    fn only(&mut self, made: Result<BaseStages, Error>, start: Instant, run: &mut Run) -> ControlFlow<()> {
        let admitted = made.and_then(|stages| {
            let mesh = stages.base.mesh();
            self.budget.admits(mesh.n_vertices(), mesh.n_faces())?;
            Ok(stages)
        });
        match admitted {
            Ok(stages) => self.base(self.options, Remedy::AsAsked, &stages, start, run),
            Err(e) => self.no_base(Remedy::AsAsked, e, start, run),
        }
    }

    /// Takes that there is no base mesh. Breaks where nothing more shall be tried.
    fn no_base(&mut self, remedy: Remedy, error: Error, start: Instant, run: &mut Run) -> ControlFlow<()> {
        run.record(remedy, None, error.verdict(), start);
        self.best.fail(remedy, error)
    }

    /// Tries a base mesh. Breaks where nothing more shall be tried.
    fn base(&mut self, options: &Options, remedy: Remedy, stages: &BaseStages, start: Instant, run: &mut Run) -> ControlFlow<()> {
        self.budget.spend(stages.base.mesh().n_faces(), options.levels());
        let result = match options.relaxation {
            Relaxation::Paper(paper) => paper_finished(self.input, stages, paper, options, run),
            Relaxation::Shape => finished(self.input, stages, options, run),
        };
        let verdict = result.as_ref().map_or_else(Error::verdict, |remeshed| verdict(self.input, options, remeshed));
        run.record(remedy, Some(stages.way), verdict.clone(), start);
        match result {
            Ok(remeshed) => self.best.pass(remedy, verdict, remeshed),
            Err(e) => self.best.fail(remedy, e),
        }
    }
}

/// The base mesh beside which no other is tried: the one that the options give, or that of the paper. `None` where there is a choice.
fn only_base(input: &Input, options: &Options, run: &mut Run) -> Option<Result<BaseStages, Error>> {
    match (&input.given, options.method) {
        (Some(base), _) => Some(given(input, base, options, run)),
        (None, Method::Paper) => Some(paper(input, options, run)),
        (None, _) => None,
    }
}

/// Tries the settings of the plan until there is a base mesh.
fn first_base(input: &Input, options: &Options, run: &mut Run) -> Result<BaseStages, Error> {
    if let Some(made) = only_base(input, options, run) {
        return made;
    }
    let mut best = Best::new();
    for &(remedy, ref setting) in &PLAN {
        let start = Instant::now();
        let first = Proposals::new(input, options, setting, 0, &|_, _| Ok(()), run).and_then(|mut proposals| proposals.next(run));
        let next = match first {
            Ok(Some(stages)) => best.pass(remedy, Verdict::Certified, stages),
            Ok(None) => ControlFlow::Continue(()),
            Err(e) => {
                run.record(remedy, None, e.verdict(), start);
                best.fail(remedy, e)
            }
        };
        if next.is_break() {
            break;
        }
    }
    let (mut stages, warnings) = best.end()?;
    stages.warnings.splice(..0, warnings);
    Ok(stages)
}

/// What a certified result comes to.
fn verdict(input: &Input, options: &Options, remeshed: &Remeshed) -> Verdict {
    let of_diagonal = remeshed.report.certificate.measures.distance.worse().max;
    let base_edges = of_diagonal * input.cleaned.mesh.diagonal() / input.base_edge_length();
    let loss = Loss { of_diagonal, base_edges };
    let is_lost = loss.is_a_part(options.levels());
    if is_lost { Verdict::Lost { base_edges } } else { Verdict::of(remeshed.report.shortcomings.clone()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ring that is thin against the base edges falls short of its shape. Where no number is asked for it gets more base vertices, as many
    /// times as that helps.
    #[test]
    fn what_is_too_coarse_for_its_shape_is_made_finer() {
        let asked = Options { base_vertices: Some(24), levels: Some(1), ..Options::default() };
        let run = &mut Run::new(Watch::default());
        let input = Input::new(&fixtures::torus(1.0, 0.2, 64, 24).to_soup(), &asked, run).unwrap();
        let made = |remeshed: &Remeshed| remeshed.stages.base.base.mesh().n_vertices();
        let as_asked = best_of_plan(&input, &asked, run).unwrap();
        let severity = |r: &Remeshed| r.report.shortcomings.iter().map(Shortcoming::severity).sum::<f64>();
        assert!(severity(&as_asked) > 0.0 && made(&as_asked) < 30, "{:?}", as_asked.report.shortcomings);
        let grown = best_of_plan(&input, &Options { base_vertices: None, ..asked }, run).unwrap();
        assert!(severity(&grown) < severity(&as_asked) && made(&grown) > 40, "{:?}", grown.report.shortcomings);
    }
}
