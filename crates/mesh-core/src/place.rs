//! The place of a position, as a key: positions that are exactly the same have the same one.

use glam::DVec3;

/// The bits of a position, with -0 as 0. Its order has no meaning but is the same on every run.
pub type Place = [u64; 3];

/// The place of a position.
///
/// ```
/// use glam::DVec3;
/// assert_eq!(mesh_core::place(DVec3::new(0.0, 1.0, 2.0)), mesh_core::place(DVec3::new(-0.0, 1.0, 2.0)));
/// ```
pub fn place(position: DVec3) -> Place {
    (position + DVec3::ZERO).to_array().map(f64::to_bits)
}
