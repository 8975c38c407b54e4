//! The report of a remeshing, as JSON and as a table.

use crate::displacement_figures::DisplacementFigures;
use crate::figures::Figures;
use crate::outputs::ResultFiles;
use crate::plan::RemeshPlan;
use crate::print::Table;
use crate::repairs::Repairs;
use crate::seconds::Seconds;
use region_map::CreaseLengths;
use semireg::{Attempt, BaseCounts, CellCounts, FitReport, Remeshed, SizeTry, Split, Target, Verdict};
use serde::Serialize;
use std::collections::BTreeMap;

/// Everything worth telling. Field names are the contract of `--json`.
#[derive(Serialize)]
pub(crate) struct Report {
    version: &'static str,
    input: String,
    output: String,
    /// All files that were written, the output first.
    files: Vec<String>,
    parameters: Parameters,
    seed: u64,
    /// "certified", or that with what a person would not accept without a second look.
    verdict: String,
    shortcomings: Vec<String>,
    repairs: Repairs,
    warnings: Vec<String>,
    /// Where the base mesh comes from.
    way: &'static str,
    attempts: Vec<Try>,
    /// The sizes that were tried where one was asked for.
    sizes: Vec<SizeTried>,
    base_vertices: BaseVertices,
    levels: Vec<[usize; 2]>,
    cells: Cells,
    crease_length: CreaseLength,
    /// Iterations of the paper's relaxation.
    relax_iterations: usize,
    fit: Option<Fit>,
    /// Of the input's box, in its units.
    diagonal: f64,
    #[serde(flatten)]
    figures: Figures,
    /// Null where none is written.
    pub(crate) displacement: Option<DisplacementFigures>,
    pub(crate) seconds: Seconds,
}

/// One try on the way to the result.
#[derive(Serialize)]
pub(crate) struct Try {
    remedy: String,
    way: Option<&'static str>,
    verdict: String,
    seconds: f64,
}

impl From<&Attempt> for Try {
    fn from(attempt: &Attempt) -> Self {
        let Attempt { remedy, way, verdict, seconds } = attempt;
        Self { remedy: remedy.to_string(), way: way.map(|w| w.name()), verdict: verdict.to_string(), seconds: *seconds }
    }
}

/// A result that was made for the sake of its size.
#[derive(Serialize)]
struct SizeTried {
    base_vertices: usize,
    levels: u32,
    /// Null where it was not certified.
    triangles: Option<usize>,
    /// Greatest distance between it and the input, in parts of the diagonal.
    error: Option<f64>,
}

impl From<&SizeTry> for SizeTried {
    fn from(tried: &SizeTry) -> Self {
        let SizeTry { split: Split { base_vertices, levels }, triangles, error } = *tried;
        Self { base_vertices, levels, triangles, error }
    }
}

impl SizeTried {
    /// Appends its line.
    fn row(&self, table: &mut Table) {
        let Self { base_vertices, levels, triangles, error } = self;
        let came_to = match (triangles, error) {
            (Some(triangles), Some(error)) => {
                format!("{triangles} triangles, {:.3} % of the diagonal away at most", 100.0 * error)
            }
            _ => "not certified".to_owned(),
        };
        table.row("size tried", format!("{base_vertices} base vertices, {levels} levels: {came_to}"));
    }
}

/// A target by the name of its option.
fn asked(target: Target) -> (&'static str, f64) {
    match target {
        Target::Vertices(n) => ("vertices", n as f64),
        Target::Triangles(n) => ("triangles", n as f64),
        Target::EdgeLength(length) => ("edge_length", length),
        Target::MaxError(share) => ("max_error", share),
        Target::MaxErrorLength(length) => ("max_error_length", length),
    }
}

/// What was asked for; null where it was left to us.
#[derive(Serialize)]
struct Parameters {
    base: Option<String>,
    base_vertices: Option<usize>,
    #[serde(flatten)]
    goal: BTreeMap<&'static str, f64>,
    levels: Option<u32>,
    crease_angle: f64,
    weak_angle: f64,
    features: &'static str,
    keep: Vec<&'static str>,
    marked_edges: usize,
}

#[derive(Serialize)]
pub(crate) struct BaseVertices {
    asked: usize,
    needed: usize,
    made: usize,
    /// Why there are more than asked for; empty where the request was met.
    reason: String,
}

#[derive(Serialize)]
pub(crate) struct Cells {
    patches: usize,
    corners: usize,
    arcs: usize,
}

/// Offsets in parts of the input's diagonal.
#[derive(Serialize)]
struct Fit {
    used: bool,
    mean_offset: f64,
    max_offset: f64,
}

impl Fit {
    fn new(report: FitReport, diagonal: f64) -> Self {
        let share = |length: f64| if diagonal > 0.0 { length / diagonal } else { 0.0 };
        Self { used: report.used, mean_offset: share(report.mean_offset), max_offset: share(report.max_offset) }
    }

    fn row(&self, table: &mut Table) {
        let Self { used, mean_offset, max_offset } = self;
        let offsets = || format!("offsets mean {mean_offset:.2e}, greatest {max_offset:.2e} of the diagonal");
        table.row("fit", if *used { offsets() } else { "left out: it did not pay".to_owned() });
    }
}

/// In the units of the input.
#[derive(Serialize)]
pub(crate) struct CreaseLength {
    kept: f64,
    /// Left out of the base mesh as too small for it.
    minor: f64,
    /// What is kept of both; null without creases.
    share: Option<f64>,
}

impl From<&BaseCounts> for BaseVertices {
    fn from(counts: &BaseCounts) -> Self {
        let BaseCounts { asked, needed, made, reason } = counts.clone();
        Self { asked, needed, made, reason }
    }
}

impl From<CellCounts> for Cells {
    fn from(counts: CellCounts) -> Self {
        let CellCounts { patches, corners, arcs } = counts;
        Self { patches, corners, arcs }
    }
}

impl From<CreaseLengths> for CreaseLength {
    fn from(lengths: CreaseLengths) -> Self {
        // An empty sum is -0.
        let [kept, minor] = [lengths.kept, lengths.minor].map(|l| l + 0.0);
        let whole = kept + minor;
        Self { kept, minor, share: (whole > 0.0).then(|| kept / whole) }
    }
}

impl Try {
    /// Appends its line.
    pub(crate) fn row(&self, table: &mut Table) {
        let Self { remedy, verdict, seconds, .. } = self;
        table.row("attempt", format!("{remedy}: {verdict} ({seconds:.1} s)"));
    }
}

impl BaseVertices {
    /// How many there are, and why there are not as many as asked.
    pub(crate) fn words(&self) -> String {
        let Self { asked, made, .. } = self;
        let why = self.why();
        if made == asked { format!("{made} vertices") } else { format!("{made} vertices (asked {asked}{why})") }
    }

    /// Appends its line.
    pub(crate) fn row(&self, table: &mut Table) {
        let Self { asked, needed, made, .. } = self;
        table.row("base vertices", format!("{made} (asked {asked}, needed {needed}){}", self.why()));
    }

    fn why(&self) -> String {
        if self.reason.is_empty() { String::new() } else { format!(": {}", self.reason) }
    }
}

impl Cells {
    /// Appends its line.
    pub(crate) fn row(&self, table: &mut Table) {
        let Self { patches, corners, arcs } = self;
        let patches = if *patches > 0 { format!(", {patches} patches") } else { String::new() };
        table.row("network", format!("{corners} corners, {arcs} arcs{patches}"));
    }
}

impl CreaseLength {
    /// Appends the line that matters where there are creases.
    pub(crate) fn summary(&self, table: &mut Table) {
        let text = |share: f64| format!("base edges run along {:.0} % of their length, the rest is short or weak", 100.0 * share);
        let whole = "base edges run along all of them".to_owned();
        table.row_if("sharp edges", self.share.map(|share| if self.minor > 0.0 { text(share) } else { whole }));
    }

    /// Appends its line where there are creases.
    pub(crate) fn row(&self, table: &mut Table) {
        let Self { kept, minor, share } = self;
        table.row_if("crease length", share.map(|s| format!("{:.2} % kept: {kept:.6}, left out as minor {minor:.6}", 100.0 * s)));
    }
}

impl Report {
    /// Collects the figures of a run.
    pub(crate) fn new(plan: &RemeshPlan, files: &ResultFiles, remeshed: &Remeshed) -> Self {
        let report = &remeshed.report;
        let certificate = &report.certificate;
        let diagonal = remeshed.stages.base.cleaned.mesh.diagonal();
        let mut warnings = report.warnings.clone();
        warnings.extend(certificate.warnings().iter().map(ToString::to_string));
        Self {
            version: env!("CARGO_PKG_VERSION"),
            input: plan.input.to_string(),
            output: files.output.to_string(),
            files: files.all().iter().map(|file| file.display().to_string()).collect(),
            parameters: Parameters {
                base: plan.base.as_ref().map(|path| path.display().to_string()),
                base_vertices: plan.options.base_vertices,
                goal: plan.goal.iter().map(|goal| asked(goal.target)).collect(),
                levels: plan.goal.map_or(plan.options.levels, |goal| goal.levels),
                crease_angle: plan.options.features.strong_angle,
                weak_angle: plan.options.features.weak_angle,
                features: plan.marks.features.name(),
                keep: plan.marks.kept(),
                marked_edges: plan.options.marked_edges.len(),
            },
            seed: files.seed,
            verdict: Verdict::of(report.shortcomings.clone()).to_string(),
            shortcomings: report.shortcomings.iter().map(ToString::to_string).collect(),
            repairs: Repairs::new(&report.clean),
            warnings,
            way: report.way.name(),
            attempts: report.attempts.iter().map(Try::from).collect(),
            sizes: report.sizes.iter().map(SizeTried::from).collect(),
            base_vertices: (&report.base).into(),
            levels: certificate.hierarchy.iter().flat_map(|h| &h.levels).map(|l| [l.vertices, l.faces]).collect(),
            cells: report.cells.into(),
            crease_length: report.crease_lengths.into(),
            relax_iterations: report.relax.quadric_iterations,
            fit: report.fit.map(|fit| Fit::new(fit, diagonal)),
            diagonal,
            figures: Figures::new(&certificate.measures, |t| t.indexed)
                .with_sharp_edges(report.sharp_edges, certify::mean_edge(&remeshed.mesh) / diagonal),
            displacement: None,
            seconds: Seconds::new(&report.seconds),
        }
    }

    /// Appends what was written, and first of all what it falls short in.
    fn verdict_rows(&self, table: &mut Table, written: &str) {
        let short = !self.shortcomings.is_empty();
        table.row_if("certified, but", short.then(|| self.shortcomings.join("; ")));
        table.row(if short { "written" } else { "certified" }, written);
    }

    /// Adds a warning that does not come from the stages.
    pub(crate) fn add_warning(&mut self, warning: Option<String>) {
        self.warnings.extend(warning);
    }

    /// What matters, in at most ten lines.
    pub(crate) fn summary(&self) -> Table {
        let mut table = Table::default();
        let written = format!("{} after {:.1} s (-v shows all figures)", self.output, self.seconds.total());
        self.verdict_rows(&mut table, &written);
        let split = match self.levels.len().saturating_sub(1) {
            0 => "not split".to_owned(),
            1 => "split once".to_owned(),
            levels => format!("split {levels} times"),
        };
        table.row("base mesh", format!("{}, {split}", self.base_vertices.words()));
        self.figures.summary(&mut table);
        if let Some(displacement) = &self.displacement {
            displacement.summary(&mut table);
        }
        self.repairs.summary(&mut table);
        warning_rows(&mut table, &self.warnings);
        table
    }

    /// The report for people in full, one line for each figure.
    pub(crate) fn table(&self) -> Table {
        let mut table = Table::default();
        self.verdict_rows(&mut table, &self.output);
        self.base_vertices.row(&mut table);
        table.row("way", self.way);
        self.attempts.iter().for_each(|attempt| attempt.row(&mut table));
        self.sizes.iter().for_each(|size| size.row(&mut table));
        if let Some(fit) = &self.fit {
            fit.row(&mut table);
        }
        self.figures.rows(&mut table);
        if let Some(displacement) = &self.displacement {
            displacement.rows(&mut table);
        }
        course_rows(&mut table, &self.repairs, &self.warnings, &self.seconds);
        table
    }
}

/// Appends the warnings in at most two lines.
pub(crate) fn warning_rows(table: &mut Table, warnings: &[String]) {
    match warnings {
        [first, _, _, ..] => {
            table.row("warning", first);
            table.row("warning", format!("and {} more (-v shows them)", warnings.len() - 1));
        }
        few => few.iter().for_each(|warning| table.row("warning", warning)),
    }
}

/// Appends what happened on the way.
pub(crate) fn course_rows(table: &mut Table, repairs: &Repairs, warnings: &[String], seconds: &Seconds) {
    repairs.rows(table);
    for warning in warnings {
        table.row("warning", warning);
    }
    seconds.row(table);
}
