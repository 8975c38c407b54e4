//! Options of both parts of the relaxation.

use crate::RelaxError;

/// How to relax: first the paper's quadric relaxation, then shape optimisation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RelaxOptions {
    /// The paper's relaxation.
    pub quadric: QuadricOptions,
    /// Shape optimisation.
    pub shape: ShapeOptions,
}

/// The paper's relaxation (section 4.3, eqs. 7 to 9).
#[derive(Clone, Debug, PartialEq)]
pub struct QuadricOptions {
    /// Iterations at most; 0 leaves the part out. Default 10: it only smooths the start of the shape optimisation.
    pub iterations: usize,
    /// Weights of the neighbours. Default uniform.
    pub weights: Weights,
    /// Weight of the distance to the tangent plane against that to the centroid, 0 to 1e6. Default 1, the paper's.
    pub plane_weight: f64,
    /// Mean quality (AR, 0 to 1) at which to stop: the paper's `T_AR`. Default 1, never reached.
    pub target_quality: f64,
}

impl Default for QuadricOptions {
    fn default() -> Self {
        Self { iterations: 10, weights: Weights::Uniform, plane_weight: 1.0, target_quality: 1.0 }
    }
}

/// Weights of the neighbours in the centroid.
///
/// Measured against the paper's claim, with its own pipeline (`--method paper`): adaptive weights make areas more even and shapes worse (mean AR,
/// uniform to adaptive: fandisk .863 to .832, rabbit .926 to .864, rocker arm .894 to .839). So uniform is the default.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weights {
    /// All 1 (section 4.3.1).
    Uniform,
    /// The cube of the valence at irregular vertices, diffused between them until it is smooth (section 4.3.2, corrected).
    Adaptive,
}

/// Shape optimisation of the finest level.
///
/// The areas that triangles shall have are the mean over each sheet at the start.
#[derive(Clone, Debug, PartialEq)]
pub struct ShapeOptions {
    /// Newton steps at most while triangles are inverted; 0 leaves untangling out. Default 60.
    pub untangling_steps: usize,
    /// Newton steps at most once none is; 0 leaves the part out. Default 30.
    pub steps: usize,
    /// Power of the shape term, 1 to 100: more lifts the worst triangles at the cost of the mean. Default 2.
    pub power: f64,
    /// Weight of the size term against the shape term, 0 to 1e6. Default 0.02.
    ///
    /// Shape is bought with size. Measured from 0.02 to 0.1 on seven starts: the mean AR falls by .001 to .018 (most on a rocker
    /// arm, .960 to .942), greatest over least area mostly halves, the mean error falls by 1 to 4 %. Where the error has grown
    /// much (rabbit from a QEM base, 6.0e-5 of the diagonal to 13.7e-5) only 1 and more brings it back, at AR .909.
    pub size_weight: f64,
    /// Stop after three steps in a row that each lower the energy, as far as it exceeds its least value, by less than this share,
    /// 0 to 1. Default 1e-3.
    pub tolerance: f64,
}

impl Default for ShapeOptions {
    fn default() -> Self {
        Self { untangling_steps: 60, steps: 30, power: 2.0, size_weight: 0.02, tolerance: 1e-3 }
    }
}

impl RelaxOptions {
    /// Fails for the first option that is out of its range.
    pub fn check(&self) -> Result<(), RelaxError> {
        self.quadric.check()?;
        self.shape.check()
    }
}

impl QuadricOptions {
    /// Fails for the first option that is out of its range.
    pub fn check(&self) -> Result<(), RelaxError> {
        in_range("quadric.plane_weight", self.plane_weight, [0.0, 1e6])?;
        in_range("quadric.target_quality", self.target_quality, [0.0, 1.0])
    }
}

impl ShapeOptions {
    /// Fails for the first option that is out of its range.
    pub fn check(&self) -> Result<(), RelaxError> {
        in_range("shape.power", self.power, [1.0, 100.0])?;
        in_range("shape.size_weight", self.size_weight, [0.0, 1e6])?;
        in_range("shape.tolerance", self.tolerance, [0.0, 1.0])
    }
}

fn in_range(name: &'static str, value: f64, [least, most]: [f64; 2]) -> Result<(), RelaxError> {
    // Not so for NaN either.
    if least <= value && value <= most { Ok(()) } else { Err(RelaxError::Option { name, value, least, most }) }
}
