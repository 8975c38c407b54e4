//! Curvature and gradation together.

use crate::cells::Cells;
use crate::curvature::{arc_curvature, cell_curvature};
use crate::gradation::limit_gradient;
use mesh_core::{IdVec, VertexId};
use region_map::{Sizing, Surface};

/// What the sizing field depends on.
#[derive(Clone, Debug, PartialEq)]
pub struct SizingOptions {
    /// Mean length of a base edge (eq. 3), in the units of the mesh.
    pub edge_length: f64,
    /// The angle in radians that the surface may turn by along an edge; where it turns more, edges are shorter. Default 1.6, a right
    /// angle. Measured on nine models: 1.0 costs .01 to .03 of the mean quality and gains no error on smooth ones; none at all
    /// loses the limbs of spot and doubles the error of the rocker arm.
    pub turn: f64,
    /// Least relative length, above 0 and at most 1. Default 0.5.
    pub least: f64,
    /// Growth of the edge length along the surface, per length. Default 0.3: neighbouring edges differ by at most a third.
    pub gradation: f64,
}

impl SizingOptions {
    /// The defaults at an edge length.
    pub fn new(edge_length: f64) -> Self {
        Self { edge_length, turn: 1.6, least: 0.5, gradation: 0.3 }
    }
}

/// The sizing field of a surface for base edges of a mean length.
pub fn sizing(surface: &Surface<'_>, options: &SizingOptions) -> Sizing {
    let reference = options.turn / options.edge_length;
    let cells = Cells::grow(surface, 0.2 * options.edge_length);
    let curvature = cell_curvature(surface, &cells);
    let mut relative: IdVec<VertexId, f64> = IdVec::filled(1.0, surface.mesh.n_vertices());
    let mut lower = |v: VertexId, curvature: f64| relative[v] = relative[v].min((reference / curvature).max(options.least));
    for (f, vertices) in surface.topology.faces().enumerate() {
        vertices.iter().for_each(|&v| lower(v, curvature[cells.of_face[f] as usize]));
    }
    arc_curvature(surface, options.edge_length).into_iter().for_each(|(v, curvature)| lower(v, curvature));
    limit_gradient(surface, &mut relative, options.gradation / options.edge_length);
    Sizing { relative }
}
