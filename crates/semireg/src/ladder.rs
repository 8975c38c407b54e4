//! What is tried, in which order, until a result passes the certificate.

/// One way to run the stages.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rung {
    /// Factor on the persistence below which creases are left out.
    pub(crate) persistence: f64,
    /// Factor on the wanted number of base vertices.
    pub(crate) base_vertices: f64,
    /// The angle in radians that the surface may turn by along a base edge.
    pub(crate) turn: f64,
    /// In plain words, for the report.
    pub(crate) what: &'static str,
}

/// Most models pass on the first rung. A crease that was left out may have been needed, or one that was kept may be noise; and what
/// is too coarse for the shape needs more vertices.
pub(crate) const LADDER: [Rung; 6] = [
    Rung { persistence: 1.0, base_vertices: 1.0, turn: 1.6, what: "as asked" },
    Rung {
        persistence: 3.0,
        base_vertices: 1.0,
        turn: 1.2,
        what: "with fewer creases and shorter edges where the surface bends",
    },
    Rung { persistence: 0.4, base_vertices: 1.0, turn: 1.6, what: "with more creases" },
    Rung { persistence: 1.0, base_vertices: 1.25, turn: 1.6, what: "with a quarter more base vertices" },
    Rung { persistence: 3.0, base_vertices: 1.6, turn: 1.2, what: "with more base vertices and fewer creases" },
    Rung { persistence: 1.0, base_vertices: 2.5, turn: 1.2, what: "with two and a half times the base vertices" },
];
