//! How the base mesh is made.

/// How the base mesh is made.
#[derive(Clone, Debug, PartialEq)]
pub struct BaseOptions {
    /// Wanted number of vertices, up to 10 million; the improvement removes and adds vertices to meet it as far as corners and arcs
    /// allow. Default 200.
    pub base_vertices: usize,
    /// Rounds of improvement of the connectivity, up to 1,000. Default 10. With 0 all sites stay, and inside each patch they are joined by a
    /// constrained Delaunay triangulation, by the lengths of base edges.
    pub rounds: usize,
    /// The share of a patch that its chart may shrink to less than a quarter of the mean scale, 0 to 1; patches beyond it are
    /// refused as uncharted. Default 0.05. Measured: convex patches stay below .01; beyond .05 the fine triangles that the map
    /// places begin to turn over (fandisk's stepped side .09, the rabbit's back with both ears .2).
    pub max_shrunk: f64,
    /// Other seeds give other base meshes of the same quality by decimation: the wanted lengths of edges are changed a little at random,
    /// and with them which edges go first. Default 0, which changes nothing.
    pub seed: u64,
}

impl Default for BaseOptions {
    fn default() -> Self {
        Self { base_vertices: 200, rounds: 10, max_shrunk: 0.05, seed: 0 }
    }
}
