//! The levels of a base mesh, each placed on the surface and relaxed from the one before.

use crate::base::BaseStages;
use crate::input::Input;
use crate::rescue::NextStage;
use crate::run::Run;
use crate::{Error, Options};
use mesh_core::equilateral_edge_length;
use project::{Origins, Projected};
use region_map::Surface;
use relax::{QuadricOptions, RelaxOptions, Relaxed, ShapeOptions};

/// Newton steps on a level whose start was relaxed already, on the level before or on a proxy. More takes longer and hardly changes anything.
const STEPS_AGAIN: usize = 12;

/// The first level that is relaxed has so many faces at least, if the finest one has. Less takes less time, and loses limbs that a coarse level does
/// not show. Measured from level 1 on: camelhead's greatest error 8.9e-3 to 16.7e-3 (1,424 faces there).
const FIRST_FACES: usize = 4_000;

/// The finest level, projected and relaxed.
pub(super) struct Finest {
    pub(super) projected: Projected,
    pub(super) relaxed: Relaxed,
}

/// Options for a domain that has been relaxed before.
pub(super) fn again(options: &RelaxOptions) -> RelaxOptions {
    RelaxOptions {
        quadric: QuadricOptions { iterations: 0, ..options.quadric.clone() },
        shape: ShapeOptions { steps: STEPS_AGAIN, ..options.shape.clone() },
    }
}

/// Subdivides, projects and relaxes level by level: the first one by the map of the base mesh, each further one from the relaxed one before. Where
/// there is a proxy, all levels but the finest are relaxed on it.
///
/// Fails early where too much is folded.
pub(super) fn relaxed_levels(input: &Input, stages: &BaseStages, options: &Options, run: &mut Run) -> Result<Finest, Error> {
    let (base, mut proxy) = (&stages.base, stages.proxy.as_deref());
    let mut surface = stages.base_surface();
    let shows_the_shape = |level: &u32| base.mesh().n_faces() << (2 * level) >= FIRST_FACES;
    let first = (1..options.levels()).find(shows_the_shape).unwrap_or(options.levels());
    let first = run.stage("subdivide", || subdiv::subdivide(base.domain(), first))?;
    let origins = base.mapped().map(|base| Origins { base, points: &first.origins });
    let mut projected = run.stage("project", || project::project(surface, &first.domain, origins, &options.project))?;
    is_worth_relaxing(surface, &projected)?;
    let kept = proxy.map_or(&input.cleaned.mesh, |proxy| proxy.surface.mesh());
    let base_edge_length = equilateral_edge_length(input.cleaned.mesh.total_area(), base.mesh().n_vertices());
    // Parts get lost where vertices still move far. On further levels they start near their ends.
    let relax = || relax::relax_keeping(surface, &projected.domain, kept, base_edge_length, &options.relax);
    let mut relaxed = run.stage("relax", relax)?;
    let again = again(&options.relax);
    for level in first.level..options.levels() {
        if let Some(proxy) = proxy.take_if(|_| level + 1 == options.levels()) {
            relaxed.domain = run.stage("project", || proxy.carried(&relaxed.domain, &stages.surface))?;
            surface = &stages.surface;
        }
        let finer = run.stage("subdivide", || subdiv::subdivide(&relaxed.domain, 1))?;
        projected = run.stage("project", || project::project_refined(surface, &relaxed.domain, &finer.domain))?;
        is_worth_relaxing(surface, &projected)?;
        relaxed = run.stage("relax", || relax::relax(surface, &projected.domain, &again))?.after(relaxed.report);
    }
    if let Some(proxy) = proxy {
        let there = run.stage("project", || proxy.carried(&relaxed.domain, &stages.surface))?;
        relaxed = run.stage("relax", || relax::relax(&stages.surface, &there, &again))?.after(relaxed.report);
    }
    Ok(Finest { projected, relaxed })
}

fn is_worth_relaxing(surface: &Surface, projected: &Projected) -> Result<(), Error> {
    let n_triangles = projected.domain.mesh.n_faces();
    NextStage::Relax.is_worth(relax::inverted(surface, &projected.domain)?.len(), n_triangles)
}
