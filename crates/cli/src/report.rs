//! The report of a remeshing, as JSON and as a table.

use crate::figures::Figures;
use crate::plan::RemeshPlan;
use crate::print::Table;
use mesh_core::CleanReport;
use semireg::Remeshed;
use serde::{Serialize, Serializer};

/// Everything worth telling. Field names are the contract of `--json`.
#[derive(Serialize)]
pub(crate) struct Report {
    version: &'static str,
    input: String,
    output: String,
    parameters: Parameters,
    seed: u64,
    #[serde(serialize_with = "as_map")]
    repairs: Vec<(&'static str, usize)>,
    warnings: Vec<String>,
    base_vertices: BaseVertices,
    levels: Vec<[usize; 2]>,
    cells: Cells,
    crease_length: CreaseLength,
    #[serde(flatten)]
    figures: Figures,
    #[serde(serialize_with = "as_map")]
    seconds: Vec<(&'static str, f64)>,
}

/// What was asked for; null where it was left to us.
#[derive(Serialize)]
struct Parameters {
    base_vertices: Option<usize>,
    levels: u32,
    crease_angle: f64,
}

#[derive(Serialize)]
struct BaseVertices {
    asked: usize,
    needed: usize,
    made: usize,
    /// Why there are more than asked for; empty where the request was met.
    reason: String,
}

#[derive(Serialize)]
struct Cells {
    patches: usize,
    corners: usize,
    arcs: usize,
}

/// In the units of the input.
#[derive(Serialize)]
struct CreaseLength {
    kept: f64,
    /// Left out of the base mesh as too small for it.
    minor: f64,
}

/// Pairs as an object that keeps their order.
fn as_map<T: Serialize, S: Serializer>(pairs: &[(&'static str, T)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(pairs.iter().map(|(k, v)| (k, v)))
}

impl Report {
    /// Collects the figures of a run.
    pub(crate) fn new(plan: &RemeshPlan, remeshed: &Remeshed) -> Self {
        let report = &remeshed.report;
        let certificate = &report.certificate;
        let [patches, corners, arcs] = report.cells;
        let [kept, minor] = report.crease_length;
        let mut warnings = report.warnings.clone();
        warnings.extend(certificate.warnings().iter().map(ToString::to_string));
        Self {
            version: env!("CARGO_PKG_VERSION"),
            input: plan.input.display().to_string(),
            output: plan.output.display().to_string(),
            parameters: Parameters {
                base_vertices: plan.options.base_vertices,
                levels: plan.options.levels,
                crease_angle: plan.options.features.strong_angle,
            },
            seed: plan.options.seed,
            repairs: repairs(&report.clean),
            warnings,
            base_vertices: BaseVertices {
                asked: report.base.asked,
                needed: report.base.needed,
                made: report.base.made,
                reason: report.base.reason.clone(),
            },
            levels: certificate.hierarchy.iter().flat_map(|h| &h.levels).map(|l| [l.vertices, l.faces]).collect(),
            cells: Cells { patches, corners, arcs },
            crease_length: CreaseLength { kept, minor },
            figures: Figures::new(&certificate.measures, |t| t.indexed),
            seconds: report.seconds.0.clone(),
        }
    }

    /// Adds the wall time of something that is not a stage.
    pub(crate) fn add_seconds(&mut self, what: &'static str, seconds: f64) {
        self.seconds.push((what, seconds));
    }

    /// The report for people: what matters, one line each.
    pub(crate) fn table(&self) -> Table {
        let mut table = Table::default();
        table.row("certified", &self.output);
        let BaseVertices { asked, needed, made, reason } = &self.base_vertices;
        table.row("base vertices", format!("{made} (asked {asked}, needed {needed}) {reason}").trim_end());
        self.figures.rows(&mut table);
        let list = |pairs: Vec<String>| (!pairs.is_empty()).then(|| pairs.join(", "));
        let repaired = self.repairs.iter().filter(|(_, n)| *n > 0).map(|(what, n)| format!("{} {n}", what.replace('_', " ")));
        table.row_if("repairs", list(repaired.collect()));
        for warning in &self.warnings {
            table.row("warning", warning);
        }
        table.row_if("seconds", list(self.seconds.iter().map(|(what, s)| format!("{what} {s:.2}")).collect()));
        table
    }
}

/// How often each repair was made. The names are those of the JSON.
pub(crate) fn repairs(report: &CleanReport) -> Vec<(&'static str, usize)> {
    // Taken apart, so that the compiler tells when a repair is missing here.
    let &CleanReport {
        bad_index,
        not_finite,
        merged_exactly,
        merged_by_tolerance,
        collapsed,
        flaps,
        repeated,
        turned,
        orientation_cuts,
        non_manifold_edges,
        leaf_cuts,
        split_edges,
        vertex_copies,
        zero_area_flipped,
        zero_area_dropped,
        zero_area_kept,
        unused_vertices,
    } = report;
    vec![
        ("bad_index", bad_index),
        ("not_finite", not_finite),
        ("merged_exactly", merged_exactly),
        ("merged_by_tolerance", merged_by_tolerance),
        ("collapsed", collapsed),
        ("flaps", flaps),
        ("repeated", repeated),
        ("turned", turned),
        ("orientation_cuts", orientation_cuts),
        ("non_manifold_edges", non_manifold_edges),
        ("leaf_cuts", leaf_cuts),
        ("split_edges", split_edges),
        ("vertex_copies", vertex_copies),
        ("zero_area_flipped", zero_area_flipped),
        ("zero_area_dropped", zero_area_dropped),
        ("zero_area_kept", zero_area_kept),
        ("unused_vertices", unused_vertices),
    ]
}
