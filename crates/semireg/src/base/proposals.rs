//! The base meshes that one setting proposes, the best first.

use super::decimation::decimation;
use super::given::given;
use super::patches::{Patches, patches};
use super::search::{Searched, retraced, searched};
use super::setting::Setting;
use super::stages::{Base, BaseCounts, BaseStages};
use super::way::Way;
use crate::input::Input;
use crate::run::Run;
use crate::{Error, Options};
use mesh_core::equilateral_edge_length;
use region_map::{BaseMesh, Sizing, Surface};
use sizing::SizingOptions;
use std::sync::Arc;

/// Refuses a base mesh of so many vertices and faces where its finest level would be too large.
pub(crate) type Admits<'a> = dyn Fn(usize, usize) -> Result<(), Error> + Sync + 'a;

/// Makes the base meshes of a setting, both ways, or the one that the options give. They come in the order of their rating, the best first.
///
/// `needed` base vertices are what corners and arcs took in an earlier attempt, 0 in the first. What is not
/// admitted is refused, as early as can be.
pub(crate) fn proposals(
    input: &Input,
    options: &Options,
    setting: &Setting,
    needed: usize,
    admits: &Admits<'_>,
    run: &mut Run,
) -> Result<Vec<BaseStages>, Error> {
    if let Some(base) = &input.given {
        let stages = given(input, base, options, run)?;
        admits(stages.base.mesh().n_vertices(), stages.base.mesh().n_faces())?;
        return Ok(vec![stages]);
    }
    let at_least = if setting.as_needed { needed.max(input.asked) } else { input.asked };
    let wanted = (at_least as f64 * setting.base_vertices).round() as usize;
    let surface = detected(input, options, setting, wanted, run)?;
    let least = surface.network().least_base(surface.topology());
    admits(least.vertices, least.triangles)?;
    let base_edge_length = equilateral_edge_length(surface.mesh().total_area(), wanted);
    let sizing_options = SizingOptions { turn: setting.turn, ..SizingOptions::new(base_edge_length) };
    let sizing = run.stage("sizing", || sizing::sizing(&surface, &sizing_options))?;
    let ways = Ways { input, options, surface: &surface, sizing: &sizing, wanted, admits };
    let Made { patches, rated, faults } = ways.both(run)?;
    let proposal = |rated: Rated| {
        let made = rated.base.mesh().n_vertices();
        let needed = patches.as_ref().map_or(made, |p| p.needed.min(made));
        let split = patches.iter().filter(|p| rated.way == Way::Patches && p.n_split > 0);
        let split = split.map(|p| format!("{} patches were too long or too winding to lay flat and were split", p.n_split));
        BaseStages {
            cleaned: input.cleaned.clone(),
            surface: surface.clone(),
            patches: patches.clone(),
            way: rated.way,
            counts: BaseCounts { asked: input.asked, needed, made, reason: reason(input.asked, made, &surface, setting) },
            base: Arc::new(Base::Mapped(rated.base)),
            warnings: split.chain(rated.faults).chain(faults.clone()).collect(),
        }
    };
    Ok(rated.into_iter().map(proposal).collect())
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

/// Both ways to a base mesh on one surface.
struct Ways<'a> {
    input: &'a Input,
    options: &'a Options,
    surface: &'a Surface,
    sizing: &'a Sizing,
    wanted: usize,
    admits: &'a Admits<'a>,
}

/// The base meshes of both ways, the best first.
struct Made {
    patches: Option<Arc<Patches>>,
    rated: Vec<Rated>,
    /// Why there is only one, where that is a fault of ours.
    faults: Vec<String>,
}

/// A base mesh, and what it promises.
struct Rated {
    rating: f64,
    way: Way,
    base: BaseMesh,
    /// What went wrong on the way to it.
    faults: Vec<String>,
}

impl Ways<'_> {
    /// Goes both ways at once: neither waits for the other before it has its rating. Fails where both do.
    fn both(&self, run: &mut Run) -> Result<Made, Error> {
        let (by_patches, decimated) = run.side_by_side(
            |run: &mut Run| {
                let patches = patches(self.surface, self.sizing, self.wanted, self.options.seed, run)?;
                let rated = self.rated(Way::Patches, patches.base.clone(), run)?;
                Ok::<_, Error>((Arc::new(patches), rated))
            },
            |run: &mut Run| {
                let base = decimation(self.surface, self.sizing, self.wanted, run)?;
                self.rated(Way::Decimation, base, run)
            },
        );
        let failed = |way: Way, error: &Error| match error {
            // Not a fault: the other way's base mesh is small enough.
            Error::TooLarge { .. } => None,
            _ => Some(format!("there is no base mesh by {}: {}", way.name(), error.with_request())),
        };
        let (patches, mut rated, faults) = match (by_patches, decimated) {
            (Ok((patches, rated)), Ok(decimated)) => (Some(patches), vec![decimated, rated], None),
            (Ok((patches, rated)), Err(e)) => (Some(patches), vec![rated], failed(Way::Decimation, &e)),
            (Err(e), Ok(decimated)) => (None, vec![decimated], failed(Way::Patches, &e)),
            (Err(_), Err(e @ (Error::TooLarge { .. } | Error::Cancelled))) | (Err(e), Err(_)) => return Err(e),
        };
        rated.sort_by(|a, b| b.rating.total_cmp(&a.rating));
        Ok(Made { patches, rated, faults: faults.into_iter().collect() })
    }

    /// A base mesh with a map of its own, after the search for better connectivity, and its rating.
    fn rated(&self, way: Way, base: BaseMesh, run: &mut Run) -> Result<Rated, Error> {
        (self.admits)(base.mesh().n_vertices(), base.mesh().n_faces())?;
        let (base, mut faults) = run.stage("retrace", || Ok::<_, Error>(retraced(self.surface, base)))?;
        let search = || searched(self.surface, self.sizing, base, self.input.asked, self.options);
        let Searched { rating, base, faults: of_search } = run.stage("search", search)?;
        faults.extend(of_search);
        Ok(Rated { rating, way, base, faults })
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
    fn rated(mesh: &TriMesh, base_vertices: usize) -> Vec<(Way, f64)> {
        let options = Options { base_vertices: Some(base_vertices), ..Options::default() };
        let run = &mut Run::new(Watch::default());
        let input = Input::new(&mesh.to_soup(), &options, run).unwrap();
        let proposed = proposals(&input, &options, &PLAN[0].1, 0, &|_, _| Ok(()), run).unwrap();
        let rated = |stages: &BaseStages| {
            let base = stages.base.mapped().unwrap();
            let relaxed = relaxed_once(&stages.surface, base, &options).unwrap();
            (stages.way, rate(&stages.surface, base, &relaxed, input.asked))
        };
        proposed.iter().map(rated).collect()
    }

    #[test]
    fn both_ways_are_proposed_and_the_better_one_is_tried_first() {
        let shapes = [fixtures::torus(1.0, 0.4, 32, 16), fixtures::cube(4), fixtures::l_block(4), fixtures::blob(8)];
        let orders: Vec<Vec<(Way, f64)>> = shapes.iter().map(|shape| rated(shape, 60)).collect();
        for order in &orders {
            assert!(matches!(order[..], [(first, better), (second, worse)] if first != second && better >= worse), "{order:?}");
        }
        // Each way wins on one of them; else the order could be fixed and this test would not tell.
        assert!([Way::Patches, Way::Decimation].iter().all(|way| orders.iter().any(|order| order[0].0 == *way)), "{orders:?}");
    }
}
