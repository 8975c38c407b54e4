//! The verbs: one loop over the plan, which keeps the best candidate.

use crate::attempt::Remedy;
use crate::base::{BaseStages, proposals};
use crate::best::Best;
use crate::finish::finished;
use crate::input::Input;
use crate::progress::{OnProgress, Watch, watched};
use crate::remeshed::{Based, Remeshed};
use crate::rescue::{Budget, Loss, PLAN};
use crate::run::Run;
use crate::verdict::Verdict;
use crate::{Error, Options};
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
/// within a quarter of a second with [`Error::Cancelled`], but for reading in and cleaning, which end by themselves.
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
    let mut remeshed = best_of_plan(&input, options, &mut run)?;
    (remeshed.report.seconds, remeshed.report.attempts) = run.end(start.elapsed().as_secs_f64());
    Ok(remeshed)
}

fn based(soup: &Soup, options: &Options, watch: Watch) -> Result<Based, Error> {
    let (start, mut run) = (Instant::now(), Run::new(watch));
    let input = Input::new(soup, options, &mut run)?;
    let stages = first_base(&input, options, &mut run)?;
    let (seconds, attempts) = run.end(start.elapsed().as_secs_f64());
    Ok(Based { stages, attempts, seconds })
}

/// Tries the settings of the plan, and both base meshes of each, until a result is certified and has lost no part of the input. Of those that
/// are only certified the best is returned when the plan or the budget is at its end.
fn best_of_plan(input: &Input, options: &Options, run: &mut Run) -> Result<Remeshed, Error> {
    let mut budget = Budget::new(input.asked, options.levels);
    let (mut best, mut needed) = (Best::new(), 0);
    // A base mesh that is given is the only one.
    let plan = if input.given.is_some() { &PLAN[..1] } else { &PLAN[..] };
    'plan: for &(first_remedy, ref setting) in plan {
        let mut start = Instant::now();
        if budget.is_spent() {
            break;
        }
        let proposed = match proposals(input, options, setting, needed, &|v, f| budget.admits(v, f), run) {
            Ok(proposed) => proposed,
            Err(e) => {
                run.record(first_remedy, None, e.verdict(), start);
                match best.fail(first_remedy, e) {
                    ControlFlow::Continue(()) => continue,
                    ControlFlow::Break(()) => break,
                }
            }
        };
        for (proposal, remedy) in proposed.into_iter().zip([first_remedy, Remedy::OtherBase]) {
            if budget.is_spent() {
                break 'plan;
            }
            let BaseStages { way, ref base, ref counts, .. } = *proposal.stages();
            needed = needed.max(counts.needed);
            budget.spend(base.mesh().n_faces());
            let searched = proposal.searched(options, run);
            let result = searched.and_then(|stages| finished(input, &stages, options, run));
            let verdict = result.as_ref().map_or_else(Error::verdict, |remeshed| verdict(input, options, remeshed));
            run.record(remedy, Some(way), verdict.clone(), start);
            let next = match result {
                Ok(remeshed) => best.pass(remedy, verdict, remeshed),
                Err(e) => best.fail(remedy, e),
            };
            if next.is_break() {
                break 'plan;
            }
            start = Instant::now();
        }
    }
    let (mut remeshed, warnings) = best.end()?;
    remeshed.report.warnings.splice(..0, warnings);
    Ok(remeshed)
}

/// Tries the settings of the plan until there is a base mesh.
fn first_base(input: &Input, options: &Options, run: &mut Run) -> Result<BaseStages, Error> {
    let mut best = Best::new();
    for &(remedy, ref setting) in &PLAN {
        let start = Instant::now();
        let next = match proposals(input, options, setting, 0, &|_, _| Ok(()), run) {
            Ok(proposed) => match proposed.into_iter().next().map(|first| first.searched(options, run)) {
                Some(Ok(stages)) => best.pass(remedy, Verdict::Certified, stages),
                Some(Err(e)) => best.fail(remedy, e),
                None => ControlFlow::Continue(()),
            },
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
    if loss.is_a_part(options.levels) { Verdict::Lost { base_edges } } else { Verdict::Certified }
}
