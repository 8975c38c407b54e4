//! [`Input`]: cleaned, refined and ready to be measured against.

use super::density::length_factors;
use super::given::GivenBase;
use super::marked::marked_edges;
use super::size::default_size;
use crate::run::Run;
use crate::{Error, Options, Split};
use certify::Reference;
use mesh_core::{Cleaned, FaceId, IdVec, Soup, VertexId, equilateral_edge_length};
use refine::{RefineOptions, Refined};
use region_map::{ArcKind, Network, Surface};
use std::sync::Arc;

/// What all attempts run on.
pub(crate) struct Input {
    /// The soup with its repairs.
    pub(crate) cleaned: Arc<Cleaned>,
    /// The certificate's view of it.
    pub(crate) reference: Reference,
    /// The working mesh: the same surface in triangles that are not in the way. Its only arcs are its borders, until features are detected.
    pub(crate) working: Surface,
    /// For every face of the working mesh the face of the cleaned mesh that it lies in.
    pub(crate) source_face: Arc<IdVec<FaceId, FaceId>>,
    /// The user's marked edges in the working mesh, and those along which its sheets touch.
    pub(crate) marked: Vec<[VertexId; 2]>,
    /// Factors on the lengths of base edges at the vertices of the working mesh, where the user gives a density.
    pub(crate) length_factors: Option<IdVec<VertexId, f64>>,
    /// The base mesh that the options give, if they do.
    pub(crate) given: Option<GivenBase>,
    /// Base vertices asked for.
    pub(crate) asked: usize,
    /// Levels.
    pub(crate) levels: u32,
}

/// Edges of the working mesh are at most this share of a base edge.
const LONGEST_EDGE: f64 = 0.5;
/// And at least this share where the shape lets them: a twenty-fifth of an edge of level 3. Measured, arcs that made a result fail: .001 to
/// .004 (mike_box, pyvi_42400, prus_extruder_idler).
const SHORTEST_EDGE: f64 = 5e-3;

impl Input {
    /// Cleans and refines a soup.
    pub(crate) fn new(soup: &Soup, options: &Options, run: &mut Run) -> Result<Self, Error> {
        let given = options.base_mesh.as_ref().map(GivenBase::new).transpose()?;
        let interrupt = run.interrupt().clone();
        let cleaned = run.stage("clean", || mesh_core::clean_until(soup, &options.clean, &interrupt))?;
        let mut marked = marked_edges(&cleaned, &options.marked_edges)?;
        marked.extend(features::touching_edges(&cleaned.mesh, &cleaned.topology)?);
        let usual = |base_vertices| Split { base_vertices, levels: options.levels() };
        let Split { base_vertices: asked, levels } = match (&given, options.base_vertices) {
            (Some(base), _) => usual(base.mesh.n_vertices()),
            (None, Some(asked)) => usual(asked),
            (None, None) => run.stage("features", || default_size(&cleaned, &marked, options))?,
        };
        let base_edge = equilateral_edge_length(cleaned.mesh.total_area(), asked);
        let refine_options = RefineOptions {
            shortest_edge: SHORTEST_EDGE * base_edge,
            crease_angle: options.features.strong_angle,
            ..RefineOptions::new(LONGEST_EDGE * base_edge)
        };
        let refined = run.stage("refine", || refine::refine(&cleaned.mesh, &cleaned.topology, &marked, &refine_options))?;
        let Refined { mesh, topology, marked, source_face, .. } = refined;
        let density = options.density.as_ref();
        let length_factors =
            density.map(|density| length_factors(density, soup.positions.len(), &cleaned, &mesh, &source_face)).transpose()?;
        let borders = ArcKind::by_angle(&mesh, &topology, f64::INFINITY);
        let network = Network::trace(&mesh, &topology, &borders, |_| false, Vec::new())?;
        let working = Surface::new(mesh, topology, network)?.with_interrupt(interrupt.clone());
        let reference = Reference::new(cleaned.mesh.clone())?.with_interrupt(interrupt);
        let (cleaned, source_face) = (Arc::new(cleaned), Arc::new(source_face));
        Ok(Self { cleaned, reference, working, source_face, marked, length_factors, given, asked, levels })
    }

    /// The mean edge length of the base mesh that was asked for.
    pub(crate) fn base_edge_length(&self) -> f64 {
        equilateral_edge_length(self.cleaned.mesh.total_area(), self.asked)
    }
}
