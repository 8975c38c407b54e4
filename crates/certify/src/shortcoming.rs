//! What a person would not accept of a certified mesh without a second look.
//!
//! A certificate says that a mesh is sound: no fold, no hole, the topology of the input. It may still be too coarse for the shape. The bounds
//! here were set by looking at pictures of results beside those of their inputs.

use crate::measures::Measures;
use crate::sharp::{ACCEPTED_SHARP_COVER, SharpCover};
use std::fmt::{self, Display, Formatter};

/// Mean shape (AR) of triangles that look regular.
pub const ACCEPTED_MEAN_SHAPE: f64 = 0.8;
/// Shape (AR) that all triangles but the worst hundredth have there.
pub const ACCEPTED_LEAST_SHAPE: f64 = 0.3;
/// A distance of this share of the diagonal is hardly seen anywhere.
const ACCEPTED_DISTANCE: f64 = 2.5e-3;
/// And so is this share of a mean edge: edges of that length don't follow what is smaller.
const ACCEPTED_SHARE_OF_EDGE: f64 = 0.25;

/// The greatest distance between two surfaces that is accepted where edges have this mean length; both in the same unit, of which `diagonal` is
/// the input's.
pub fn accepted_distance(diagonal: f64, mean_edge: f64) -> f64 {
    (ACCEPTED_DISTANCE * diagonal).max(ACCEPTED_SHARE_OF_EDGE * mean_edge)
}

/// In what a certified mesh falls short of what a person accepts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shortcoming {
    /// It is too far from the original somewhere.
    Distance {
        /// The greatest distance.
        greatest: f64,
        /// The greatest that is accepted; both in parts of the original's diagonal.
        accepted: f64,
    },
    /// Sharp edges of the original are missing: so much is kept.
    SharpEdges(SharpCover),
    /// Triangles are far from equilateral in the mean: their quality (AR).
    MeanShape(f64),
    /// One in a hundred triangles has a lower quality (AR).
    LeastShape(f64),
    /// So many triangles cut others away from where the original cuts itself.
    Cuts(usize),
}

impl Shortcoming {
    /// All that a mesh falls short in, of which this distance is accepted, in parts of the original's diagonal; see [`accepted_distance`].
    pub fn all(measures: &Measures, sharp: Option<SharpCover>, accepted: f64) -> Vec<Self> {
        let greatest = measures.distance.worse().max;
        let quality = &measures.quality;
        let cuts = measures.new_self_intersecting;
        let found = [
            (greatest > accepted).then_some(Self::Distance { greatest, accepted }),
            sharp.filter(|kept| !kept.is_enough()).map(Self::SharpEdges),
            (quality.ar_mean < ACCEPTED_MEAN_SHAPE).then_some(Self::MeanShape(quality.ar_mean)),
            (quality.ar_p01 < ACCEPTED_LEAST_SHAPE).then_some(Self::LeastShape(quality.ar_p01)),
            (cuts > 0).then_some(Self::Cuts(cuts)),
        ];
        found.into_iter().flatten().collect()
    }

    /// How bad it is, above 0: about 1 where it is seen at the second look.
    pub fn severity(&self) -> f64 {
        match *self {
            Self::Distance { greatest, accepted } => greatest / accepted - 1.0,
            Self::SharpEdges(kept) => (ACCEPTED_SHARP_COVER - kept.share) / 0.1,
            Self::MeanShape(mean) => (ACCEPTED_MEAN_SHAPE - mean) / 0.2,
            Self::LeastShape(least) => (ACCEPTED_LEAST_SHAPE - least) / 0.2,
            Self::Cuts(cuts) => (cuts as f64).ln_1p(),
        }
    }
}

impl Display for Shortcoming {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Distance { greatest, .. } => write!(f, "it is {:.2} % of the diagonal away somewhere", 100.0 * greatest),
            Self::SharpEdges(kept) if kept.are_few() => {
                write!(f, "sharp edges are missing, {:.1} % of the diagonal long in all", 100.0 * kept.missing())
            }
            Self::SharpEdges(kept) => write!(f, "{:.1} % of the sharp edges are missing", 100.0 * (1.0 - kept.share)),
            Self::MeanShape(mean) => write!(f, "its triangles have a mean quality of {mean:.2}"),
            Self::LeastShape(least) => write!(f, "one triangle in a hundred has a quality below {least:.2}"),
            Self::Cuts(cuts) => write!(f, "{cuts} triangles cut others where the original does not"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_shapes::{moved, sphere};
    use crate::{MeasureOptions, Reference, measure};

    /// A sphere falls short of itself in nothing; one that is pulled out at a vertex in its distance, more so the farther.
    #[test]
    fn what_is_pulled_out_falls_short() {
        let mesh = sphere(3);
        let original = Reference::new(mesh.clone()).unwrap();
        let short = |pull: f64| {
            let pulled = moved(&mesh, |p| if p.z > 0.999 { (1.0 + pull) * p } else { p });
            let measures = measure(&original, &pulled, &MeasureOptions::default()).unwrap();
            Shortcoming::all(&measures, None, accepted_distance(1.0, 0.01))
        };
        assert_eq!(short(0.0), []);
        let severities: Vec<f64> = [0.03, 0.06]
            .into_iter()
            .map(|pull| match short(pull)[..] {
                [far @ Shortcoming::Distance { .. }] => far.severity(),
                ref other => panic!("{other:?}"),
            })
            .collect();
        assert!(severities[0] > 0.0 && severities[1] > severities[0], "{severities:?}");
    }

    #[test]
    fn worse_figures_are_more_severe() {
        let pairs = [
            [0.97, 0.5].map(|share| Shortcoming::SharpEdges(SharpCover { share, length: 4.0 })),
            [Shortcoming::MeanShape(0.79), Shortcoming::MeanShape(0.6)],
            [Shortcoming::LeastShape(0.29), Shortcoming::LeastShape(0.1)],
            [Shortcoming::Cuts(1), Shortcoming::Cuts(90)],
        ];
        assert!(pairs.iter().all(|[slight, grave]| 0.0 < slight.severity() && slight.severity() < grave.severity()));
    }
}
