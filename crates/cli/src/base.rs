//! `semireg base` and `semireg stages`: the pipeline up to the base mesh.

use crate::figures::Figures;
use crate::load;
use crate::plan::BasePlan;
use crate::print::{self, Table};
use crate::progress::Meter;
use crate::repairs::Repairs;
use crate::report::{BaseVertices, Cells, CreaseLength, Try, course_rows, warning_rows};
use crate::seconds::Seconds;
use crate::stages;
use anyhow::Context as _;
use certify::{MeasureOptions, Reference};
use mesh_core::TriMesh;
use semireg::Based;
use serde::Serialize;
use std::time::Instant;

/// Points that are sent through the base map and back, to see that it is exact.
const ROUND_TRIPS: usize = 1000;

/// Makes the base mesh, writes it or the pictures of its stages, and reports.
pub(crate) fn run(plan: &BasePlan) -> anyhow::Result<()> {
    let start = Instant::now();
    let mut meter = Meter::new(plan.talk);
    let document = plan.input.read()?;
    let read_seconds = start.elapsed().as_secs_f64();
    let options = plan.marks.added_to(&plan.options, &document, &plan.input)?;
    let based = semireg::base_with(&document.soup, &options, &mut |progress| meter.step(progress))
        .with_context(|| plan.input.to_string())?;
    let base = based.stages.on_working_mesh()?;
    let mut report = BaseReport::new(plan, &based, &base.mesh)?;
    meter.begin_writing()?;
    if let Some(folder) = &plan.stages {
        stages::write_base(folder, &based.stages)?;
    }
    if let Some(output) = &plan.output {
        output.write(&base.mesh)?;
    }
    drop(meter);
    report.seconds.add("read", read_seconds);
    report.seconds.end("report", start.elapsed().as_secs_f64());
    if plan.output.is_some() {
        report.warnings.extend(load::lost(&document.extras));
    }
    print::report(plan.talk, &report, || report.summary(), || report.table())
}

/// Everything worth telling of a base mesh, under the names that the report of a remeshing has.
#[derive(Serialize)]
struct BaseReport {
    version: &'static str,
    input: String,
    output: Option<String>,
    seed: u64,
    repairs: Repairs,
    warnings: Vec<String>,
    /// Where the base mesh comes from.
    way: &'static str,
    attempts: Vec<Try>,
    base_vertices: BaseVertices,
    cells: Cells,
    crease_length: CreaseLength,
    /// How far points of the input are off after a way to the base mesh and back, at most, over the diagonal.
    round_trip: Option<f64>,
    #[serde(flatten)]
    figures: Figures,
    seconds: Seconds,
}

impl BaseReport {
    fn new(plan: &BasePlan, based: &Based, base: &TriMesh) -> anyhow::Result<Self> {
        let stages = &based.stages;
        let measures = Reference::new(stages.cleaned.mesh.clone())
            .and_then(|input| certify::measure(&input, base, &MeasureOptions::default()))
            .with_context(|| format!("cannot measure the base mesh of {}", plan.input))?;
        let output = plan.output.as_ref().map(ToString::to_string);
        let folder = plan.stages.as_ref().map(|folder| folder.display().to_string());
        Ok(Self {
            version: env!("CARGO_PKG_VERSION"),
            input: plan.input.to_string(),
            output: output.or(folder),
            seed: plan.options.seed,
            repairs: Repairs::new(&stages.cleaned.report),
            warnings: stages.warnings.clone(),
            way: stages.way.name(),
            attempts: based.attempts.iter().map(Try::from).collect(),
            base_vertices: (&stages.counts).into(),
            cells: stages.cell_counts().into(),
            crease_length: stages.crease_lengths().into(),
            round_trip: stages.base.mapped().map(|base| base.round_trip_error(stages.base_surface().mesh(), ROUND_TRIPS)),
            figures: Figures::new(&measures, |t| t.indexed),
            seconds: Seconds::new(&based.seconds),
        })
    }

    /// What matters, in at most ten lines.
    fn summary(&self) -> Table {
        let mut table = Table::default();
        let output = self.output.as_deref().unwrap_or_default();
        table.row("written", format!("{output} after {:.1} s (-v shows all figures)", self.seconds.total()));
        table.row("base mesh", self.base_vertices.words());
        self.crease_length.summary(&mut table);
        self.figures.base_summary(&mut table);
        self.repairs.summary(&mut table);
        warning_rows(&mut table, &self.warnings);
        table
    }

    /// All figures, one line each.
    fn table(&self) -> Table {
        let mut table = Table::default();
        table.row_if("written", self.output.as_ref());
        self.base_vertices.row(&mut table);
        self.cells.row(&mut table);
        self.crease_length.row(&mut table);
        self.figures.rows(&mut table);
        course_rows(&mut table, &self.repairs, &self.warnings, &self.seconds);
        table
    }
}
