//! The other way to a base mesh: the working mesh itself, coarsened.

use crate::arguments::check_wishes;
use crate::improve::improved;
use crate::{BaseError, BaseOptions};
use glam::DVec2;
use mesh_core::{FaceId, Id as _};
use rand::{RngExt as _, SeedableRng as _};
use rand_pcg::Pcg64Mcg;
use region_map::{BaseMap, BaseMesh, Chart, ChartId, Domain, MapError, MapFaceId, Sizing, Surface};

/// So much of a wanted length a seed changes at most. More gives base meshes that differ more, and triangles that do.
const SHAKEN: f64 = 0.05;

/// The corners of a base face that is a working face, in its chart.
const CORNERS: [DVec2; 3] = [DVec2::ZERO, DVec2::X, DVec2::Y];

/// Coarsens the working mesh to a base mesh (after Lee et al., *MAPS*, 1998), by the edits that improve any other.
///
/// Fails where an option is out of its range, and where the sizing field is of another mesh.
pub fn decimate(surface: &Surface, sizing: &Sizing, options: &BaseOptions) -> Result<BaseMesh, BaseError> {
    check_wishes(surface, sizing, options)?;
    let first = identity(surface).map_err(|e| BaseError::Internal(e.to_string()))?;
    if options.seed == 0 {
        return improved(surface, first, sizing, options);
    }
    improved(surface, first, &shaken(sizing, options.seed), options)
}

/// The sizing field with every value changed at random by at most [`SHAKEN`] of it.
fn shaken(sizing: &Sizing, seed: u64) -> Sizing {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut factor = || 1.0 + SHAKEN * random.random_range(-1.0..1.0);
    Sizing { relative: sizing.relative.iter().map(|&length| length * factor()).collect() }
}

/// The working mesh as its own base mesh: a chart for every face.
pub(crate) fn identity(surface: &Surface) -> Result<BaseMesh, MapError> {
    let n = surface.mesh().n_faces();
    let charts = (0..n).map(|f| Chart::of_face(FaceId::new(f))).collect();
    let first: Vec<_> = (0..n).map(|f| (ChartId::new(f), CORNERS)).collect();
    let map = BaseMap::new(charts, &first)?;
    Ok(BaseMesh { domain: Domain::identity(surface), map, map_faces: (0..n).map(MapFaceId::new).collect() })
}
