//! From a mesh to its displacements.

use crate::level::Level;
use crate::{Coefficients, Displacement, DisplacementError, LevelDisplacement, Residual};
use correspondence::Levels;
use mesh_core::TriMesh;
use std::ops::RangeInclusive;

/// The bits that numbers can be quantised to.
const BITS: RangeInclusive<u8> = 2..=24;

/// How the numbers of a displacement are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EncodeOptions {
    /// Bits for each number, from 2 to 24: it becomes one of `2^bits - 1` multiples of a step, which is chosen for the scalars and for the
    /// residuals of each level by their greatest magnitude. `None`, the default, keeps numbers as they are.
    pub bits: Option<u8>,
}

/// The displacement of a mesh whose faces are `levels` subdivisions of a base mesh, in the order of [`Levels`].
///
/// Each level is predicted from the level before as decoding will give it, with the residual. So errors of rounding and of quantisation don't
/// add up over the levels.
///
/// Fails where the mesh has not these levels, where a level is no oriented manifold or has its new vertices in another order than that of
/// edges, where numbers are not finite, and for bits out of range.
pub fn encode(mesh: &TriMesh, levels: u32, options: &EncodeOptions) -> Result<Displacement, DisplacementError> {
    if let Some(bits) = options.bits.filter(|bits| !BITS.contains(bits)) {
        return Err(DisplacementError::Bits(bits));
    }
    let meshes = Levels::new(mesh, levels)?;
    let base = meshes.mesh(0)?;
    let mut displacement = Displacement { base: base.clone(), levels: Vec::new() };
    let mut decoded = base;
    for level in 1..=levels {
        let coarse = Level::new(level - 1, decoded)?;
        let target = meshes.mesh(level)?;
        if coarse.n_finer_vertices() != target.n_vertices() {
            return Err(DisplacementError::OtherNumbering { level });
        }
        let of_level = level_displacement(&coarse, &target, options.bits);
        decoded = coarse.displaced(&of_level, Residual::Kept)?;
        if decoded.faces() != target.faces() {
            return Err(DisplacementError::OtherNumbering { level });
        }
        displacement.levels.push(of_level);
    }
    Ok(displacement)
}

/// What brings the new vertices of a level to where they are in the target.
fn level_displacement(coarse: &Level, target: &TriMesh, bits: Option<u8>) -> LevelDisplacement {
    let new = &target.positions().as_slice()[coarse.mesh().n_vertices()..];
    let coordinates = coarse.predictions().zip(new).map(|(at, &p)| at.frame.coordinates(p - at.middle));
    let (scalar, residual): (Vec<f64>, Vec<[f64; 2]>) = coordinates.unzip();
    LevelDisplacement { scalar: Coefficients::new(scalar, bits), residual: Coefficients::new(residual.into_flattened(), bits) }
}
