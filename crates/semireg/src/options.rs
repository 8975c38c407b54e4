//! What a user may choose.

use crate::{Method, Relaxation};
use glam::DVec3;
use mesh_core::{CleanOptions, Soup};

/// Options of the whole pipeline. Everything has a default that works.
#[derive(Clone, Debug)]
pub struct Options {
    /// Wanted number of base vertices. `None` takes three times what corners and curves need, at least 1,000 and at least 1.6 % of the cleaned
    /// input's vertices, at most 2,000; where `levels` is `None`, too, and the shape takes more, up to 12,000, split once.
    pub base_vertices: Option<usize>,
    /// The distance between result and input that is accepted, as a share of the diagonal of the input's box: where it is greater, the base mesh
    /// gets more vertices, also where their number was asked for. `None`, the default, accepts .0025 or a quarter of a finest edge, and keeps
    /// to a number of base vertices that was asked for.
    pub max_distance: Option<f64>,
    /// A base mesh to take instead of one of our own: its vertices and faces keep their order, and `base_vertices` is not asked. It must be
    /// an oriented manifold of the topology of the cleaned input. Default `None`.
    ///
    /// Creases that its edges don't follow are given up as minor. If its edges cannot be traced on the surface, vertices are placed by rays.
    /// Warnings say so. There is one attempt, and nothing of the base mesh is changed.
    pub base_mesh: Option<Soup>,
    /// How base meshes are made. Default [`Method::Best`].
    pub method: Method,
    /// How a base mesh becomes the finest level. Default [`Relaxation::Shape`].
    pub relaxation: Relaxation,
    /// How often every base face is split in four, 0 to 8. `None`, the default, splits them twice; or once where no number of base vertices is
    /// asked for and the shape takes very many.
    pub levels: Option<u32>,
    /// For every vertex of the input, in its order, a number above 0 that the base vertices per area are proportional to, beside what curvature
    /// asks for. Edges get at most 10 times longer or shorter by it. Default `None`.
    pub density: Option<Vec<f64>>,
    /// How fast the lengths of base edges change along the surface, per length, not negative: with 0 they are the same everywhere. Default
    /// 0.3: neighbouring edges differ by at most a third.
    pub gradation: f64,
    /// Seed of all that is chosen at random. Default 0.
    pub seed: u64,
    /// Cleaning.
    pub clean: CleanOptions,
    /// Creases and corners.
    pub features: features::FeatureOptions,
    /// Edges that are kept whatever their angle, by the positions of their ends: vertices of the input, to a millionth of its diagonal.
    pub marked_edges: Vec<[DVec3; 2]>,
    /// Relaxation and shape optimisation.
    pub relax: relax::RelaxOptions,
    /// Projection.
    pub project: project::ProjectOptions,
    /// Fit of the relaxed mesh; `None` leaves its vertices on the surface.
    pub fit: Option<fit::FitOptions>,
}

/// Strips that are narrower than this share of an edge of the finest level are rounded creases. Measured: with 1, fillets that the finest level can
/// follow have a crease in their middle, and the errors of casting and conrod are greater by a quarter.
const ROUNDED: f64 = 0.5;

/// Levels at most.
pub const MAX_LEVELS: u32 = 8;

/// Levels where nothing asks for others.
pub const USUAL_LEVELS: u32 = 2;

impl Options {
    /// How often every base face is split in four.
    pub(crate) fn levels(&self) -> u32 {
        self.levels.unwrap_or(USUAL_LEVELS)
    }

    /// What counts as a feature on a base mesh with edges of this length.
    pub(crate) fn feature_options(&self, base_edge_length: f64) -> features::FeatureOptions {
        let rounded_width = ROUNDED * base_edge_length * 0.5f64.powi(self.levels() as i32);
        features::FeatureOptions { rounded_width, ..self.features.clone() }
    }

    /// The distance that is accepted where edges have this mean length; all in the units of the input.
    pub(crate) fn accepted_distance(&self, diagonal: f64, mean_edge: f64) -> f64 {
        self.max_distance.map_or_else(|| certify::accepted_distance(diagonal, mean_edge), |share| share * diagonal)
    }
}

impl Default for Options {
    fn default() -> Self {
        Self {
            base_vertices: None,
            max_distance: None,
            base_mesh: None,
            method: Method::default(),
            relaxation: Relaxation::default(),
            levels: None,
            density: None,
            gradation: 0.3,
            seed: 0,
            clean: CleanOptions::default(),
            features: features::FeatureOptions::default(),
            marked_edges: Vec::new(),
            relax: relax::RelaxOptions::default(),
            project: project::ProjectOptions::default(),
            fit: Some(fit::FitOptions::default()),
        }
    }
}
