//! Which of several base meshes makes the best result.

use crate::{Error, Options};
use mesh_core::Topology;
use region_map::{BaseMesh, Surface};
use relax::Relaxed;

/// What each further e-fold of vertices beyond those asked takes off the rating.
const EXCESS_COST: f64 = 0.1;

/// Rates a base mesh: the mean quality (AR) that its first subdivision has once relaxed, with 0 for triangles that stay folded, less a
/// cost for vertices beyond those asked. That is a sixteenth of the triangles of level 3. Measured on 12 models: the better of both ways at
/// level 1 was the better one at level 3 on 8; on three the other one was better by .005 at most, on camelhead by .017, where folds
/// decided that level 1 does not show. Negative infinity for a base mesh that the stages refuse.
pub(crate) fn rate(surface: &Surface, base: &BaseMesh, asked: usize, options: &Options) -> f64 {
    let excess = (base.mesh.n_vertices() as f64 / asked.max(1) as f64).ln().max(0.0);
    relaxed_once(surface, base, options).map_or(f64::NEG_INFINITY, |r| r.report.end.ar_mean - EXCESS_COST * excess)
}

/// The first subdivision of a base mesh, relaxed.
pub(crate) fn relaxed_once(surface: &Surface, base: &BaseMesh, options: &Options) -> Result<Relaxed, Error> {
    let domain = subdiv::subdivide(&base.mesh, &base.region, 1)?;
    let origins = Some(project::Origins { base, points: &domain.origins });
    let projected = project::project(surface, &domain.mesh, &domain.region, origins, &options.project)?;
    let topology = Topology::new(projected.mesh.faces(), projected.mesh.n_vertices())?;
    Ok(relax::relax(surface, &projected.mesh, &topology, &projected.region, &options.relax)?)
}
