//! [`Way`]: where a base mesh comes from, and [`Method`]: which ways are gone.

/// Where a base mesh comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Sites of patches, triangulated in charts (paper, section 3).
    Patches,
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
            Self::Decimation => "decimation",
            Self::Given => "given",
        }
    }
}

/// Which ways to a base mesh are gone.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// The way that promises more; the other one where its result is not right.
    #[default]
    Best,
    /// The paper's way alone: sites of patches, triangulated in charts.
    Patches,
    /// Decimation alone.
    Decimation,
}
