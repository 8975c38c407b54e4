//! The other way to a base mesh: the working mesh, decimated.

use crate::Error;
use crate::run::Run;
use basemesh::BaseOptions;
use region_map::{BaseMesh, Sizing, Surface};

/// Decimates the working mesh to about `wanted` vertices.
pub(super) fn decimation(surface: &Surface, sizing: &Sizing, wanted: usize, seed: u64, run: &mut Run) -> Result<BaseMesh, Error> {
    let options = BaseOptions { base_vertices: wanted, seed, ..Default::default() };
    run.stage("decimate", || basemesh::decimate(surface, sizing, &options))
}
