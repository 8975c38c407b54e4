//! [`Setting`]: what differs between the base meshes that are tried.

/// What is asked of the stages up to the base mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Setting {
    /// Factor on the persistence below which creases are left out.
    pub(crate) persistence: f64,
    /// Factor on the number of base vertices.
    pub(crate) base_vertices: f64,
    /// Whether that factor is on what corners and arcs need, where that is more than what was asked for.
    pub(crate) as_needed: bool,
    /// The angle in radians that the surface may turn by along a base edge.
    pub(crate) turn: f64,
}
