//! What cleaning is told, and what it tells.

/// What to repair beyond what must be.
#[derive(Clone, Debug, PartialEq)]
pub struct CleanOptions {
    /// Vertices on a border that are at most this far apart are merged, as a share of the diagonal of the box; from 0 to about 1e-3.
    /// Default 1e-6, some rounding of the single precision that files have. With 0 only vertices at exactly the same position are.
    ///
    /// Of 200 models from the net 8 have cracks that 1e-7 closes; remeshed with them, each side of a crack goes its own way.
    pub weld_tolerance: f64,
    /// Split triangles on whose edge the border beside has vertices of its own (T-vertices, as where a coarse side of a box meets a fine one). Else the
    /// surface stays open there, as it is in the file, and the report tells. Default false.
    pub close_t_vertices: bool,
}

impl Default for CleanOptions {
    fn default() -> Self {
        Self { weld_tolerance: 1e-6, close_t_vertices: false }
    }
}

/// How often each repair was made. All 0 for a mesh that was clean.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CleanReport {
    /// Triangles dropped: a vertex index is out of range.
    pub bad_index: usize,
    /// Triangles dropped: a coordinate is infinite, not a number, or larger than 1e75.
    pub not_finite: usize,
    /// Vertices merged into another one at exactly the same position.
    pub merged_exactly: usize,
    /// Vertices on a border merged into another one there within the tolerance.
    pub merged_by_tolerance: usize,
    /// Vertices on an edge of a border within the tolerance, along which another border runs: the triangle at that edge was split there.
    pub t_vertices: usize,
    /// The same, left as they are: the surface is open there.
    pub open_t_vertices: usize,
    /// Triangles dropped: two corners are the same vertex, after merging.
    pub collapsed: usize,
    /// Triangles dropped: two that lie on each other, joined along an edge of their own: a fold that closes without them.
    pub flaps: usize,
    /// How wide the widest of those is: its height over its longest edge, in the units of the mesh.
    pub flap_width: f64,
    /// Triangles dropped: another one has the same three vertices. Two that face opposite ways both stay where each belongs to
    /// a part of its own, such as the common wall of two solids; of a double sheet one side stays.
    pub repeated: usize,
    /// Triangles turned over, to face the same way as their neighbours.
    pub turned: usize,
    /// Edges cut because the surface has one side only, like a Moebius strip.
    pub orientation_cuts: usize,
    /// Edges where more than two triangles meet, before the cut into leaves.
    pub non_manifold_edges: usize,
    /// Of these, edges where a leaf ends: it has no other one to go on into.
    pub leaf_cuts: usize,
    /// Edges split in their middle, because another edge has the same two ends.
    pub split_edges: usize,
    /// Copies of vertices made where leaves meet, bit for bit at the same position.
    pub vertex_copies: usize,
    /// Triangles without area mended by flipping their longest edge.
    pub zero_area_flipped: usize,
    /// Triangles without area dropped: they are at a border, or in a part without any area, or hang on an edge as needles (at most a
    /// millionth as high as long).
    pub zero_area_dropped: usize,
    /// Triangles without area dropped though that opens the surface, along a line and by no width: no flip mends them.
    pub zero_area_opened: usize,
    /// Vertices dropped: no triangle uses them.
    pub unused_vertices: usize,
}
