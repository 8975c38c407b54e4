//! What a try came to: one total order, from the worst to the best.

use certify::Shortcoming;
use std::cmp::Ordering;
use std::fmt;

/// See [`Verdict::is_far_better_than`]. More gives up sooner. Measured: twice the base vertices took a fifth of what a loft misses in edges that fade
/// out, and four times took as much time again for nothing.
const LEAST_GAIN: f64 = 0.25;

/// What a try came to. Verdicts are ordered: the better one is the greater.
#[derive(Clone, Debug)]
pub enum Verdict {
    /// There is no mesh to judge.
    Failed {
        /// Why.
        reason: String,
    },
    /// A mesh with triangles that the certificate refuses: they face against the input, or have no area.
    Faulty {
        /// How many.
        faults: usize,
        /// Of how many.
        triangles: usize,
    },
    /// Certified, but a part of the input is lost.
    Lost {
        /// How far the mesh misses the input somewhere, in edge lengths of the base mesh that was asked for.
        base_edges: f64,
    },
    /// Certified, and all parts of the input are there, but a person would not take it without a second look.
    Short {
        /// Why; never empty.
        shortcomings: Vec<Shortcoming>,
    },
    /// Certified, and as a person would have it.
    Certified,
}

impl Verdict {
    /// Of a certified mesh that has all parts of the input and falls short in these.
    pub fn of(shortcomings: Vec<Shortcoming>) -> Self {
        if shortcomings.is_empty() { Self::Certified } else { Self::Short { shortcomings } }
    }

    /// Whether there is a certified mesh.
    pub fn is_certified(&self) -> bool {
        matches!(self, Self::Certified | Self::Short { .. } | Self::Lost { .. })
    }

    /// Whether it is better than another one by enough that going on in the same way may lead to a right one: of what that one falls short in, more
    /// than a share of [`LEAST_GAIN`] is gone.
    pub(crate) fn is_far_better_than(&self, other: &Self) -> bool {
        let ((kind, badness), (other_kind, other_badness)) = (self.rank(), other.rank());
        kind > other_kind || (kind == other_kind && badness < (1.0 - LEAST_GAIN) * other_badness)
    }

    /// The kind, and within the kind how bad.
    fn rank(&self) -> (u8, f64) {
        match self {
            Self::Failed { .. } => (0, 0.0),
            Self::Faulty { faults, triangles } => (1, *faults as f64 / (*triangles).max(1) as f64),
            Self::Lost { base_edges } => (2, *base_edges),
            Self::Short { shortcomings } => (3, shortcomings.iter().map(Shortcoming::severity).sum()),
            Self::Certified => (4, 0.0),
        }
    }
}

impl Ord for Verdict {
    fn cmp(&self, other: &Self) -> Ordering {
        let ((kind, badness), (other_kind, other_badness)) = (self.rank(), other.rank());
        kind.cmp(&other_kind).then(other_badness.total_cmp(&badness))
    }
}

impl PartialOrd for Verdict {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Verdict {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Verdict {}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Failed { reason } => write!(f, "failed: {reason}"),
            Self::Faulty { faults, triangles } => write!(f, "{faults} of {triangles} triangles are folded or have no area"),
            Self::Lost { base_edges } => write!(f, "certified, but it misses the input by {base_edges:.2} base edges somewhere"),
            Self::Short { shortcomings } => {
                let words: Vec<String> = shortcomings.iter().map(ToString::to_string).collect();
                write!(f, "certified, but {}", words.join("; "))
            }
            Self::Certified => write!(f, "certified"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use certify::SharpCover;

    fn sharp_edges(share: f64) -> Shortcoming {
        Shortcoming::SharpEdges(SharpCover { share, length: 4.0 })
    }

    #[test]
    fn fewer_faults_and_smaller_losses_are_never_worse() {
        let order = [
            Verdict::Failed { reason: "no base mesh".into() },
            Verdict::Faulty { faults: 300, triangles: 100_000 },
            Verdict::Faulty { faults: 1, triangles: 100_000 },
            Verdict::Lost { base_edges: 0.5 },
            Verdict::Lost { base_edges: 0.3 },
            Verdict::Short { shortcomings: vec![sharp_edges(0.5)] },
            Verdict::Short { shortcomings: vec![sharp_edges(0.9), Shortcoming::MeanShape(0.79)] },
            Verdict::Certified,
        ];
        for (i, worse) in order.iter().enumerate() {
            for (j, other) in order.iter().enumerate() {
                assert_eq!(worse.cmp(other), i.cmp(&j), "{worse} and {other}");
            }
        }
        assert_eq!(order.iter().filter(|v| v.is_certified()).count(), 5);
    }

    #[test]
    fn far_better_is_a_better_kind_or_much_less_of_the_same() {
        let sharp = |share| Verdict::Short { shortcomings: vec![sharp_edges(share)] };
        for (now, before, expected) in [
            (Verdict::Certified, sharp(0.97), true),
            (sharp(0.9), Verdict::Lost { base_edges: 0.3 }, true),
            (sharp(0.97), sharp(0.9), true),
            (sharp(0.91), sharp(0.9), false),
            (sharp(0.9), sharp(0.9), false),
            (Verdict::Lost { base_edges: 0.3 }, sharp(0.9), false),
        ] {
            assert_eq!(now.is_far_better_than(&before), expected, "{now} and {before}");
        }
    }
}
