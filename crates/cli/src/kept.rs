//! What the user may want kept, as typed.

/// What is kept beside borders and marked edges.
#[derive(clap::ValueEnum, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FeaturesArg {
    /// Edges of a great angle between their faces
    Creases,
    /// Nothing
    None,
    /// Edges that the file makes hard: its normals change there (gltf, obj, ply), or its smoothing groups (obj)
    Normals,
}

impl FeaturesArg {
    /// As it is typed.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Creases => "creases",
            Self::None => "none",
            Self::Normals => "normals",
        }
    }
}

/// What may be kept on request.
#[derive(clap::ValueEnum, Clone, Copy, PartialEq, Eq)]
pub(crate) enum KeepArg {
    /// Texture coordinates that go on
    Seams,
    /// Materials
    Materials,
}
