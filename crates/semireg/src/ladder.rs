//! What is tried, in which order, until a result passes the certificate.

use crate::base_stages::{BaseStages, Input, base_stages, mean_edge_length};
use crate::pipeline::{finest_triangles, run};
use crate::{Error, Options, Remeshed, StageSeconds};

/// One way to run the stages.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rung {
    /// Factor on the persistence below which creases are left out.
    pub(crate) persistence: f64,
    /// Factor on the wanted number of base vertices.
    pub(crate) base_vertices: f64,
    /// The factor above is on what the corners and arcs of the first rung needed, where that is more.
    pub(crate) as_needed: bool,
    /// Sites a base vertex: the first base mesh is that much finer, and then coarsened in its map.
    pub(crate) sites: f64,
    /// The angle in radians that the surface may turn by along a base edge.
    pub(crate) turn: f64,
    /// In plain words, for the report.
    pub(crate) what: &'static str,
}

/// The first rung, and what all others differ from.
const FIRST: Rung = Rung { persistence: 1.0, base_vertices: 1.0, as_needed: false, sites: 2.0, turn: 1.6, what: "as asked" };

/// Most models pass on the first rung. Another start of the base mesh may fold less; a crease that was left out may have been needed,
/// or one that was kept may be noise; and what is too coarse for the shape needs more vertices.
const LADDER: [Rung; 8] = [
    FIRST,
    Rung { sites: 4.0, what: "from a finer start", ..FIRST },
    Rung { sites: 3.0, what: "from another start", ..FIRST },
    Rung { persistence: 3.0, turn: 1.2, what: "with fewer creases and shorter edges where the surface bends", ..FIRST },
    Rung { persistence: 0.4, sites: 1.0, what: "with more creases", ..FIRST },
    Rung { base_vertices: 1.25, what: "with a quarter more base vertices", ..FIRST },
    Rung {
        persistence: 3.0,
        base_vertices: 1.6,
        turn: 1.2,
        as_needed: true,
        what: "with more base vertices and fewer creases",
        ..FIRST
    },
    Rung { base_vertices: 2.5, turn: 1.2, as_needed: true, what: "with two and a half times the base vertices", ..FIRST },
];

/// Once rungs of the ladder with this many triangles in all have failed, no further one is tried. Two cores make
/// 9,000 (mech-holes-shark, six rungs) to 15,000 triangles (fandisk) a second, so this is about a minute, and then the last rung's own.
const MOST_FAILED: u64 = 300_000;
/// So many results that are folded for the most part end the climb: untangling them takes longest, and none was ever mended by a later
/// rung (office_chair, DamagedHelmet, 2CylinderEngine).
const MOST_FOLDED: usize = 1;

/// A result that misses the input by more than this share of a base edge somewhere has lost a part of it. Measured: good results
/// miss by .01 (fandisk) to .16 (casting); a camel without one fold of its mouth by .5.
const LOST: f64 = 0.25;

/// Tries rung after rung until a result passes the certificate and has lost no part of the input. Of those that only pass, the one
/// that misses least is returned when all rungs are done.
pub(crate) fn climb(input: &Input, options: &Options, seconds: &mut StageSeconds) -> Result<Remeshed, Error> {
    let (mut warnings, mut first_failure, mut passed) = (Vec::new(), None, None);
    let (mut triangles, mut needed, mut folded) = (0, 0, 0);
    for rung in &LADDER {
        if triangles > MOST_FAILED || folded >= MOST_FOLDED {
            break;
        }
        let result = base_stages(input, options, rung, needed, seconds).and_then(|stages| {
            triangles += finest_triangles(&stages, options.levels)?;
            needed = needed.max(stages.base.counts.needed);
            run(stages, options, seconds)
        });
        match result {
            Ok(remeshed) => {
                let lost = lost_length(input, &remeshed);
                if lost <= LOST {
                    passed = Some((lost, remeshed));
                    break;
                }
                warnings.push(format!("{} it misses the input by {lost:.2} base edges somewhere", rung.what));
                if passed.as_ref().is_none_or(|(least, _)| lost < *least) {
                    passed = Some((lost, remeshed));
                }
            }
            Err(e @ (Error::NotCertified(_) | Error::Folded { .. } | Error::Base(_))) => {
                folded += usize::from(matches!(e, Error::Folded { .. }));
                warnings.push(failed_rung(rung, &e));
                first_failure.get_or_insert(e);
            }
            Err(e) => return Err(e),
        }
    }
    match passed {
        Some((_, mut remeshed)) => {
            warnings.append(&mut remeshed.report.warnings);
            remeshed.report.warnings = warnings;
            Ok(remeshed)
        }
        None => Err(first_failure.unwrap_or(Error::NotCertified("nothing was tried".into()))),
    }
}

/// Tries rung after rung until there is a base mesh.
pub(crate) fn climb_to_base(input: &Input, options: &Options, seconds: &mut StageSeconds) -> Result<BaseStages, Error> {
    let (mut warnings, mut first_failure) = (Vec::new(), None);
    for rung in &LADDER {
        match base_stages(input, options, rung, 0, seconds) {
            Ok(mut stages) => {
                warnings.append(&mut stages.warnings);
                stages.warnings = warnings;
                return Ok(stages);
            }
            Err(e @ Error::Base(_)) => {
                warnings.push(failed_rung(rung, &e));
                first_failure.get_or_insert(e);
            }
            Err(e) => return Err(e),
        }
    }
    Err(first_failure.unwrap_or(Error::NotCertified("nothing was tried".into())))
}

/// The greatest distance between input and result, in mean base edges.
fn lost_length(input: &Input, remeshed: &Remeshed) -> f64 {
    let mesh = &input.cleaned.mesh;
    let base_edge = mean_edge_length(mesh, remeshed.report.base.made);
    remeshed.report.certificate.measures.distance.worse().max * mesh.diagonal() / base_edge
}

/// What the report tells of a rung that failed.
fn failed_rung(rung: &Rung, error: &Error) -> String {
    format!("{} it was tried and failed: {error}", rung.what)
}
