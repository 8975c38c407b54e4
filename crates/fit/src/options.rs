//! Options of the fit.

/// How to fit.
#[derive(Clone, Debug, PartialEq)]
pub struct FitOptions {
    /// Rounds in which vertices slide over the surface as well as rise; 0 for offsets alone. Default 2.
    pub slides: usize,
    /// Rounds after them in which vertices only rise. Default 1; 0 in both leaves the mesh as it is.
    pub rises: usize,
    /// How far a vertex may leave the surface, as a share of the mean length of its edges. Default 0.25: the sagitta of an edge that sees
    /// the surface turn by 106 degrees.
    pub reach: f64,
    /// By what share of it the quality (AR) of a triangle may fall, 0 to 1. Default 0.1.
    pub quality_loss: f64,
    /// By how much the mean quality may fall for the vertices' sliding. Default 0.002.
    pub mean_quality_loss: f64,
    /// By what share the mean distance has to fall for the fit to be used, 0 to 1. Default 0.02.
    pub least_gain: f64,
}

impl Default for FitOptions {
    fn default() -> Self {
        Self { slides: 2, rises: 1, reach: 0.25, quality_loss: 0.1, mean_quality_loss: 0.002, least_gain: 0.02 }
    }
}
