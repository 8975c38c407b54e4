//! What a search found.

use region_map::BaseEdit;

/// Better connectivity for a base mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reconnected {
    /// The edits, in their order.
    pub edits: Vec<BaseEdit>,
    /// By how much the energy of the first subdivision exceeds that of equilateral triangles at the start.
    pub energy_at_start: f64,
    /// The same after all edits.
    pub energy_at_end: f64,
    /// Edits that were tried, those included of which it was known that they do not gain.
    pub tries: usize,
}
