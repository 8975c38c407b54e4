//! How large a mesh may be.

/// The most vertices of a mesh: their ids have 32 bits, and the greatest one stands for none.
pub(crate) const MOST_VERTICES: usize = u32::MAX as usize;
/// The most faces of a mesh: the ids of their three halfedges have 32 bits, and the greatest one stands for none.
pub(crate) const MOST_FACES: usize = MOST_VERTICES / 3;
