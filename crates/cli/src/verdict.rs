//! What figures are worth, in one word.

use certify::{ACCEPTED_LEAST_SHAPE, ACCEPTED_MEAN_SHAPE, SharpCover, accepted_distance};
use std::fmt::{self, Display, Formatter};

/// What a person would say of a result that has such a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Verdict {
    /// It cannot be used without a look at the place.
    Poor,
    /// Worth a look.
    Fair,
    /// Taken without a second look.
    Good,
}

impl Display for Verdict {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Poor => "poor",
            Self::Fair => "fair",
            Self::Good => "good",
        })
    }
}

impl Verdict {
    fn by(is_good: bool, is_fair: bool) -> Self {
        match (is_good, is_fair) {
            (true, _) => Self::Good,
            (false, true) => Self::Fair,
            (false, false) => Self::Poor,
        }
    }

    /// Of the shape of triangles, by the mean quality and that of the worst hundredth (1 = equilateral).
    pub(crate) fn of_shape(mean: f64, worst_hundredth: f64) -> Self {
        Self::by(mean >= ACCEPTED_MEAN_SHAPE && worst_hundredth >= ACCEPTED_LEAST_SHAPE, mean >= 0.6 && worst_hundredth >= 0.1)
    }

    /// Of the greatest distance between two surfaces, both in diagonals; `edge` is the mean length of an edge, which no mesh of flat
    /// triangles can be much better than where the surface bends.
    pub(crate) fn of_distance(greatest: f64, edge: f64) -> Self {
        let good = accepted_distance(1.0, edge);
        Self::by(greatest <= good, greatest <= 4.0 * good)
    }

    /// Of what is kept of sharp edges.
    pub(crate) fn of_sharp_edges(kept: SharpCover) -> Self {
        Self::by(kept.is_enough(), kept.share >= 0.9 || kept.are_few())
    }

    /// Of triangles that cut others, and those of them that do where the original does not.
    pub(crate) fn of_cuts(all: usize, new: usize) -> Self {
        Self::by(all == 0, new == 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn better_figures_have_no_worse_verdict() {
        let rising = (0..=100).map(|i| f64::from(i) / 100.0);
        assert!(rising.clone().map(|x| Verdict::of_shape(x, x)).is_sorted());
        assert!(rising.clone().map(|share| Verdict::of_sharp_edges(SharpCover { share, length: 5.0 })).is_sorted());
        assert!(rising.map(|x| Verdict::of_distance(1.0 - x, 0.01)).is_sorted());
        assert_eq!(
            [[0, 0], [9, 0], [9, 3]].map(|[all, new]| Verdict::of_cuts(all, new)),
            [Verdict::Good, Verdict::Fair, Verdict::Poor]
        );
        assert_eq!(Verdict::of_shape(0.95, 0.05), Verdict::Poor);
    }
}
