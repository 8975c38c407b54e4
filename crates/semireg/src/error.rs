//! Why there is no result: the stage that failed, and its own error.

use crate::verdict::Verdict;

/// The error of a stage. Every message says what is wrong, where, and what to do.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The caller ended the run.
    #[error("cancelled")]
    Cancelled,
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
    /// The network is of another mesh: a bug of ours.
    #[error("internal error in the working mesh: {0}; please report this with the input file")]
    Network(#[from] region_map::NetworkError),
    /// The refined mesh is no surface: a bug of ours.
    #[error("internal error in the working mesh: {0}; please report this with the input file")]
    Surface(#[from] region_map::SurfaceError),
    /// Sizing options don't fit.
    #[error(transparent)]
    Sizing(#[from] sizing::SizingError),
    /// The working mesh has no proxy, or what was made on it cannot be brought back: a bug of ours.
    #[error("internal error in the proxy of the working mesh: {0}; please report this with the input file")]
    Proxy(#[from] proxy::ProxyError),
    /// Segmentation failed.
    #[error(transparent)]
    Segment(#[from] segment_vsa::VsaError),
    /// Patches could not be split: a bug of ours.
    #[error("internal error in the segmentation: {0}; please report this with the input file")]
    Split(#[from] segment_vsa::SplitError),
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
         for fewer levels, or for that many base vertices if you mean it (at most {} triangles)",
        crate::MAX_TRIANGLES
    )]
    TooLarge {
        /// Vertices of the base mesh, or those that any base mesh needs.
        base_vertices: usize,
        /// Triangles of the finest level on it.
        triangles: u64,
    },
    /// A goal that no result can reach.
    #[error("the {name} that is asked for is {value}; it must be finite and above 0, and a number at least 4")]
    NoGoal {
        /// What is asked for.
        name: &'static str,
        /// How much of it.
        value: f64,
    },
    /// No result keeps to the greatest error.
    #[error(
        "no result keeps within {error:e} of the diagonal: the nearest one that was tried is {nearest:e} away somewhere; allow a greater error"
    )]
    NotWithin {
        /// The greatest error, as a share of the diagonal.
        error: f64,
        /// The least one that was reached; infinite where no result was certified.
        nearest: f64,
    },
    /// A density that is not one for each vertex.
    #[error("the density has {values} values, the input has {vertices} vertices; give one value for each, in their order")]
    DensityCount {
        /// How many there are.
        values: usize,
        /// How many there should be.
        vertices: usize,
    },
    /// A density that is none.
    #[error("the density of vertex {vertex} (counted from 0) is {value}; it must be finite and above 0")]
    Density {
        /// The vertex of the input, from 0.
        vertex: usize,
        /// Its density.
        value: f64,
    },
    /// Subdivision failed.
    #[error(transparent)]
    Subdivide(#[from] subdiv::SubdivError),
    /// Projection failed.
    #[error(transparent)]
    Project(#[from] project::ProjectError),
    /// The search for better connectivity failed.
    #[error(transparent)]
    Reconnect(#[from] reconnect::ReconnectError),
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
        "{folded} of {triangles} triangles would face against the surface or have no area: the base mesh is too coarse for its shape; ask \
         for more base vertices, or split the input into its parts"
    )]
    Folded {
        /// Triangles that face against the surface or have no area.
        folded: usize,
        /// Triangles in all.
        triangles: usize,
    },
    /// Nothing is left of a given base mesh after cleaning.
    #[error("the base mesh cannot be used: {0}")]
    CleanBase(mesh_core::CleanError),
    /// A given base mesh is not manifold.
    #[error(
        "the base mesh is not an oriented manifold ({edges} edges where more than two triangles meet or sides change, {vertices} \
         vertices where surfaces touch); repair it, or give none"
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
         none"
    )]
    BaseNotCertified {
        /// What failed.
        failure: String,
        /// Why the base mesh has no map; empty where it has one.
        untraced: String,
    },
    /// The finished mesh did not pass the certificate.
    #[error("the result is not certified: {0}; ask for more base vertices or fewer levels")]
    NotCertified(String),
}

impl Error {
    /// What a try comes to that ends with this error.
    pub(crate) fn verdict(&self) -> Verdict {
        match *self {
            Self::Folded { folded, triangles } => Verdict::Faulty { faults: folded, triangles },
            _ => Verdict::Failed { reason: self.to_string() },
        }
    }

    /// Whether it is a fault of ours, which the user cannot help.
    pub(crate) fn is_internal(&self) -> bool {
        match self {
            Self::Cancelled
            | Self::Clean(_)
            | Self::Features(_)
            | Self::MarkedEdge { .. }
            | Self::Base(_)
            | Self::TooLarge { .. }
            | Self::Folded { .. }
            | Self::NoGoal { .. }
            | Self::DensityCount { .. }
            | Self::Density { .. }
            | Self::NotWithin { .. }
            | Self::CleanBase(_)
            | Self::BaseNotManifold { .. }
            | Self::Trace(_)
            | Self::BaseNotCertified { .. }
            | Self::NotCertified(_) => false,
            Self::Refine(_)
            | Self::Surface(_)
            | Self::Network(_)
            | Self::Sizing(_)
            | Self::Proxy(_)
            | Self::Segment(_)
            | Self::Split(_)
            | Self::Cells(_)
            | Self::Sample(_)
            | Self::Subdivide(_)
            | Self::Project(_)
            | Self::Reconnect(_)
            | Self::Measure(_)
            | Self::Relax(_)
            | Self::Fit(_)
            | Self::Snap(_) => true,
        }
    }

    /// The message, with a request to report it where it is a fault of ours.
    pub(crate) fn with_request(&self) -> String {
        const REQUEST: &str = "please report this";
        let message = self.to_string();
        if self.is_internal() && !message.contains(REQUEST) {
            format!("{message}; {REQUEST} with the input file")
        } else {
            message
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fault_of_ours_asks_for_a_report_once() {
        let fault = Error::Fit(fit::FitError::NoFace(mesh_core::FaceId(7)));
        assert!(fault.is_internal() && fault.with_request().ends_with("please report this with the input file"));
        let asking = Error::Cells(region_map::CellError::OtherMesh);
        assert_eq!(asking.with_request(), asking.to_string());
        assert!(!Error::Cancelled.is_internal());
        let folded = Error::Folded { folded: 1, triangles: 9 };
        assert_eq!(folded.with_request(), folded.to_string());
    }
}
