//! The base meshes that one setting proposes, one after the other.

use super::decimation::decimation;
use super::patches::{Patches, patches};
use super::search::{Searched, retraced, searched};
use super::setting::Setting;
use super::stages::{Base, BaseCounts, BaseStages};
use super::way::Way;
use crate::input::Input;
use crate::run::Run;
use crate::{Error, Method, Options};
use mesh_core::equilateral_edge_length;
use proxy::{Proxy, ProxyOptions};
use region_map::{BaseMesh, Sizing, Surface};
use sizing::SizingOptions;
use std::collections::VecDeque;
use std::sync::Arc;

/// Refuses a base mesh of so many vertices and faces where its finest level would be too large.
pub(crate) type Admits<'a> = dyn Fn(usize, usize) -> Result<(), Error> + Sync + 'a;

/// Where fewer base vertices are wanted for each connected part, both ways are gone and the better rated base mesh is tried first: decimation may cut limbs off then.
/// More costs twice the time for more models.
const FEW: usize = 200;
/// Where the first subdivision of the decimated base mesh has less mean quality (AR) than this after its relaxation, patches are tried against it
/// too. More does so for more models. Measured: patches were rated better by .06 and .04 on a noisy scan (.80) and on 240 small parts (.84).
const POOR: f64 = 0.85;

/// A proxy has so many faces for each base face that is wanted. More sees finer shapes, and takes as much longer.
const PROXY_FACES: usize = 25;
/// A surface with this many times the faces that its proxy would have gets one. Less saves time on more inputs, and changes their results.
const DENSE: usize = 2;
/// Edges of a proxy are at most this share of a base edge, as those of the working mesh are kept short.
const PROXY_EDGE: f64 = 0.35;
/// A proxy keeps nearer to the surface than this share of a base edge, even if it then has more faces.
const PROXY_DISTANCE: f64 = 0.01;

/// The base meshes that one setting proposes. Each is made when it is asked for.
pub(crate) struct Proposals<'a> {
    ground: Ground<'a>,
    /// Ways that were not yet gone. Those of a group are gone side by side.
    groups: VecDeque<Vec<Way>>,
    /// What the last group proposes beside what was taken, the best first.
    ready: VecDeque<Rated>,
    /// What the paper's way made, if it was gone.
    patches: Option<Arc<Patches>>,
    /// Why ways led to no base mesh. It is told with the next one, or returned where there is none.
    failures: Vec<(Way, Error)>,
}

/// What the base meshes of a setting are made on.
struct Ground<'a> {
    input: &'a Input,
    options: &'a Options,
    setting: &'a Setting,
    surface: Surface,
    /// What stands for the surface, where that is dense.
    proxy: Option<Arc<Proxy>>,
    /// How long base edges shall be, at the vertices of what the base mesh is made on.
    sizing: Sizing,
    wanted: usize,
    admits: &'a Admits<'a>,
}

/// A base mesh, and what it promises.
struct Rated {
    rating: f64,
    /// The mean quality (AR) of its first subdivision, relaxed.
    quality: f64,
    way: Way,
    base: BaseMesh,
    /// What the paper's way made, on that way.
    patches: Option<Arc<Patches>>,
    /// What went wrong on the way to it.
    faults: Vec<String>,
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
        let at_least = if setting.as_needed { needed.max(input.asked) } else { input.asked };
        let wanted = (at_least as f64 * setting.base_vertices).round() as usize;
        let surface = detected(input, options, setting, wanted, run)?;
        let least = surface.network().least_base(surface.topology());
        admits(least.vertices, least.triangles)?;
        let base_edge_length = equilateral_edge_length(surface.mesh().total_area(), wanted);
        let sizing_options = SizingOptions { turn: setting.turn, ..SizingOptions::new(base_edge_length) };
        let sizing = run.stage("sizing", || sizing::sizing(&surface, &sizing_options))?;
        let (_, n_parts) = surface.topology().components();
        let groups = match options.method {
            Method::Patches => vec![vec![Way::Patches]],
            Method::Decimation => vec![vec![Way::Decimation]],
            Method::Best if wanted < FEW * n_parts => vec![vec![Way::Decimation, Way::Patches]],
            Method::Best => vec![vec![Way::Decimation], vec![Way::Patches]],
        };
        let proxy = proxy_of(&surface, &sizing, base_edge_length, wanted, run)?;
        let sizing = proxy.as_ref().map_or(Ok(sizing.clone()), |proxy| proxy.sizing(&sizing))?;
        let ground = Ground { input, options, setting, surface, proxy, sizing, wanted, admits };
        Ok(Self { ground, groups: groups.into(), ready: VecDeque::new(), patches: None, failures: Vec::new() })
    }

    /// The next base mesh, the best of those made; `None` where there are no more. Fails where the ways that are left lead to none.
    pub(crate) fn next(&mut self, run: &mut Run) -> Result<Option<BaseStages>, Error> {
        while self.ready.iter().all(|rated| rated.quality < POOR) {
            let Some(group) = self.groups.pop_front() else { break };
            self.go(&group, run);
        }
        if self.ready.is_empty() {
            return self.failure().map_or(Ok(None), Err);
        }
        let failures = std::mem::take(&mut self.failures);
        Ok(self.ready.pop_front().map(|rated| self.ground.stages(rated, self.patches.clone(), &failures)))
    }

    /// Goes some ways at once: none waits for the others before it has its rating.
    fn go(&mut self, ways: &[Way], run: &mut Run) {
        let ground = &self.ground;
        let made = match *ways {
            [first, second] => {
                let (first, second) = run.side_by_side(|run| ground.rated(first, run), |run| ground.rated(second, run));
                vec![first, second]
            }
            _ => ways.iter().map(|&way| ground.rated(way, run)).collect(),
        };
        for (&way, made) in ways.iter().zip(made) {
            match made {
                Ok(made) => self.ready.push_back(made),
                Err(error) => self.failures.push((way, error)),
            }
        }
        self.patches = self.ready.iter().find_map(|r| r.patches.clone()).or(self.patches.take());
        self.ready.make_contiguous().sort_by(|a, b| b.rating.total_cmp(&a.rating));
    }

    /// Why there is no base mesh: that it is too large or that the run has ended, else what went wrong first.
    fn failure(&mut self) -> Option<Error> {
        let is_last_word = |(_, e): &(Way, Error)| matches!(e, Error::TooLarge { .. } | Error::Cancelled);
        let which = self.failures.iter().position(is_last_word).unwrap_or(0);
        self.failures.drain(..).nth(which).map(|(_, error)| error)
    }
}

/// A smaller mesh in the place of a dense surface; `None` where the surface has not many more faces than a base mesh of so many vertices needs.
fn proxy_of(
    surface: &Surface,
    sizing: &Sizing,
    base_edge_length: f64,
    wanted: usize,
    run: &mut Run,
) -> Result<Option<Arc<Proxy>>, Error> {
    // A closed surface has about two faces for each vertex.
    let faces = 2 * wanted * PROXY_FACES;
    if surface.mesh().n_faces() < DENSE * faces {
        return Ok(None);
    }
    let options =
        ProxyOptions { faces, longest_edge: PROXY_EDGE * base_edge_length, distance: PROXY_DISTANCE * base_edge_length };
    let proxy = run.stage("proxy", || Proxy::new(surface, sizing, &options))?;
    Ok(Some(Arc::new(proxy)))
}

/// The surface with its creases and corners at the resolution of so many base vertices.
fn detected(input: &Input, options: &Options, setting: &Setting, wanted: usize, run: &mut Run) -> Result<Surface, Error> {
    let (mesh, topology) = (input.working.mesh(), input.working.topology());
    let base_edge_length = equilateral_edge_length(mesh.total_area(), wanted);
    let persistence = options.features.persistence * setting.persistence;
    let feature_options = features::FeatureOptions { persistence, ..options.features.clone() };
    let network =
        run.stage("features", || features::detect(mesh, topology, &input.marked, base_edge_length, &feature_options))?;
    Ok(input.working.with_network(network)?)
}

impl Ground<'_> {
    /// What the base mesh is made on.
    fn base_surface(&self) -> &Surface {
        self.proxy.as_ref().map_or(&self.surface, |proxy| &proxy.surface)
    }

    /// The base mesh of a way.
    fn rated(&self, way: Way, run: &mut Run) -> Result<Rated, Error> {
        if way == Way::Decimation {
            let base = decimation(self.base_surface(), &self.sizing, self.wanted, run)?;
            return self.searched(way, base, run);
        }
        let patches = patches(self.base_surface(), &self.sizing, self.wanted, self.options.seed, run)?;
        let rated = self.searched(way, patches.base.clone(), run)?;
        Ok(Rated { patches: Some(Arc::new(patches)), ..rated })
    }

    /// A base mesh with a map of its own, after the search for better connectivity, and its rating.
    fn searched(&self, way: Way, base: BaseMesh, run: &mut Run) -> Result<Rated, Error> {
        (self.admits)(base.mesh().n_vertices(), base.mesh().n_faces())?;
        let (base, mut faults) = run.stage("retrace", || Ok::<_, Error>(retraced(self.base_surface(), base)))?;
        let search = || searched(self.base_surface(), &self.sizing, base, self.input.asked, self.options);
        let Searched { rating, quality, base, faults: of_search } = run.stage("search", search)?;
        faults.extend(of_search);
        Ok(Rated { rating, quality, way, base, patches: None, faults })
    }

    /// What led to a base mesh, `patches` of the other way included, and which ways led to none.
    fn stages(&self, rated: Rated, patches: Option<Arc<Patches>>, failures: &[(Way, Error)]) -> BaseStages {
        let Rated { way, base, patches: own, faults, .. } = rated;
        let split = own.filter(|p| p.n_split > 0);
        let split = split.map(|p| format!("{} patches were too long or too winding to lay flat and were split", p.n_split));
        // Not a fault: this base mesh is small enough.
        let failed = failures.iter().filter(|(_, error)| !matches!(error, Error::TooLarge { .. }));
        let failed = failed.map(|(way, e)| format!("there is no base mesh by {}: {}", way.name(), e.with_request()));
        BaseStages {
            cleaned: self.input.cleaned.clone(),
            surface: self.surface.clone(),
            proxy: self.proxy.clone(),
            way,
            counts: self.counts(base.mesh().n_vertices(), patches.as_deref()),
            base: Arc::new(Base::Mapped(base)),
            warnings: split.into_iter().chain(faults).chain(failed).collect(),
            patches,
        }
    }

    /// So many vertices were made.
    fn counts(&self, made: usize, patches: Option<&Patches>) -> BaseCounts {
        let asked = self.input.asked;
        let least = self.surface.network().least_base(self.surface.topology()).vertices;
        let needed = match patches {
            Some(patches) => patches.needed.min(made),
            None if made > asked => made,
            None => least.min(made),
        };
        BaseCounts { asked, needed, made, reason: reason(asked, made, &self.surface, self.setting) }
    }
}

/// Why more base vertices were made than asked for; empty where they were not.
fn reason(asked: usize, made: usize, surface: &Surface, setting: &Setting) -> String {
    if made <= asked {
        return String::new();
    }
    if setting.base_vertices > 1.0 {
        return format!("asked {asked}, took {made}: with fewer the result did not pass the certificate");
    }
    let (corners, arcs) = (surface.network().corners.len(), surface.network().arcs.len());
    format!("asked {asked}, took {made}: {corners} corners and {arcs} arcs must be kept, and the shape between them")
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
