//! Options of the sampling.

/// How many sites, and how they are relaxed.
#[derive(Clone, Debug, PartialEq)]
pub struct CvtOptions {
    /// Wanted number of base vertices, corners included, at most 1,000,000. Default 200.
    pub base_vertices: usize,
    /// Seed of the first sites; other seeds give other base meshes of the same quality. Default 0.
    pub seed: u64,
    /// Cap on the Lloyd steps of a patch; most stop before. Default 60.
    pub max_steps: usize,
}

impl Default for CvtOptions {
    fn default() -> Self {
        Self { base_vertices: 200, seed: 0, max_steps: 60 }
    }
}
