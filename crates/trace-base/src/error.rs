//! Why a base mesh from elsewhere does not fit.

use mesh_core::{FaceId, VertexId};

/// Why a base mesh cannot stand for a surface at all.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TraceError {
    /// It is not an oriented manifold.
    #[error("the base mesh is not an oriented manifold ({0}); repair it")]
    NotManifold(#[from] mesh_core::TopologyError),
    /// It has another topology than the surface.
    #[error("the base mesh has {base}, but the input has {surface}; give a base mesh of the same topology")]
    OtherTopology {
        /// Components, border loops and Euler number of the base mesh.
        base: String,
        /// The same of the surface.
        surface: String,
    },
    /// A vertex of it belongs to no face.
    #[error("base vertex {0} belongs to no face; leave it out")]
    UnusedVertex(VertexId),
    /// Its borders cannot be laid along those of the surface.
    #[error(
        "the border of the base mesh does not run along that of the input (near base vertex {0}); give a base mesh whose border \
         vertices lie on the input's border, 3 at least on each loop"
    )]
    Border(VertexId),
    /// Its vertices and edges were attached in a way that contradicts itself: a bug of ours.
    #[error("internal error: the base mesh was attached wrongly ({0}); please report this with both files")]
    Attached(#[from] region_map::RegionMapError),
    /// A vertex inside a sheet was given no place there: a bug of ours.
    #[error("internal error: base vertex {0} has no place on the surface; please report this with both files")]
    NoPlace(VertexId),
    /// A coordinate is not finite.
    #[error(transparent)]
    Mesh(#[from] mesh_core::MeshError),
    /// The network that is left is of another mesh: a bug of ours.
    #[error("internal error: {0}; please report this with both files")]
    Network(#[from] region_map::SurfaceError),
}

/// Why the edges of a base mesh could not be traced; it then has no map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Untraced {
    /// No way between two vertices is left that crosses no other edge.
    #[error("no way is left on the surface for the base edge from vertex {0} to vertex {1}")]
    Edge(VertexId, VertexId),
    /// The paths round a face do not bound a disk.
    #[error("the traced edges of base face {0} do not bound a disk")]
    Face(FaceId),
    /// A base mesh to be traced anew is not of this surface, or contradicts itself.
    #[error("the base mesh is not of this surface, or contradicts itself")]
    OtherSurface,
    /// The edges wind, and would cut the surface into more pieces than this.
    #[error("the base edges wind over long, thin triangles and would cut the surface into more than {0} pieces")]
    TooManyPieces(usize),
    /// A base vertex has come to a place that is not finite: a bug of ours.
    #[error("internal error: a base vertex is at no finite place; please report this")]
    NotFinite,
    /// The work on the surface was told to end (`Surface::interrupt`).
    #[error("tracing the base mesh was interrupted")]
    Interrupted,
    /// The region of a face is too long or too winding to be laid flat.
    #[error("the region of base face {0} cannot be laid flat")]
    Chart(FaceId),
}
