//! [`Way`]: where a base mesh comes from.

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
