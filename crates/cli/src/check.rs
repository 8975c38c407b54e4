//! `semireg check FILE --levels n`: is it what we promise of a result?

use crate::args::CheckArgs;
use crate::failure::{Failure, Kind};
use crate::figures::{Counts, Shape};
use crate::load;
use crate::print::{self, Table};
use certify::{Certificate, MeasureOptions, Reference};
use semireg::FaceOrder;
use serde::Serialize;

#[derive(Serialize)]
struct Checked {
    file: String,
    passed: bool,
    failures: Vec<String>,
    /// Vertices and faces of every level, the base first.
    levels: Vec<[usize; 2]>,
    topology: Counts,
    #[serde(flatten)]
    shape: Shape,
}

/// Checks the file by itself: subdivision connectivity, counts, manifold, orientation, degenerate triangles.
pub(crate) fn run(args: &CheckArgs) -> anyhow::Result<()> {
    let source = args.stream.source(&args.file)?;
    let file = source.to_string();
    let load::Raw { mesh, left_out } = load::raw(&source)?;
    let mesh = FaceOrder::from(args.order).restored(&mesh, args.levels)?;
    // Certified against itself: what is left is what the mesh says of itself, at the price of a distance that is 0.
    let certificate = Reference::new(mesh.clone())
        .and_then(|itself| certify::certify(&itself, &mesh, args.levels, &MeasureOptions { samples: 1 }))
        .map_err(|e| Failure::new(Kind::Empty, format!("cannot check {file}: {e}; give a file with a surface")))?;
    let checked = report(file, left_out, args.connectivity, &certificate);
    let Some(first) = checked.failures.first() else {
        return print::report(args.talk, &checked, || table(&checked), || table(&checked));
    };
    let message = format!("{} is not a sound mesh of {} subdivision levels: {first}", checked.file, args.levels);
    let hint = "remesh its surface, or tell what it has: its levels (--levels), its order of faces (--order)";
    let failure = Failure::new(Kind::CheckFailed, format!("{message}; {hint}"));
    Err(print::failed(args.talk, &checked, failure, || table(&checked), || table(&checked)))
}

fn report(file: String, left_out: usize, connectivity: bool, certificate: &Certificate) -> Checked {
    let all = certificate.failures();
    let counts = |failure: &&certify::Failure| !(connectivity && matches!(failure, certify::Failure::Degenerate(_)));
    let mut failures: Vec<String> = all.iter().filter(counts).map(ToString::to_string).collect();
    if left_out > 0 {
        failures.push(format!("{left_out} triangles have an index out of range or the same one twice"));
    }
    let levels = certificate.hierarchy.as_ref().map(|h| h.levels.iter().map(|l| [l.vertices, l.faces]).collect());
    Checked {
        file,
        passed: failures.is_empty(),
        failures,
        levels: levels.unwrap_or_default(),
        topology: certificate.measures.remeshed_topology.indexed.into(),
        shape: Shape::from(&certificate.measures.quality),
    }
}

fn table(checked: &Checked) -> Table {
    let mut table = Table::default();
    for (level, [vertices, faces]) in checked.levels.iter().enumerate() {
        table.row(&format!("level {level}"), format!("{vertices} vertices, {faces} faces"));
    }
    table.row("topology", checked.topology.text());
    checked.shape.rows(&mut table);
    for failure in &checked.failures {
        table.row("FAILED", failure);
    }
    table.row_if("passed", checked.passed.then_some("subdivision connectivity, counts, manifold, orientation"));
    table
}
