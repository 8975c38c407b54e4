//! `semireg compare A B`: all measures between two files.

use crate::args::CompareArgs;
use crate::figures::Figures;
use crate::load;
use crate::print::{self, Table};
use certify::MeasureOptions;
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
    let (a, b) = (load::raw(&args.a)?, load::raw(&args.b)?);
    let measures = certify::measure(&a.mesh, &b.mesh, &MeasureOptions::default()).map_err(|e| {
        anyhow::anyhow!("cannot compare {} with {}: {e}; give files with a surface", args.a.display(), args.b.display())
    })?;
    let comparison = Comparison {
        a: args.a.display().to_string(),
        b: args.b.display().to_string(),
        left_out: [a.left_out, b.left_out],
        figures: Figures::new(&measures, |t| t.welded),
    };
    if args.json {
        return print::json(&comparison);
    }
    let mut table = Table::default();
    table.row("original", &comparison.a);
    table.row("compared", &comparison.b);
    comparison.figures.rows(&mut table);
    let [in_a, in_b] = comparison.left_out;
    table.row_if("left out", (in_a + in_b > 0).then(|| format!("{in_a} and {in_b} triangles that are none")));
    table.print()
}
