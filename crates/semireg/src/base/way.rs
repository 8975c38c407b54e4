//! [`Way`]: where a base mesh comes from, and [`Method`]: which ways are gone.

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

/// How base meshes are made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// The way that promises more; the other one where its result is not right.
    #[default]
    Best,
    /// The paper's way alone: sites of patches, triangulated in charts.
    Patches,
    /// Decimation alone.
    Decimation,
    /// The paper's way as it is printed: the base mesh is neither improved nor searched. There is one attempt.
    Paper,
}
