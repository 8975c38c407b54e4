//! Positions in single precision, for the formats that hold no more.

use crate::error::WriteError;
use glam::DVec3;
use mesh_core::TriMesh;

/// The positions of a mesh rounded to f32. Fails on the first coordinate that is too large for it.
pub(crate) fn single_precision(mesh: &TriMesh) -> Result<Vec<[f32; 3]>, WriteError> {
    let rounded = |(vertex, p): (usize, &DVec3)| {
        let p = p.as_vec3();
        if p.is_finite() { Ok(p.to_array()) } else { Err(WriteError::NotSinglePrecision { vertex }) }
    };
    mesh.positions().iter().enumerate().map(rounded).collect()
}
