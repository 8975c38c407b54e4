//! The options of `--method paper`.

use crate::number::{iterations, quality};
use semireg::{PaperOptions, Weights};

/// What only `--method paper` takes.
#[derive(clap::Args, Clone, Copy)]
pub(crate) struct PaperArgs {
    /// With --method paper: weights of the neighbours in its relaxation [default: uniform]
    #[arg(long, value_name = "WEIGHTS", value_enum)]
    pub(crate) weights: Option<WeightsArg>,
    /// With --method paper: mean quality at which its relaxation stops, 0 to 1 [default: 1, never reached]
    #[arg(long, value_name = "Q", value_parser = quality, allow_negative_numbers = true)]
    pub(crate) target_quality: Option<f64>,
    /// With --method paper: iterations of its relaxation at most; it ends before when nothing is gained [default: 100]
    #[arg(long, value_name = "N", value_parser = iterations, allow_negative_numbers = true)]
    pub(crate) relax_iterations: Option<u32>,
}

impl PaperArgs {
    /// The first option that was given.
    pub(crate) fn given(self) -> Option<&'static str> {
        let options = [
            ("--weights", self.weights.is_some()),
            ("--target-quality", self.target_quality.is_some()),
            ("--relax-iterations", self.relax_iterations.is_some()),
        ];
        options.into_iter().find_map(|(name, is_given)| is_given.then_some(name))
    }

    /// The same for the library.
    pub(crate) fn options(self) -> PaperOptions {
        let default = PaperOptions::default();
        PaperOptions {
            weights: self.weights.map_or(default.weights, Weights::from),
            target_quality: self.target_quality.unwrap_or(default.target_quality),
            iterations: self.relax_iterations.map_or(default.iterations, |n| n as usize),
        }
    }
}

/// Weights of the neighbours.
#[derive(clap::ValueEnum, Clone, Copy)]
pub(crate) enum WeightsArg {
    /// All alike
    Uniform,
    /// More at vertices of many triangles, less at those of few, smooth between them
    Adaptive,
}

impl From<WeightsArg> for Weights {
    fn from(weights: WeightsArg) -> Self {
        match weights {
            WeightsArg::Uniform => Self::Uniform,
            WeightsArg::Adaptive => Self::Adaptive,
        }
    }
}
