//! `semireg compare A B`: all measures between two files.

use crate::args::CompareArgs;
use crate::failure::{Failure, Kind};
use crate::figures::Figures;
use crate::load;
use crate::print::{self, Table};
use certify::{MeasureOptions, Reference, SharpEdges};
use serde::Serialize;

#[derive(Serialize)]
struct Comparison {
    a: String,
    b: String,
    /// Triangles of the files that no mesh can hold.
    left_out: [usize; 2],
    #[serde(flatten)]
    figures: Figures,
}

/// Measures B against A, both as they are in their files; connectivity is by position.
pub(crate) fn run(args: &CompareArgs) -> anyhow::Result<()> {
    let [name_a, name_b] = args.stream.two_sources(&args.a, &args.b)?;
    let (a, b) = (load::raw(&name_a)?, load::raw(&name_b)?);
    let [original, remeshed] = [&a.mesh, &b.mesh].map(certify::weld);
    let measured = Reference::new(a.mesh).and_then(|a| certify::measure(&a, &b.mesh, &MeasureOptions::default()));
    let measures = measured.map_err(|e| {
        let message = format!("cannot compare {name_a} with {name_b}: {e}; give files with a surface");
        Failure::new(Kind::Empty, message)
    })?;
    let edge = certify::mean_edge(&remeshed);
    let sharp = SharpEdges::new(&original, edge).cover(&remeshed);
    let comparison = Comparison {
        a: name_a.to_string(),
        b: name_b.to_string(),
        left_out: [a.left_out, b.left_out],
        figures: Figures::new(&measures, |t| t.welded).with_sharp_edges(sharp, edge / original.diagonal()),
    };
    let summary = |figures: &Figures, table: &mut Table| {
        figures.summary(table);
        figures.faults(table);
    };
    print::report(args.talk, &comparison, || comparison.table(summary), || comparison.table(Figures::rows))
}

impl Comparison {
    /// The two files, and the figures as `rows` has them.
    fn table(&self, rows: impl Fn(&Figures, &mut Table)) -> Table {
        let mut table = Table::default();
        table.row("original", &self.a);
        table.row("compared", &self.b);
        rows(&self.figures, &mut table);
        let [in_a, in_b] = self.left_out;
        table.row_if(
            "left out",
            (in_a + in_b > 0).then(|| format!("{in_a} and {in_b} triangles with a vertex that does not exist, or one twice")),
        );
        table
    }
}
