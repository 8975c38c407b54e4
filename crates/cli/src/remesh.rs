//! `semireg remesh`: read, remesh, write, report.

use crate::load;
use crate::plan::RemeshPlan;
use crate::print;
use crate::progress::Meter;
use crate::report::Report;
use crate::stages;
use anyhow::Context as _;
use semireg::Options;
use std::time::Instant;

/// Writes the result only once it is certified; then the report.
pub(crate) fn run(plan: &RemeshPlan) -> anyhow::Result<()> {
    let start = Instant::now();
    let mut meter = Meter::new(plan.talk);
    let document = mesh_io::read(&plan.input)?;
    let base_mesh = plan.base.as_deref().map(mesh_io::read).transpose()?.map(|base| base.soup);
    let read_seconds = start.elapsed().as_secs_f64();
    let options = Options { base_mesh, ..plan.options.clone() };
    let remeshed = semireg::remesh_with(&document.soup, &options, &mut |progress| meter.step(progress))
        .with_context(|| plan.input.display().to_string())?;
    let before_writing = Instant::now();
    meter.begin_writing()?;
    // Pictures first: when they fail, there is no result beside the error.
    if let Some(folder) = &plan.stages {
        stages::write(folder, &remeshed)?;
    }
    mesh_io::write(&plan.output, &remeshed.mesh)?;
    drop(meter);
    let write_seconds = before_writing.elapsed().as_secs_f64();
    let mut report = Report::new(plan, &remeshed);
    report.add_warning(load::lost(&document.extras));
    report.seconds.add("read", read_seconds);
    report.seconds.add("write", write_seconds);
    report.seconds.end("report", start.elapsed().as_secs_f64());
    print::report(plan.talk, &report, || report.summary(), || report.table())
}
