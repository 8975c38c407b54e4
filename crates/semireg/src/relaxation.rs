//! [`Relaxation`]: how a base mesh becomes the finest level.

use relax::{QuadricOptions, Weights};

/// How the finest level is placed and relaxed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Relaxation {
    /// Level by level on the surface, for the shape of triangles; then snapped to bends and minor creases, and fitted.
    #[default]
    Shape,
    /// As the paper prints it: rays, the quadric relaxation in space, and rays again (section 4). Nothing is snapped or fitted.
    Paper(PaperOptions),
}

/// What the paper lets its user choose for the relaxation (section 5, Table 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaperOptions {
    /// Weights of the neighbours (section 4.3.1 or 4.3.2). Default uniform.
    pub weights: Weights,
    /// Mean quality (AR, 0 to 1) at which the relaxation stops: the paper's `T_AR`. Default 1, never reached.
    pub target_quality: f64,
    /// Iterations at most; the relaxation ends before when nothing is gained any more. Default 100.
    pub iterations: usize,
}

impl Default for PaperOptions {
    fn default() -> Self {
        Self { weights: Weights::Uniform, target_quality: 1.0, iterations: 100 }
    }
}

impl PaperOptions {
    /// The same for the crate of the relaxation.
    pub(crate) fn quadric(self) -> QuadricOptions {
        let Self { weights, target_quality, iterations } = self;
        QuadricOptions { iterations, weights, target_quality, ..QuadricOptions::default() }
    }
}
