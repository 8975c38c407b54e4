//! From a goal to a result.

use super::search::{Make, Search};
use super::sized::{Measure, Wanted};
use super::split::Extent;
use super::target::{Goal, Target};
use crate::remeshed::Remeshed;
use crate::{Error, Options};
use mesh_core::Cleaned;

/// Makes results with options of different sizes, until one is as the goal asks. `cleaned` is what all are made of.
pub(crate) fn reached(cleaned: &Cleaned, goal: &Goal, options: &Options, make: &mut Make) -> Result<Remeshed, Error> {
    goal.target.check()?;
    let mut search = Search::new(Extent::of(cleaned), goal.levels, options, make);
    let mut remeshed = match goal.target {
        Target::Vertices(n) => search.sized(&Wanted { measure: Measure::Vertices, amount: n as f64 }),
        Target::Triangles(n) => search.sized(&Wanted { measure: Measure::Triangles, amount: n as f64 }),
        Target::EdgeLength(length) => search.sized(&Wanted { measure: Measure::EdgeLength, amount: length }),
        Target::MaxError(share) => search.within(share),
        Target::MaxErrorLength(length) => search.within(length / cleaned.mesh.diagonal()),
    }?;
    remeshed.report.sizes = search.end();
    Ok(remeshed)
}
