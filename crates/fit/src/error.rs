//! Why a domain cannot be fitted.

use mesh_core::{FaceId, MeshError, VertexId};
use region_map::{RegionMapError, SheetId};

/// Why a domain cannot be fitted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FitError {
    /// An option is out of its range.
    #[error("the option {name} is {value}; it must be from {least} to {most}")]
    Option {
        /// Which.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The least value that it may have.
        least: f64,
        /// The greatest.
        most: f64,
    },
    /// The domain does not fit the surface.
    #[error(transparent)]
    Region(#[from] RegionMapError),
    /// A domain vertex of one sheet sits on a face of another.
    #[error("vertex {0} sits on a face outside of its sheet; project the domain again inside its sheets")]
    OtherSheet(VertexId),
    /// No corner of a domain face is beside the face's sheet.
    #[error("no corner of face {0} is beside its sheet; project the domain again inside its sheets")]
    OutsideSheet(FaceId),
    /// The domain has no face in a sheet of the surface.
    #[error("the domain has no face in sheet {0} of the surface, so nothing there can come closer")]
    EmptySheet(SheetId),
    /// A face that is to stay still is none of the domain.
    #[error("face {0} is to stay still, and the domain has no such face")]
    NoFace(FaceId),
    /// A position is not finite.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}
