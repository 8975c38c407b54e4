//! `semireg remesh`: read, remesh, write, report.

use crate::plan::RemeshPlan;
use crate::print;
use crate::report::Report;
use crate::stages;
use anyhow::Context as _;
use std::time::Instant;

/// Writes the result only once it is certified; then the report.
pub(crate) fn run(plan: &RemeshPlan) -> anyhow::Result<()> {
    let start = Instant::now();
    let document = mesh_io::read(&plan.input)?;
    let read_seconds = start.elapsed().as_secs_f64();
    let base = plan.base.as_deref().map(mesh_io::read).transpose()?;
    let remeshed = match &base {
        Some(base) => semireg::remesh_with_base(&document.soup, &base.soup, &plan.options),
        None => semireg::remesh(&document.soup, &plan.options),
    };
    let remeshed = remeshed.with_context(|| plan.input.display().to_string())?;
    // Pictures first: when they fail, there is no result beside the error.
    if let Some(folder) = &plan.stages {
        stages::write(folder, &remeshed)?;
    }
    mesh_io::write(&plan.output, &remeshed.mesh)?;
    let mut report = Report::new(plan, &remeshed);
    report.add_seconds("read", read_seconds);
    report.add_seconds("total", start.elapsed().as_secs_f64());
    if plan.json { print::json(&report) } else { report.table().print() }
}
