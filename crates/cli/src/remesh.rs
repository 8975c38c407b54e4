//! `semireg remesh`: read, remesh, write, report; once, or for several seeds.

use crate::output::{Writer, Written};
use crate::outputs::ResultFiles;
use crate::plan::RemeshPlan;
use crate::print;
use crate::progress::{self, Meter};
use crate::report::Report;
use crate::stages;
use anyhow::Context as _;
use mesh_core::TriMesh;
use mesh_io::Document;
use semireg::{Options, Remeshed};
use serde::Serialize;
use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::time::Instant;

/// Writes the results, each only once it is certified; then its report. In JSON the reports of several are in one object.
pub(crate) fn run(plan: &RemeshPlan) -> anyhow::Result<()> {
    let start = Instant::now();
    if plan.end_with_stdin {
        progress::end_with_stdin();
    }
    let document = plan.input.read()?;
    let base_mesh = plan.base.as_deref().map(mesh_io::read).transpose()?.map(|base| base.soup);
    let options = Options { base_mesh, ..plan.marks.added_to(&plan.options, &document, &plan.input)? };
    let mut work = Work { plan, document, options, seeds: HashMap::new(), begun: start };
    let mut variants = Vec::new();
    for files in &plan.outputs.results {
        let made = work.done(files);
        let report = if plan.is_several { made.with_context(|| format!("seed {}", files.seed))? } else { made? };
        if plan.is_several && plan.talk.json {
            variants.push(report);
        } else {
            print::report(plan.talk, &report, || report.summary(), || report.table())?;
        }
    }
    if variants.is_empty() { Ok(()) } else { print::json(plan.talk.into(), &Variants { variants }) }
}

/// The reports of several results.
#[derive(Serialize)]
struct Variants {
    variants: Vec<Report>,
}

/// What all results are made from.
struct Work<'a> {
    plan: &'a RemeshPlan,
    document: Document,
    /// Those of the first result. The others have other seeds.
    options: Options,
    /// The seed that first led to a result, by what stands for its vertices.
    seeds: HashMap<u64, u64>,
    /// When the work on the next result began: for the first one, with reading.
    begun: Instant,
}

impl Work<'_> {
    /// Makes a result and writes it.
    fn done(&mut self, files: &ResultFiles) -> anyhow::Result<Report> {
        let Self { plan, document, options, .. } = self;
        let mut meter = Meter::new(plan.talk);
        let read_seconds = self.begun.elapsed().as_secs_f64();
        options.seed = files.seed;
        let on_progress = &mut |progress| meter.step(progress);
        let remeshed = match &plan.goal {
            Some(goal) => semireg::remesh_to(&document.soup, goal, options, on_progress),
            None => semireg::remesh_with(&document.soup, options, on_progress),
        };
        let remeshed = remeshed.with_context(|| plan.input.to_string())?;
        let files = &files.of_levels(remeshed.report.certificate.levels);
        let before_writing = Instant::now();
        meter.begin_writing()?;
        // Pictures first: when they fail, there is no result beside the error.
        if let Some(folder) = &plan.stages {
            stages::write(folder, &remeshed)?;
        }
        let Written { lost, displacement } = Writer::new(plan, document, &remeshed, files)?.write()?;
        drop(meter);
        let write_seconds = before_writing.elapsed().as_secs_f64();
        let mut report = Report::new(plan, files, &remeshed);
        report.displacement = displacement;
        lost.into_iter().for_each(|warning| report.add_warning(Some(warning)));
        report.add_warning(self.same_as(files.seed, &remeshed));
        report.seconds.add("read", read_seconds);
        report.seconds.add("write", write_seconds);
        report.seconds.end("report", self.begun.elapsed().as_secs_f64());
        self.begun = Instant::now();
        Ok(report)
    }

    /// A warning where a result is that of an earlier seed.
    fn same_as(&mut self, seed: u64, remeshed: &Remeshed) -> Option<String> {
        let first = *self.seeds.entry(fingerprint(&remeshed.mesh)).or_insert(seed);
        (first != seed)
            .then(|| format!("seed {seed} gives the same result as seed {first}: the shape leaves no choice of base mesh"))
    }
}

/// A number that stands for the places of a mesh's vertices, in whatever order: another base mesh has the middles of its edges elsewhere.
fn fingerprint(mesh: &TriMesh) -> u64 {
    let mut places: Vec<[u64; 3]> = mesh.positions().iter().map(|p| p.to_array().map(f64::to_bits)).collect();
    places.sort_unstable();
    let mut hasher = DefaultHasher::new();
    places.hash(&mut hasher);
    hasher.finish()
}
