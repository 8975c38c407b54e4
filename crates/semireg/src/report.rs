//! What was done, in figures.

use crate::SizeTry;
use crate::attempt::Attempt;
use crate::base::{BaseCounts, CellCounts, Way};
use crate::run::StageSeconds;
use certify::{Certificate, SharpCover, Shortcoming};
use mesh_core::CleanReport;
use region_map::CreaseLengths;

/// Everything worth telling about a run.
#[derive(Clone, Debug)]
pub struct Report {
    /// Repairs of the input.
    pub clean: CleanReport,
    /// Base vertices asked, needed and made.
    pub base: BaseCounts,
    /// Where the base mesh comes from.
    pub way: Way,
    /// How the surface was cut up.
    pub cells: CellCounts,
    /// Crease length kept in the network, and length of the creases that were left out as minor.
    pub crease_lengths: CreaseLengths,
    /// What was tried, in order. The last base mesh is not always the one of the result: the best is kept.
    pub attempts: Vec<Attempt>,
    /// What did not go as usual, in plain words.
    pub warnings: Vec<String>,
    /// What the projection did.
    pub project: project::ProjectReport,
    /// What the relaxation did.
    pub relax: relax::RelaxReport,
    /// What the finest level was snapped to.
    pub snapped: SnapCounts,
    /// What the fit did; `None` without one.
    pub fit: Option<fit::FitReport>,
    /// The independent check of the result.
    pub certificate: Certificate,
    /// What is kept of the sharp edges that a person sees; `None` where there are none, or none are wanted.
    pub sharp_edges: Option<SharpCover>,
    /// What a person would not accept of it without a second look.
    pub shortcomings: Vec<Shortcoming>,
    /// The sizes that were tried for the sake of a [`Goal`](crate::Goal), in order; empty without one.
    pub sizes: Vec<SizeTry>,
    /// Wall time of the stages.
    pub seconds: StageSeconds,
}

/// What the finest level was snapped to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SnapCounts {
    /// Bends of arcs.
    pub bends: usize,
    /// Pieces of minor creases.
    pub minor_creases: usize,
}
