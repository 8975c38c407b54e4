//! What is tried, in which order, until a result passes the certificate.

use crate::base_stages::{BaseStages, base_stages};
use crate::input::Input;
use crate::pipeline::run;
use crate::{Error, Options, Remeshed, StageSeconds};
use mesh_core::equilateral_edge_length;

/// One setting of the stages.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rung {
    /// Factor on the persistence below which creases are left out.
    pub(crate) persistence: f64,
    /// Factor on the wanted number of base vertices.
    pub(crate) base_vertices: f64,
    /// The factor above is on what the corners and arcs of the first rung needed, where that is more.
    pub(crate) as_needed: bool,
    /// The angle in radians that the surface may turn by along a base edge.
    pub(crate) turn: f64,
    /// In plain words, for the report.
    pub(crate) what: &'static str,
}

/// The first rung, and what all others differ from.
const FIRST: Rung = Rung { persistence: 1.0, base_vertices: 1.0, as_needed: false, turn: 1.6, what: "as asked" };

/// Most models pass on the first rung, with one of its base meshes. A crease that was left out may have been needed, or one that was
/// kept may be noise; and what is too coarse for the shape needs more vertices.
const LADDER: [Rung; 5] = [
    FIRST,
    Rung { base_vertices: 1.5, turn: 1.2, what: "with half as many base vertices again", ..FIRST },
    Rung { persistence: 0.4, what: "with more creases", ..FIRST },
    Rung { base_vertices: 2.5, turn: 1.2, as_needed: true, what: "with two and a half times the base vertices", ..FIRST },
    Rung { persistence: 3.0, base_vertices: 1.6, turn: 1.2, as_needed: true, what: "with more base vertices and fewer creases" },
];

/// Once results with this many triangles in all have failed, no further rung is tried. Two cores make about 10,000 triangles a second.
const MOST_FAILED: u64 = 400_000;

/// A result that misses the input by more than this share of a base edge somewhere has lost a part of it. Measured: good results
/// miss by .01 (fandisk) to .16 (casting); a camel without one fold of its mouth by .5.
const LOST: f64 = 0.25;
/// What is smaller than this share of the diagonal is no part. Measured: crank_cse with 1,500 base vertices misses a rim by .008.
const LEAST_LOST: f64 = 0.01;

/// What the climb has come to so far.
#[derive(Default)]
struct Climb {
    warnings: Vec<String>,
    first_failure: Option<Error>,
    /// The result that has lost least, and how much.
    passed: Option<(f64, Remeshed)>,
    /// Triangles of all results so far.
    triangles: u64,
}

/// Tries rung after rung until a result passes the certificate and has lost no part of the input. Of those that only pass, the one
/// that misses least is returned when all rungs are done.
pub(crate) fn climb(input: &Input, options: &Options, seconds: &mut StageSeconds) -> Result<Remeshed, Error> {
    let (mut climb, mut needed) = (Climb::default(), 0);
    'rungs: for rung in &LADDER {
        // The base meshes of large models take long, too.
        if climb.triangles > MOST_FAILED {
            break;
        }
        let candidates = match base_stages(input, options, rung, needed, Some(options.levels), seconds) {
            Ok(candidates) => candidates,
            Err(Error::TooLarge { .. }) if !climb.is_empty() => break,
            Err(e) => {
                climb.fail(rung, e)?;
                continue;
            }
        };
        for stages in candidates {
            if climb.triangles > MOST_FAILED {
                break 'rungs;
            }
            needed = needed.max(stages.base.counts.needed);
            climb.triangles += 4u64.pow(options.levels) * stages.base.mesh.n_faces() as u64;
            match run(&stages, options, seconds) {
                Ok(remeshed) => {
                    if climb.pass(input, options, rung, remeshed) {
                        break 'rungs;
                    }
                }
                Err(e) => climb.fail(rung, e)?,
            }
        }
    }
    climb.end()
}

impl Climb {
    /// Has nothing been tried yet?
    fn is_empty(&self) -> bool {
        self.passed.is_none() && self.first_failure.is_none()
    }

    /// Takes a result that passed the certificate; true if it has lost nothing.
    fn pass(&mut self, input: &Input, options: &Options, rung: &Rung, remeshed: Remeshed) -> bool {
        let missed = remeshed.report.certificate.measures.distance.worse().max;
        let lost = missed * input.cleaned.mesh.diagonal() / base_edge_length(input, &remeshed);
        // Of a base mesh alone every chord misses something.
        let is_whole = lost <= LOST || missed <= LEAST_LOST || options.levels == 0;
        if !is_whole {
            self.warnings.push(format!("{} it misses the input by {lost:.2} base edges somewhere", rung.what));
        }
        if is_whole || self.passed.as_ref().is_none_or(|(least, _)| lost < *least) {
            self.passed = Some((lost, remeshed));
        }
        is_whole
    }

    /// Takes a failure; returns it where no other rung can help.
    fn fail(&mut self, rung: &Rung, error: Error) -> Result<(), Error> {
        if !matches!(error, Error::NotCertified(_) | Error::Folded { .. } | Error::Base(_)) {
            return Err(error);
        }
        self.warnings.push(format!("{} it was tried and failed: {error}", rung.what));
        self.first_failure.get_or_insert(error);
        Ok(())
    }

    fn end(mut self) -> Result<Remeshed, Error> {
        let Some((_, mut remeshed)) = self.passed.take() else { return Err(self.failure()) };
        remeshed.report.warnings = [self.warnings, remeshed.report.warnings].concat();
        Ok(remeshed)
    }

    fn failure(self) -> Error {
        self.first_failure.unwrap_or(Error::NotCertified("nothing was tried".into()))
    }
}

/// Tries rung after rung until there is a base mesh.
pub(crate) fn climb_to_base(input: &Input, options: &Options, seconds: &mut StageSeconds) -> Result<BaseStages, Error> {
    let mut climb = Climb::default();
    for rung in &LADDER {
        match base_stages(input, options, rung, 0, None, seconds).map(|candidates| candidates.into_iter().next()) {
            Ok(Some(mut stages)) => {
                stages.warnings = [climb.warnings, stages.warnings].concat();
                return Ok(stages);
            }
            Ok(None) => {}
            Err(e) => climb.fail(rung, e)?,
        }
    }
    Err(climb.failure())
}

/// The mean length of the edges of the base mesh that was asked for.
fn base_edge_length(input: &Input, remeshed: &Remeshed) -> f64 {
    equilateral_edge_length(input.cleaned.mesh.total_area(), remeshed.report.base.asked)
}
