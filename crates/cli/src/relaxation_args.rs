//! The options of the relaxation, ours or the paper's.

use crate::number::{iterations, quality};
use semireg::{PaperOptions, Relaxation, Weights};

/// How the finest level is relaxed.
#[derive(clap::Args, Clone, Copy)]
pub(crate) struct RelaxationArgs {
    /// How the finest level is relaxed [default: shape; paper with --method paper]
    #[arg(long, value_name = "HOW", value_enum)]
    pub(crate) relaxation: Option<RelaxationArg>,
    /// With the paper's relaxation: weights of the neighbours [default: uniform]
    #[arg(long, value_name = "WEIGHTS", value_enum)]
    pub(crate) weights: Option<WeightsArg>,
    /// With the paper's relaxation: mean quality at which it stops, 0 to 1 [default: 1, never reached]
    #[arg(long, value_name = "Q", value_parser = quality, allow_negative_numbers = true)]
    pub(crate) target_quality: Option<f64>,
    /// With the paper's relaxation: iterations at most; it ends before when nothing is gained [default: 100]
    #[arg(long, value_name = "N", value_parser = iterations, allow_negative_numbers = true)]
    pub(crate) relax_iterations: Option<u32>,
}

impl RelaxationArgs {
    /// The same for the library; `default` where none was asked for. The name of an option that has no meaning then as an error.
    pub(crate) fn relaxation(self, default: RelaxationArg) -> Result<Relaxation, &'static str> {
        match (self.relaxation.unwrap_or(default), self.of_paper()) {
            (RelaxationArg::Paper, _) => Ok(Relaxation::Paper(self.paper_options())),
            (RelaxationArg::Shape, None) => Ok(Relaxation::Shape),
            (RelaxationArg::Shape, Some(option)) => Err(option),
        }
    }

    /// The first option that only the paper's relaxation takes.
    fn of_paper(self) -> Option<&'static str> {
        let options = [
            ("--weights", self.weights.is_some()),
            ("--target-quality", self.target_quality.is_some()),
            ("--relax-iterations", self.relax_iterations.is_some()),
        ];
        options.into_iter().find_map(|(name, is_given)| is_given.then_some(name))
    }

    fn paper_options(self) -> PaperOptions {
        let default = PaperOptions::default();
        PaperOptions {
            weights: self.weights.map_or(default.weights, Weights::from),
            target_quality: self.target_quality.unwrap_or(default.target_quality),
            iterations: self.relax_iterations.map_or(default.iterations, |n| n as usize),
        }
    }
}

/// How the finest level is relaxed.
#[derive(clap::ValueEnum, Clone, Copy)]
pub(crate) enum RelaxationArg {
    /// On the surface, for the shape of triangles, with snapping and the fit
    Shape,
    /// As the paper prints it, by quadrics in space, with neither
    Paper,
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
