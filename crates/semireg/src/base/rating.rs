//! Which of several base meshes makes the best result.

use crate::{Error, Options};
use mesh_core::{FaceId, SurfaceIndex, TriMesh, equilateral_edge_length};
use rayon::prelude::*;
use region_map::{BaseMesh, Surface};
use relax::Relaxed;

/// What each further e-fold of vertices beyond those asked takes off the rating.
const EXCESS_COST: f64 = 0.1;
/// What each further e-fold of the distance from the surface takes off it. Without it limbs and bosses are cut off for better triangles:
/// spot's mean error grew by a fifth at 100 base vertices.
const DISTANCE_COST: f64 = 0.1;
/// Distances below this share of a base edge are as good as none.
const NO_DISTANCE: f64 = 1e-3;
/// So many faces of the surface are asked for their distance, about.
const SAMPLES: usize = 20_000;

/// Rates a base mesh by its first subdivision, relaxed: the mean quality (AR) that has, with 0 for triangles that stay folded, less a
/// cost for its distance from the surface (root mean square, in base edges), less one for vertices beyond those asked. That is a sixteenth
/// of the triangles of level 3.
pub(super) fn rate(surface: &Surface, base: &BaseMesh, relaxed: &Relaxed, asked: usize) -> f64 {
    let excess = (base.mesh().n_vertices() as f64 / asked.max(1) as f64).ln().max(0.0);
    let edge_length = equilateral_edge_length(surface.mesh().total_area(), asked);
    let distance = (distance(surface.mesh(), &relaxed.domain.mesh) / edge_length).max(NO_DISTANCE);
    relaxed.report.end.ar_mean - DISTANCE_COST * distance.ln() - EXCESS_COST * excess
}

/// The first subdivision of a base mesh, relaxed.
pub(super) fn relaxed_once(surface: &Surface, base: &BaseMesh, options: &Options) -> Result<Relaxed, Error> {
    let subdivided = subdiv::subdivide(&base.domain, 1)?;
    let origins = Some(project::Origins { base, points: &subdivided.origins });
    let projected = project::project(surface, &subdivided.domain, origins, &options.project)?;
    Ok(relax::relax(surface, &projected.domain, &options.relax)?)
}

/// The root mean square of the distances from a surface to a mesh, at the middles of its faces.
fn distance(surface: &TriMesh, mesh: &TriMesh) -> f64 {
    let index = SurfaceIndex::new(mesh);
    let step = surface.n_faces().div_ceil(SAMPLES).max(1);
    let faces: Vec<FaceId> = surface.faces().ids().step_by(step).collect();
    let weighted = |f: FaceId| {
        let distance = index.closest(surface.centroid(f)).map_or(0.0, |closest| closest.distance);
        let area = surface.area(f);
        [area, area * distance * distance]
    };
    let pairs: Vec<[f64; 2]> = faces.into_par_iter().map(weighted).collect();
    let [area, sum] = pairs.into_iter().fold([0.0; 2], |[area, sum], [a, s]| [area + a, sum + s]);
    (sum / area.max(f64::MIN_POSITIVE)).sqrt()
}
