//! The sizing field: how long base edges may be at a place, relative to the edge length of the budget.

use crate::kd_tree::KdTree;
use glam::DVec3;

/// Edge lengths relative to the budget's, at most 1, growing with the distance from the places that ask for short edges.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SizingField {
    /// Positions with the relative edge length that they ask for.
    places: Vec<(DVec3, f64)>,
    tree: KdTree,
    /// The least that a place asks for.
    least: f64,
    /// Growth of the relative edge length per unit of length.
    slope: f64,
}

/// No place may ask for shorter edges than this: their number grows with the inverse square.
const SHORTEST: f64 = 0.01;

impl SizingField {
    /// The same edge length everywhere.
    pub fn uniform() -> Self {
        Self::default()
    }

    /// A field from places that ask for relative edge lengths (0.01 to 1; shorter ones are raised to that); away from them it grows
    /// by `slope` (not negative) per unit of length.
    pub fn new(places: Vec<(DVec3, f64)>, slope: f64) -> Self {
        let asking = places.into_iter().filter(|p| p.0.is_finite() && p.1 < 1.0);
        let places: Vec<_> = asking.map(|(p, h)| (p, h.max(SHORTEST))).collect();
        let tree = KdTree::new(places.iter().map(|p| p.0));
        let least = places.iter().fold(1.0, |least, p| f64::min(least, p.1));
        Self { places, tree, least, slope: slope.max(0.0) }
    }

    /// True where no place asks for less than the budget's edge length.
    pub(crate) fn is_uniform(&self) -> bool {
        self.places.is_empty()
    }

    /// Relative edge length at a position, 0.01 to 1.
    pub fn relative(&self, at: DVec3) -> f64 {
        let mut relative = 1.0;
        // Beyond this distance no place can ask for less.
        let reach = |relative: f64| ((relative - self.least) / self.slope).powi(2);
        self.tree.search(at, reach(relative), |i| {
            let (place, h) = self.places[i];
            relative = f64::min(relative, h + self.slope * place.distance(at));
            reach(relative)
        });
        relative
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    #[test]
    fn the_shortest_wish_in_reach_wins() {
        let mut random = Pcg64Mcg::seed_from_u64(1);
        let mut point = || DVec3::new(random.random(), 3.0 * random.random::<f64>(), random.random());
        let places: Vec<_> = (0..200).map(|i| (point(), 0.1 + 0.004 * f64::from(i))).collect();
        for slope in [0.0, 0.3, 5.0, 100.0] {
            let field = SizingField::new(places.clone(), slope);
            for at in (0..200).map(|_| point()) {
                let expected = places.iter().map(|(p, h)| h + slope * p.distance(at)).fold(1.0, f64::min);
                assert!((field.relative(at) - expected).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn wishes_out_of_range_are_brought_into_it() {
        let field = SizingField::new(vec![(DVec3::ZERO, 0.0), (DVec3::X, 7.0), (DVec3::NAN, 0.5), (DVec3::Y, f64::NAN)], -1.0);
        assert_eq!(field.relative(DVec3::ZERO), SHORTEST);
        assert_eq!(SizingField::uniform().relative(DVec3::ZERO), 1.0);
    }
}
