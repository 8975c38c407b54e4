//! Options of the fit.

use crate::FitError;

/// How far vertices may go, and what the fit may cost.
#[derive(Clone, Debug, PartialEq)]
pub struct FitOptions {
    /// Rounds in which vertices slide over the surface as well as rise; 0 for offsets alone. 0 to 100. Default 2.
    pub slides: usize,
    /// Rounds after them in which vertices only rise. 0 to 100. Default 1; 0 in both leaves the mesh as it is.
    pub rises: usize,
    /// How far a vertex may leave the surface, as a share of the mean length of its edges, at least 0. Default 0.25. That is how
    /// far the middle of an edge is from a circle through its ends that turns by 106 degrees between them.
    pub reach: f64,
    /// By what share of it the quality (AR) of a triangle may fall, 0 to 1. Default 0.1.
    pub quality_loss: f64,
    /// By how much the mean quality may fall for the vertices' sliding, 0 to 1. Default 0.002.
    pub mean_quality_loss: f64,
    /// By what share the mean distance has to fall for the fit to be used, 0 to 1. Default 0.02.
    pub least_gain: f64,
}

impl Default for FitOptions {
    fn default() -> Self {
        Self { slides: 2, rises: 1, reach: 0.25, quality_loss: 0.1, mean_quality_loss: 0.002, least_gain: 0.02 }
    }
}

impl FitOptions {
    /// Fails for the first option that is out of its range.
    pub fn check(&self) -> Result<(), FitError> {
        in_range("slides", self.slides as f64, [0.0, 100.0])?;
        in_range("rises", self.rises as f64, [0.0, 100.0])?;
        in_range("reach", self.reach, [0.0, 1e6])?;
        in_range("quality_loss", self.quality_loss, [0.0, 1.0])?;
        in_range("mean_quality_loss", self.mean_quality_loss, [0.0, 1.0])?;
        in_range("least_gain", self.least_gain, [0.0, 1.0])
    }
}

fn in_range(name: &'static str, value: f64, [least, most]: [f64; 2]) -> Result<(), FitError> {
    // Not so for NaN either.
    if least <= value && value <= most { Ok(()) } else { Err(FitError::Option { name, value, least, most }) }
}
