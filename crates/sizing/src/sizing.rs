//! Curvature and gradation together.

use crate::cells::Cells;
use crate::curvature::{arc_curvature, cell_curvature};
use crate::gradation::limit_gradient;
use mesh_core::{IdVec, VertexId};
use region_map::{Sizing, Surface};

/// What the sizing field depends on.
#[derive(Clone, Debug, PartialEq)]
pub struct SizingOptions {
    /// Mean length of a base edge (eq. 3), in the units of the mesh, finite and above 0.
    pub edge_length: f64,
    /// The angle in radians, above 0, that the surface may turn by along an edge; where it turns more, edges are shorter. Default 1.6, a
    /// right angle. Measured on nine models: 1.0 costs .01 to .03 of the mean quality and gains no error on smooth ones; none at all
    /// loses the limbs of the cow *spot* and doubles the error of the rocker arm.
    pub turn: f64,
    /// Where the surface turns by this angle in radians along an edge, edges have their mean length; where it turns less they are longer,
    /// where it turns more they are shorter, by the fourth root: the error of a triangle grows as curvature times squared edge length,
    /// their number as the inverse square, so the sum of errors is least where `h^4` goes with the inverse curvature. Above 0; default 0.2.
    pub neutral_turn: f64,
    /// By that rule edges are longer and shorter by this factor at most, finite and at least 1; 1 leaves the rule out. It is also the
    /// greatest relative length that there is. Default 1.2. Measured on 14 models: the mean error of CAD models falls by
    /// 10 to 23 % (fandisk 1.43 to 1.21, block 1.65 to 1.41, joint 3.10 to 2.38, in 1e-5), that of smooth ones hardly changes; the mean
    /// quality changes by chance (-.022 to +.009). With 1.3 and the square root fandisk comes to 1.12, and loses .008 of quality.
    pub range: f64,
    /// Least relative length that `turn` leads to, above 0 and at most 1. Default 0.5.
    pub least: f64,
    /// Growth of the edge length along the surface, per length, not negative; infinite sets no limit. Default 0.3: neighbouring edges differ by at most a third.
    pub gradation: f64,
}

impl SizingOptions {
    /// The defaults at an edge length.
    pub fn new(edge_length: f64) -> Self {
        Self { edge_length, turn: 1.6, neutral_turn: 0.2, range: 1.2, least: 0.5, gradation: 0.3 }
    }
}

/// Why there is no sizing field: an option is out of its range.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("sizing option {option} is {value}, it must be {range}")]
pub struct SizingError {
    /// The name of the option.
    pub option: &'static str,
    /// Its value.
    pub value: f64,
    /// What it may be.
    pub range: &'static str,
}

impl SizingOptions {
    /// Checks the ranges.
    fn check(&self) -> Result<(), SizingError> {
        let Self { edge_length, turn, neutral_turn, range, least, gradation } = *self;
        let rules = [
            ("edge_length", edge_length, edge_length.is_finite() && edge_length > 0.0, "finite and above 0"),
            ("turn", turn, turn > 0.0, "above 0"),
            ("neutral_turn", neutral_turn, neutral_turn > 0.0, "above 0"),
            ("range", range, range.is_finite() && range >= 1.0, "finite and at least 1"),
            ("least", least, least > 0.0 && least <= 1.0, "above 0 and at most 1"),
            ("gradation", gradation, gradation >= 0.0, "at least 0"),
        ];
        match rules.into_iter().find(|&(_, _, is_kept, _)| !is_kept) {
            Some((option, value, _, range)) => Err(SizingError { option, value, range }),
            None => Ok(()),
        }
    }
}

/// Radius of the cells that curvature is measured between, in edge lengths. Smaller cells see the noise of a scan, larger ones miss
/// limbs that are thinner than an edge.
const CELL_RADIUS: f64 = 0.2;

/// The sizing field of a surface for base edges of a mean length: relative lengths from the least of `least` and `1 / range`, to `range`.
///
/// Fails where an option is out of its range.
pub fn sizing(surface: &Surface, options: &SizingOptions) -> Result<Sizing, SizingError> {
    sizing_with(surface, None, options)
}

/// The same, with lengths that the user asks for: at every vertex of the surface, in order, a finite factor above 0 on what the shape asks for there. Beyond the range
/// of those factors the field keeps to the gradation.
///
/// Fails where an option is out of its range.
pub fn sizing_with(
    surface: &Surface,
    factors: Option<&IdVec<VertexId, f64>>,
    options: &SizingOptions,
) -> Result<Sizing, SizingError> {
    options.check()?;
    let cells = Cells::grow(surface, CELL_RADIUS * options.edge_length);
    let curvature = cell_curvature(surface, &cells);
    let mut relative: IdVec<VertexId, f64> = IdVec::filled(options.range, surface.mesh().n_vertices());
    let mut lower = |v: VertexId, curvature: f64| relative[v] = relative[v].min(wanted(curvature * options.edge_length, options));
    for (f, vertices) in surface.topology().faces().enumerate() {
        vertices.iter().for_each(|&v| lower(v, curvature[cells.of_face[f] as usize]));
    }
    arc_curvature(surface, options.edge_length).into_iter().for_each(|(v, curvature)| lower(v, curvature));
    if let Some(factors) = factors {
        relative.iter_mut().zip(factors.iter()).for_each(|(length, factor)| *length *= factor);
    }
    limit_gradient(surface, &mut relative, options.gradation / options.edge_length);
    Ok(Sizing { relative })
}

/// The relative length of an edge along which the surface would turn by an angle, were it of mean length.
fn wanted(turn: f64, options: &SizingOptions) -> f64 {
    let even = (options.neutral_turn / turn).sqrt().sqrt().clamp(1.0 / options.range, options.range);
    even.min(options.turn / turn).max(options.least)
}
