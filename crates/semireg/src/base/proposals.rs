//! The base meshes that one setting proposes, one after the other.

use super::ground::{Admits, Ground, Made};
use super::patches::Patches;
use super::setting::Setting;
use super::stages::BaseStages;
use super::way::Way;
use crate::input::Input;
use crate::run::Run;
use crate::{Error, Method, Options};
use std::collections::VecDeque;
use std::sync::Arc;

/// Where fewer base vertices are wanted for each connected part, both ways are gone and the better rated base mesh is tried first: decimation
/// may cut limbs off then. More costs twice the time for more models. A number of ours has enough for each limb: there it is for all parts together.
const FEW: usize = 200;
/// Where the first subdivision of the decimated base mesh has less mean quality (AR) than this after its relaxation, patches are tried against it
/// too. More does so for more models. Measured after the search, which adds .02: patches were rated better by .06 and .04 on a noisy scan (.80) and on
/// 240 small parts (.84).
const POOR: f64 = 0.83;
/// Where so many base vertices are wanted patches are tried only where decimation fails: they take as long as all else. More tries both for larger
/// base meshes. Measured on twelve files with as many: none came out right by patches that did not by decimation.
const MANY: usize = 4_000;
/// Where none of the base meshes has more than this mean quality before the search, the shape takes more base vertices. The search adds .02 to it,
/// and what is certified then misses the input. Measured: .82 to .84 on lattices of round bars, chairs and figures with thin limbs, none of them right;
/// .87 and more on all files that are.
const COARSE: f64 = 0.85;
/// Base meshes that are rated lower than the best by less than this before the search are searched, too: which is better may turn. More searches more
/// that is thrown away. Measured: with none box12 lost .013 of AR, crossing_boxes .018.
const CLOSE: f64 = 0.03;

/// The base meshes that one setting proposes. Each is made when it is asked for.
pub(crate) struct Proposals<'a> {
    ground: Ground<'a>,
    /// Ways that were not yet gone. Those of a group are gone side by side.
    groups: VecDeque<Vec<Way>>,
    /// What the last group proposes beside what was taken, the best first.
    ready: VecDeque<Made>,
    /// What the paper's way made, if it was gone.
    patches: Option<Arc<Patches>>,
    /// Why ways led to no base mesh. It is told with the next one, or returned where there is none.
    failures: Vec<(Way, Error)>,
}

impl<'a> Proposals<'a> {
    /// Prepares what a setting proposes.
    ///
    /// `needed` base vertices are what corners and arcs took in an earlier attempt, 0 in the first. What is not
    /// admitted is refused, as early as can be.
    pub(crate) fn new(
        input: &'a Input,
        options: &'a Options,
        setting: &'a Setting,
        needed: usize,
        admits: &'a Admits<'a>,
        run: &mut Run,
    ) -> Result<Self, Error> {
        let ground = Ground::new(input, options, setting, needed, admits, run)?;
        let n_parts = if options.base_vertices.is_some() { ground.surface.topology().components().1 } else { 1 };
        let groups = match options.method {
            Method::Patches => vec![vec![Way::Patches]],
            Method::Decimation => vec![vec![Way::Decimation]],
            // It proposes its one base mesh by itself.
            Method::Paper => Vec::new(),
            Method::Best if ground.wanted < FEW * n_parts => vec![vec![Way::Decimation, Way::Patches]],
            Method::Best => vec![vec![Way::Decimation], vec![Way::Patches]],
        };
        Ok(Self { ground, groups: groups.into(), ready: VecDeque::new(), patches: None, failures: Vec::new() })
    }

    /// Whether all base meshes that would come next are too coarse for the shape. It is told before any of them is searched.
    pub(crate) fn are_coarse(&mut self, run: &mut Run) -> bool {
        self.make(run);
        !self.ready.is_empty() && self.ready.iter().all(|made| made.rated.quality < COARSE)
    }

    /// The next base mesh, the best of those made; `None` where there are no more. Fails where the ways that are left lead to none.
    pub(crate) fn next(&mut self, run: &mut Run) -> Result<Option<BaseStages>, Error> {
        self.make(run);
        self.search(run)?;
        let Some(best) = self.ready.pop_front() else { return self.failure().map_or(Ok(None), Err) };
        let failures = std::mem::take(&mut self.failures);
        Ok(Some(self.ground.stages(best, self.patches.clone(), &failures)))
    }

    /// Goes the ways in turn until one leads to a base mesh that is not poor, or to a large one.
    fn make(&mut self, run: &mut Run) {
        let is_large = self.ground.wanted >= MANY;
        while !self.ready.iter().any(|made| is_large || made.rated.quality >= POOR) {
            let Some(group) = self.groups.pop_front() else { break };
            self.go(&group, run);
        }
    }

    /// Searches for better connectivity of the best that is ready, and of what is rated about as high, at once.
    fn search(&mut self, run: &mut Run) -> Result<(), Error> {
        let Some(best) = self.ready.front().map(|made| made.rated.rating) else { return Ok(()) };
        let n_close = self.ready.iter().take_while(|made| made.rated.rating > best - CLOSE).count();
        let close: Vec<Made> = self.ready.drain(..n_close).collect();
        let ground = &self.ground;
        let searched = match <[Made; 2]>::try_from(close) {
            Ok([first, second]) => {
                let (first, second) = run.side_by_side(|run| ground.searched(first, run), |run| ground.searched(second, run));
                vec![first?, second?]
            }
            Err(close) => close.into_iter().map(|made| ground.searched(made, run)).collect::<Result<_, _>>()?,
        };
        self.ready.extend(searched);
        self.sort();
        Ok(())
    }

    /// Puts what is ready in order, the best first.
    fn sort(&mut self) {
        self.ready.make_contiguous().sort_by(|a, b| b.rated.rating.total_cmp(&a.rated.rating));
    }

    /// Goes some ways at once: none waits for the others before it has its rating.
    fn go(&mut self, ways: &[Way], run: &mut Run) {
        let ground = &self.ground;
        let made = match *ways {
            [first, second] => {
                let (first, second) = run.side_by_side(|run| ground.made(first, run), |run| ground.made(second, run));
                vec![first, second]
            }
            _ => ways.iter().map(|&way| ground.made(way, run)).collect(),
        };
        for (&way, made) in ways.iter().zip(made) {
            match made {
                Ok(made) => self.ready.push_back(made),
                Err(error) => self.failures.push((way, error)),
            }
        }
        self.patches = self.ready.iter().find_map(|made| made.patches.clone()).or(self.patches.take());
        self.sort();
    }

    /// Why there is no base mesh: that it is too large or that the run has ended, else what went wrong first.
    fn failure(&mut self) -> Option<Error> {
        let is_last_word = |(_, e): &(Way, Error)| matches!(e, Error::TooLarge { .. } | Error::Cancelled);
        let which = self.failures.iter().position(is_last_word).unwrap_or(0);
        self.failures.drain(..).nth(which).map(|(_, error)| error)
    }
}

#[cfg(test)]
mod tests {
    use super::super::rating::{rate, relaxed_once};
    use super::*;
    use crate::progress::Watch;
    use crate::rescue::PLAN;
    use mesh_core::TriMesh;

    /// What the base meshes of a shape are rated, in the order in which they are proposed.
    fn rated(mesh: &TriMesh, method: Method, base_vertices: usize) -> Vec<(Way, f64)> {
        let options = Options { base_vertices: Some(base_vertices), method, ..Options::default() };
        let run = &mut Run::new(Watch::default());
        let input = Input::new(&mesh.to_soup(), &options, run).unwrap();
        let mut proposals = Proposals::new(&input, &options, &PLAN[0].1, 0, &|_, _| Ok(()), run).unwrap();
        let rated = |stages: BaseStages| {
            let base = stages.base.mapped().unwrap();
            let relaxed = relaxed_once(stages.base_surface(), base, &options).unwrap();
            (stages.way, rate(stages.base_surface(), base, &relaxed, input.asked))
        };
        std::iter::from_fn(|| proposals.next(run).unwrap()).map(rated).collect()
    }

    #[test]
    fn of_few_vertices_the_better_base_mesh_is_tried_first() {
        let shapes = [fixtures::torus(1.0, 0.4, 32, 16), fixtures::cube(4), fixtures::l_block(4), fixtures::blob(8)];
        let orders: Vec<Vec<(Way, f64)>> = shapes.iter().map(|shape| rated(shape, Method::Best, 60)).collect();
        for order in &orders {
            assert!(matches!(order[..], [(first, better), (second, worse)] if first != second && better >= worse), "{order:?}");
        }
        // Each way wins on one of them; else the order could be fixed and this test would not tell.
        assert!([Way::Patches, Way::Decimation].iter().all(|way| orders.iter().any(|order| order[0].0 == *way)), "{orders:?}");
    }

    #[test]
    fn of_many_vertices_patches_are_the_second_choice() {
        let ways = |method, base_vertices| {
            rated(&fixtures::cube(8), method, base_vertices).into_iter().map(|r| r.0).collect::<Vec<Way>>()
        };
        assert_eq!(ways(Method::Best, FEW), [Way::Decimation, Way::Patches]);
        assert_eq!(ways(Method::Patches, FEW), [Way::Patches]);
        assert_eq!(ways(Method::Decimation, 60), [Way::Decimation]);
    }
}
