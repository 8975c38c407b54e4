//! [`Way`]: where a base mesh comes from, and [`Method`]: which ways are gone.

use relax::{QuadricOptions, Weights};

/// Where a base mesh comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Sites of patches, triangulated in charts (paper, section 3).
    Patches,
    /// The same as the paper prints it, its triangulation left as it is.
    Paper,
    /// The working mesh, decimated.
    Decimation,
    /// The options.
    Given,
}

impl Way {
    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Patches => "patches",
            Self::Paper => "paper",
            Self::Decimation => "decimation",
            Self::Given => "given",
        }
    }
}

/// How results are made.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Method {
    /// The way that promises more; the other one where its result is not right.
    #[default]
    Best,
    /// The paper's way alone: sites of patches, triangulated in charts.
    Patches,
    /// Decimation alone.
    Decimation,
    /// The pipeline of the paper, from the patches to the second projection, without what this program adds to it: the base mesh is neither
    /// improved nor searched, the finest level neither optimised nor snapped nor fitted. There is one attempt.
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
    /// The same for the relaxation.
    pub(crate) fn quadric(self) -> QuadricOptions {
        let Self { weights, target_quality, iterations } = self;
        QuadricOptions { iterations, weights, target_quality, ..QuadricOptions::default() }
    }
}
