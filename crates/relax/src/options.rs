//! Options of both parts of the relaxation.

use mesh_core::{FaceId, IdVec, VertexId};

/// How to relax: first the paper's quadric relaxation, then shape optimisation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RelaxOptions {
    /// The paper's relaxation.
    pub quadric: QuadricOptions,
    /// Shape optimisation.
    pub shape: ShapeOptions,
    /// Vertices inside sheets that stay where they are. Those on arcs slide all the same. Default none.
    pub held: Vec<VertexId>,
}

/// The paper's relaxation (section 4.3, eqs. 7 to 9).
#[derive(Clone, Debug, PartialEq)]
pub struct QuadricOptions {
    /// Iterations at most; 0 leaves the part out. Default 10: it only smooths the start of the shape optimisation.
    pub iterations: usize,
    /// Weights of the neighbours. Default uniform.
    pub weights: Weights,
    /// Weight of the distance to the tangent plane against that to the centroid, not negative. Default 1, the paper's.
    pub plane_weight: f64,
    /// Mean quality (AR, 0 to 1) at which to stop: the paper's `T_AR`. Default 1, never reached.
    pub target_quality: f64,
}

impl Default for QuadricOptions {
    fn default() -> Self {
        Self { iterations: 10, weights: Weights::Uniform, plane_weight: 1.0, target_quality: 1.0 }
    }
}

/// Weights of the neighbours in the centroid.
///
/// Measured against the paper's claim, 40 iterations: adaptive weights make areas more even and shapes worse (AR and area
/// variation, uniform to adaptive: octahedron .976 to .974, .27 to .27; kitten .952 to .924, .27 to .21; rabbit .804 to .796, .51
/// to .47). So uniform is the default.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weights {
    /// All 1 (section 4.3.1).
    Uniform,
    /// The cube of the valence, diffused over vertices of valence 6 (section 4.3.2, corrected).
    Adaptive,
}

/// Shape optimisation of the finest level.
#[derive(Clone, Debug, PartialEq)]
pub struct ShapeOptions {
    /// Newton steps at most while triangles are inverted; 0 leaves untangling out. Default 60.
    pub untangling_steps: usize,
    /// Newton steps at most once none is; 0 leaves the part out. Default 30.
    pub steps: usize,
    /// Power of the shape term, 1 or more: more lifts the worst triangles at the cost of the mean. Default 2.
    pub power: f64,
    /// Weight of the size term against the shape term, not negative. Default 0.02.
    ///
    /// Shape is bought with size. Measured from 0.02 to 0.1 on seven starts: the mean AR falls by .001 to .018 (most on a rocker
    /// arm, .960 to .942), greatest over least area mostly halves, the mean error falls by 1 to 4 %. Where the error has grown
    /// much (rabbit from a QEM base, 6.0e-5 of the diagonal to 13.7e-5) only 1 and more brings it back, at AR .909.
    pub size_weight: f64,
    /// The areas wanted.
    pub target: TargetArea,
    /// Stop after three steps in a row that each lower the energy, as far as it exceeds its least value, by less than this share.
    /// Default 1e-3.
    pub tolerance: f64,
}

impl Default for ShapeOptions {
    fn default() -> Self {
        Self { untangling_steps: 60, steps: 30, power: 2.0, size_weight: 0.02, target: TargetArea::SheetMean, tolerance: 1e-3 }
    }
}

/// The areas that the triangles of the finest level shall have.
#[derive(Clone, Debug, PartialEq)]
pub enum TargetArea {
    /// The mean over each sheet at the start.
    SheetMean,
    /// Given for every face of the domain, positive; only ratios inside a sheet matter much.
    PerFace(IdVec<FaceId, f64>),
}
