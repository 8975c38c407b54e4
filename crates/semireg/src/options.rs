//! What a user may choose.

use crate::Method;
use glam::DVec3;
use mesh_core::{CleanOptions, Soup};

/// Options of the whole pipeline. Everything has a default that works.
#[derive(Clone, Debug)]
pub struct Options {
    /// Wanted number of base vertices. `None` takes three times what corners and curves need, at least 1,000 and at least 1.6 % of the cleaned
    /// input's vertices, at most 2,000.
    pub base_vertices: Option<usize>,
    /// A base mesh to take instead of one of our own: its vertices and faces keep their order, and `base_vertices` is not asked. It must be
    /// an oriented manifold of the topology of the cleaned input. Default `None`.
    ///
    /// Creases that its edges don't follow are given up as minor. If its edges cannot be traced on the surface, vertices are placed by rays.
    /// Warnings say so. There is one attempt, and nothing of the base mesh is changed.
    pub base_mesh: Option<Soup>,
    /// How the result is made: which ways to a base mesh are gone, or all of it as the paper prints it. Default [`Method::Best`].
    pub method: Method,
    /// How often every base face is split in four, 0 to 8. Default 2.
    pub levels: u32,
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

impl Default for Options {
    fn default() -> Self {
        Self {
            base_vertices: None,
            base_mesh: None,
            method: Method::default(),
            levels: 2,
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
