//! Why projecting fails.

/// Why a domain could not be projected.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ProjectError {
    /// The domain does not fit the surface, or its origins don't fit the domain.
    #[error(transparent)]
    Region(#[from] region_map::RegionMapError),
    /// The map of the base mesh leads to another working mesh.
    #[error("the map of the base mesh does not lead to this surface")]
    OtherMap,
    /// A position is not finite.
    #[error(transparent)]
    NotFinite(#[from] mesh_core::MeshError),
}
