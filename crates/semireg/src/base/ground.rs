//! [`Ground`]: what the base meshes of a setting are made on, and how one is made.

use super::decimation::decimation;
use super::patches::{Patches, Style, patches};
use super::search::{Rated, retraced, searched};
use super::setting::Setting;
use super::stages::{Base, BaseCounts, BaseStages};
use super::way::Way;
use crate::input::Input;
use crate::run::Run;
use crate::{Error, Options};
use mesh_core::equilateral_edge_length;
use proxy::{Proxy, ProxyOptions};
use region_map::{Sizing, Surface};
use sizing::SizingOptions;
use std::sync::Arc;

/// Refuses a base mesh of so many vertices and faces where its finest level would be too large.
pub(crate) type Admits<'a> = dyn Fn(usize, usize) -> Result<(), Error> + Sync + 'a;

/// A proxy has so many faces for each base face that is wanted. More sees finer shapes, and takes as much longer.
const PROXY_FACES: usize = 25;
/// A surface with this many times the faces that its proxy would have gets one. Less saves time on more inputs, and changes their results.
const DENSE: usize = 2;
/// Edges of a proxy are at most this share of a base edge, as those of the working mesh are kept short.
const PROXY_EDGE: f64 = 0.35;
/// A proxy keeps nearer to the surface than this share of a base edge, even if it then has more faces.
const PROXY_DISTANCE: f64 = 0.01;

/// What the base meshes of a setting are made on.
pub(super) struct Ground<'a> {
    input: &'a Input,
    options: &'a Options,
    setting: &'a Setting,
    pub(super) surface: Surface,
    /// What stands for the surface, where that is dense.
    proxy: Option<Arc<Proxy>>,
    /// How long base edges shall be, at the vertices of what the base mesh is made on.
    sizing: Sizing,
    pub(super) wanted: usize,
    admits: &'a Admits<'a>,
}

/// A base mesh that was made on a ground.
pub(super) struct Made {
    pub(super) rated: Rated,
    /// Whether better connectivity was searched for.
    is_searched: bool,
    way: Way,
    /// What the paper's way made, on that way.
    pub(super) patches: Option<Arc<Patches>>,
    /// What went wrong on the way to it.
    faults: Vec<String>,
}

impl<'a> Ground<'a> {
    /// Finds creases and sizes, and makes a proxy where the surface is dense.
    pub(super) fn new(
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
        let (turn, gradation) = (setting.turn, options.gradation);
        let sizing_options = SizingOptions { turn, gradation, ..SizingOptions::new(base_edge_length) };
        let factors = input.length_factors.as_ref();
        let sizing = run.stage("sizing", || sizing::sizing_with(&surface, factors, &sizing_options))?;
        let proxy = proxy_of(&surface, &sizing, base_edge_length, wanted, run)?;
        let sizing = proxy.as_ref().map_or(Ok(sizing.clone()), |proxy| proxy.sizing(&sizing))?;
        Ok(Self { input, options, setting, surface, proxy, sizing, wanted, admits })
    }

    /// What the base mesh is made on.
    fn base_surface(&self) -> &Surface {
        self.proxy.as_ref().map_or(&self.surface, |proxy| &proxy.surface)
    }

    /// The base mesh of a way, with a map of its own.
    pub(super) fn made(&self, way: Way, run: &mut Run) -> Result<Made, Error> {
        let (surface, seed) = (self.base_surface(), self.options.seed);
        let (base, patches) = if way == Way::Decimation {
            (decimation(surface, &self.sizing, self.wanted, seed, run)?, None)
        } else {
            let patches = patches(surface, &self.sizing, self.wanted, &Style::improved(), seed, run)?;
            (patches.base.clone(), Some(Arc::new(patches)))
        };
        (self.admits)(base.mesh().n_vertices(), base.mesh().n_faces())?;
        let (base, faults) = run.stage("retrace", || Ok::<_, Error>(retraced(surface, base)))?;
        let rated = run.stage("search", || Rated::new(surface, base, self.input.asked, self.options))?;
        Ok(Made { rated, is_searched: false, way, patches, faults })
    }

    /// A base mesh after the search for better connectivity. Once is enough.
    pub(super) fn searched(&self, made: Made, run: &mut Run) -> Result<Made, Error> {
        if made.is_searched {
            return Ok(made);
        }
        let Made { rated, mut faults, .. } = made;
        let search = || Ok::<_, Error>(searched(self.base_surface(), &self.sizing, rated, self.input.asked, self.options));
        let (rated, of_search) = run.stage("search", search)?;
        faults.extend(of_search);
        Ok(Made { rated, faults, is_searched: true, ..made })
    }

    /// What led to a base mesh, `patches` of the other way included, and which ways led to none.
    pub(super) fn stages(&self, made: Made, patches: Option<Arc<Patches>>, failures: &[(Way, Error)]) -> BaseStages {
        let Made { rated, way, patches: own, faults, .. } = made;
        let base = rated.base;
        let split = own.and_then(|p| p.split_warning());
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
        return "with fewer the result was not right".to_owned();
    }
    let (corners, arcs) = (surface.network().corners.len(), surface.network().arcs.len());
    if arcs == 0 {
        return "the shape takes them".to_owned();
    }
    format!("{corners} corners and {arcs} arcs must be kept, and the shape between them")
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
    let feature_options = features::FeatureOptions { persistence, ..options.feature_options(base_edge_length) };
    let network =
        run.stage("features", || features::detect(mesh, topology, &input.marked, base_edge_length, &feature_options))?;
    Ok(input.working.with_network(network)?)
}
