//! The three rules together.

use crate::cells::Cells;
use crate::curvature::{arc_curvature, cell_curvature};
use crate::gradation::limit_gradient;
use crate::strips::strip_widths;
use mesh_core::{IdVec, VertexId};
use region_map::{Sizing, Surface};

/// What the sizing field depends on.
#[derive(Clone, Debug, PartialEq)]
pub struct SizingOptions {
    /// Mean length of a base edge (eq. 3), in the units of the mesh.
    pub edge_length: f64,
    /// The angle in radians that an edge of mean length turns by where the relative length is 1. Default 1.
    pub turn: f64,
    /// Least and greatest relative length, above 0. Default 0.35 and 1.2.
    pub range: [f64; 2],
    /// Growth of the edge length along the surface, per length. Default 0.3: neighbouring edges differ by at most a third.
    pub gradation: f64,
}

impl SizingOptions {
    /// The defaults at an edge length.
    pub fn new(edge_length: f64) -> Self {
        Self { edge_length, turn: 1.0, range: [0.35, 1.2], gradation: 0.3 }
    }
}

/// A strip of width `w` has the best triangles with edges of `w / 0.87`: two rows of them fill it (design, section 3).
const STRIP: f64 = 1.0 / 0.87;
/// Below the reference curvature, lengths go with its power -1/4: minimising `integral kappa h^2` (the error) at a given
/// `integral h^-2` (the number of vertices) gives `h ~ kappa^(-1/4)`.
const FLAT_POWER: f64 = -0.25;

/// The sizing field of a surface for base edges of a mean length.
pub fn sizing(surface: &Surface<'_>, options: &SizingOptions) -> Sizing {
    let [least, greatest] = options.range;
    let reference = options.turn / options.edge_length;
    let length = |curvature: f64| {
        let ratio = curvature / reference;
        if ratio > 1.0 { ratio.recip() } else { ratio.max(1e-6).powf(FLAT_POWER) }
    };
    let cells = Cells::grow(surface, 0.2 * options.edge_length);
    let curvature = cell_curvature(surface, &cells);
    let mut relative: IdVec<VertexId, f64> = IdVec::filled(greatest, surface.mesh.n_vertices());
    let mut lower = |v: VertexId, h: f64| relative[v] = relative[v].min(h.clamp(least, greatest));
    for (f, vertices) in surface.topology.faces().enumerate() {
        let h = length(curvature[cells.of_face[f] as usize]);
        vertices.iter().for_each(|&v| lower(v, h));
    }
    for (v, curvature) in arc_curvature(surface, options.edge_length) {
        lower(v, length(curvature));
    }
    for (v, width) in strip_widths(surface, options.edge_length * STRIP.recip()) {
        lower(v, width * STRIP / options.edge_length);
    }
    limit_gradient(surface, &mut relative, options.gradation / options.edge_length);
    Sizing { relative }
}
