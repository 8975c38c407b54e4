//! The sizing field: how long base edges may be at a place, relative to the edge length of the budget.

use glam::DVec3;

/// Edge lengths relative to the budget's, at most 1, growing with the distance from the places that ask for short edges.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SizingField {
    /// Positions with the relative edge length that they ask for.
    places: Vec<(DVec3, f64)>,
    /// Growth of the relative edge length per unit of length.
    slope: f64,
}

impl SizingField {
    /// The same edge length everywhere.
    pub fn uniform() -> Self {
        Self::default()
    }

    /// A field from places that ask for relative edge lengths (0 to 1); away from them it grows by `slope` per unit of length.
    pub fn new(places: Vec<(DVec3, f64)>, slope: f64) -> Self {
        Self { places: places.into_iter().filter(|p| p.1 < 1.0).collect(), slope }
    }

    /// Relative edge length at a position, above 0 and at most 1.
    pub fn relative(&self, at: DVec3) -> f64 {
        self.places.iter().fold(1.0, |least, (p, h)| f64::min(least, h + self.slope * p.distance(at)))
    }
}
