//! `semireg base` and `semireg stages`: the pipeline up to the base mesh.

use crate::figures::Figures;
use crate::plan::BasePlan;
use crate::print::{self, Table};
use crate::report::{BaseVertices, Cells, CreaseLength, as_map, course_rows, repairs};
use crate::stages;
use anyhow::Context as _;
use certify::MeasureOptions;
use semireg::Based;
use serde::Serialize;
use std::time::Instant;

/// Points that are sent through the base map and back, to see that it is exact.
const ROUND_TRIPS: usize = 1000;

/// Makes the base mesh, writes it or the pictures of its stages, and reports.
pub(crate) fn run(plan: &BasePlan) -> anyhow::Result<()> {
    let start = Instant::now();
    let document = mesh_io::read(&plan.input)?;
    let read_seconds = start.elapsed().as_secs_f64();
    let based = semireg::base(&document.soup, &plan.options).with_context(|| plan.input.display().to_string())?;
    let mut report = BaseReport::new(plan, &based)?;
    if let Some(folder) = &plan.stages {
        stages::write_base(folder, &based.stages)?;
    }
    if let Some(output) = &plan.output {
        mesh_io::write(output, &based.stages.base.mesh)?;
    }
    report.seconds.extend([("read", read_seconds), ("total", start.elapsed().as_secs_f64())]);
    if plan.json { print::json(&report) } else { report.table().print() }
}

/// Everything worth telling of a base mesh, under the names that the report of a remeshing has.
#[derive(Serialize)]
struct BaseReport {
    version: &'static str,
    input: String,
    output: Option<String>,
    seed: u64,
    #[serde(serialize_with = "as_map")]
    repairs: Vec<(&'static str, usize)>,
    warnings: Vec<String>,
    base_vertices: BaseVertices,
    cells: Cells,
    crease_length: CreaseLength,
    /// How far points of the input are off after a way to the base mesh and back, at most, over the diagonal.
    round_trip: f64,
    #[serde(flatten)]
    figures: Figures,
    #[serde(serialize_with = "as_map")]
    seconds: Vec<(&'static str, f64)>,
}

impl BaseReport {
    fn new(plan: &BasePlan, based: &Based) -> anyhow::Result<Self> {
        let stages = &based.stages;
        let measures = certify::measure(&stages.cleaned.mesh, &stages.base.mesh, &MeasureOptions::default())
            .with_context(|| format!("cannot measure the base mesh of {}", plan.input.display()))?;
        let target = plan.output.as_ref().or(plan.stages.as_ref());
        Ok(Self {
            version: env!("CARGO_PKG_VERSION"),
            input: plan.input.display().to_string(),
            output: target.map(|path| path.display().to_string()),
            seed: plan.options.seed,
            repairs: repairs(&stages.cleaned.report),
            warnings: stages.warnings.clone(),
            base_vertices: (&stages.base.counts).into(),
            cells: stages.cell_counts().into(),
            crease_length: stages.crease_length().into(),
            round_trip: stages.base.round_trip_error(&stages.working.mesh, ROUND_TRIPS),
            figures: Figures::new(&measures, |t| t.indexed),
            seconds: based.seconds.0.clone(),
        })
    }

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
