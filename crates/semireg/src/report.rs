//! What was done, in figures.

use certify::Certificate;
use mesh_core::CleanReport;
use region_map::BaseCounts;
use std::time::Instant;

/// Wall time of the stages, in the order that they ran.
#[derive(Clone, Debug, Default)]
pub struct StageSeconds(pub Vec<(&'static str, f64)>);

impl StageSeconds {
    /// Runs a stage and keeps its time; a stage that runs again adds to it.
    pub(crate) fn time<T>(&mut self, stage: &'static str, run: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = run();
        self.add(&Self(vec![(stage, start.elapsed().as_secs_f64())]));
        result
    }

    /// Adds the times of others.
    pub(crate) fn add(&mut self, other: &Self) {
        for &(stage, seconds) in &other.0 {
            match self.0.iter_mut().find(|s| s.0 == stage) {
                Some(entry) => entry.1 += seconds,
                None => self.0.push((stage, seconds)),
            }
        }
    }
}

/// Everything worth telling about a run.
#[derive(Clone, Debug)]
pub struct Report {
    /// Repairs of the input.
    pub clean: CleanReport,
    /// Base vertices asked, needed and made.
    pub base: BaseCounts,
    /// Patches, network corners and network arcs.
    pub cells: [usize; 3],
    /// Crease length kept in the network, and length of the creases that were left out as minor, in the units of the mesh.
    pub crease_length: [f64; 2],
    /// What did not go as usual, in plain words.
    pub warnings: Vec<String>,
    /// What the projection did.
    pub project: project::ProjectReport,
    /// What the relaxation did.
    pub relax: relax::RelaxReport,
    /// Bends of arcs and pieces of minor creases that the finest level was snapped to.
    pub snapped: [usize; 2],
    /// What the fit did; `None` without one.
    pub fit: Option<fit::FitReport>,
    /// The independent check of the result.
    pub certificate: Certificate,
    /// Wall time of the stages.
    pub seconds: StageSeconds,
}
