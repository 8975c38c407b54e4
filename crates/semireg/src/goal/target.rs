//! [`Goal`]: what a result shall come to.

use crate::Error;

/// What a result shall come to, whatever number of base vertices that takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goal {
    /// What is asked for.
    pub target: Target,
    /// How often every base face is split, 0 to 8. `None` takes what leads to a base mesh of about a thousand vertices.
    pub levels: Option<u32>,
}

/// A size, or a distance that is not exceeded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// So many vertices, at least 4; the result has them to within 3 %.
    Vertices(usize),
    /// So many triangles, at least 4; the result has them to within 3 %.
    Triangles(usize),
    /// This mean length of the edges, in the units of the input, above 0; the result has it to within 5 %.
    EdgeLength(f64),
    /// The greatest distance between result and input, measured either way, as a share of the diagonal of the input's box, above 0. Of the
    /// results that are tried the smallest is taken that keeps below it.
    MaxError(f64),
    /// The same in the units of the input.
    MaxErrorLength(f64),
}

impl Target {
    /// Fails where no result can be meant.
    pub(super) fn check(self) -> Result<(), Error> {
        let (name, value, is_sound) = match self {
            Self::Vertices(n) => ("number of vertices", n as f64, n >= LEAST_COUNT),
            Self::Triangles(n) => ("number of triangles", n as f64, n >= LEAST_COUNT),
            Self::EdgeLength(length) => ("edge length", length, is_positive(length)),
            Self::MaxError(share) => ("greatest error", share, is_positive(share)),
            Self::MaxErrorLength(length) => ("greatest error", length, is_positive(length)),
        };
        if is_sound { Ok(()) } else { Err(Error::NoGoal { name, value }) }
    }
}

/// The smallest closed surface, a tetrahedron, has so many vertices and triangles.
const LEAST_COUNT: usize = 4;

fn is_positive(value: f64) -> bool {
    value.is_finite() && value > 0.0
}
