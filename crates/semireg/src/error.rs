//! Why there is no result: the stage that failed, and its own error.

/// The error of a stage. Every message says what is wrong, where, and what to do.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// Nothing is left after cleaning.
    #[error(transparent)]
    Clean(#[from] mesh_core::CleanError),
    /// Feature options don't fit.
    #[error(transparent)]
    Features(#[from] features::FeatureError),
    /// A marked edge is none of the mesh.
    #[error(
        "marked edge {number} from {from:?} to {to:?} is no edge of the cleaned input; mark edges between its vertices, whose \
         positions are kept"
    )]
    MarkedEdge {
        /// Which one, counted from 1.
        number: usize,
        /// Where it starts.
        from: [f64; 3],
        /// Where it ends.
        to: [f64; 3],
    },
    /// Refining broke the mesh.
    #[error(transparent)]
    Refine(#[from] refine::RefineError),
    /// Segmentation failed.
    #[error(transparent)]
    Segment(#[from] segment_vsa::VsaError),
    /// The segmentation is not a complex of disks: a bug of ours.
    #[error("internal error in the segmentation: {0}; please report this with the input file")]
    Cells(#[from] region_map::CellError),
    /// Sampling failed.
    #[error(transparent)]
    Sample(#[from] segment_cvt::CvtError),
    /// No base mesh.
    #[error(transparent)]
    Base(#[from] basemesh::BaseError),
    /// The finest level would be too large.
    #[error(
        "the result would have {triangles} triangles or more, as corners, creases and shape take at least {base_vertices} base vertices; ask \
         for fewer levels (--levels), or for that many base vertices if you mean it (--base-vertices, at most {} triangles)",
        crate::MAX_TRIANGLES
    )]
    TooLarge {
        /// Vertices of the base mesh, or those that any base mesh needs.
        base_vertices: usize,
        /// Triangles of the finest level on it.
        triangles: u64,
    },
    /// Subdivision failed.
    #[error(transparent)]
    Subdivide(#[from] subdiv::SubdivError),
    /// Projection failed.
    #[error(transparent)]
    Project(#[from] project::ProjectError),
    /// The subdivided mesh is not manifold: a bug of ours.
    #[error("internal error in the subdivision: {0}; please report this with the input file")]
    Topology(#[from] mesh_core::TopologyError),
    /// The result could not be measured.
    #[error(transparent)]
    Measure(#[from] certify::MeasureError),
    /// Relaxation failed.
    #[error(transparent)]
    Relax(#[from] relax::RelaxError),
    /// The fit failed.
    #[error(transparent)]
    Fit(#[from] fit::FitError),
    /// Snapping to minor creases failed.
    #[error(transparent)]
    Snap(#[from] snap::SnapError),
    /// So much of the result is folded that a certificate is not worth its time.
    #[error(
        "{inverted} of {faces} triangles would face against the surface: the base mesh is too coarse for its shape; ask for more base \
         vertices (--base-vertices), or split the file into its parts"
    )]
    Folded {
        /// Triangles that face against the surface.
        inverted: usize,
        /// Triangles in all.
        faces: usize,
    },
    /// Nothing is left of a given base mesh after cleaning.
    #[error("the base mesh cannot be used: {0}")]
    CleanBase(mesh_core::CleanError),
    /// A given base mesh is not manifold.
    #[error(
        "the base mesh is not an oriented manifold ({edges} edges where more than two triangles meet or sides change, {vertices} \
         vertices where surfaces touch); repair it, or leave --base out"
    )]
    BaseNotManifold {
        /// Edges of more than two triangles or of contradicting orientation.
        edges: usize,
        /// Vertices of several fans.
        vertices: usize,
    },
    /// A given base mesh does not fit the input.
    #[error(transparent)]
    Trace(#[from] trace_base::TraceError),
    /// The finished mesh on a given base mesh did not pass the certificate.
    #[error(
        "the result on the given base mesh is not certified: {failure}{untraced}; give a finer base mesh with better triangles, or \
         leave --base out"
    )]
    BaseNotCertified {
        /// What failed.
        failure: String,
        /// Why the base mesh has no map; empty where it has one.
        untraced: String,
    },
    /// The finished mesh did not pass the certificate.
    #[error("the result is not certified: {0}; ask for more base vertices (--base-vertices) or fewer levels")]
    NotCertified(String),
}
