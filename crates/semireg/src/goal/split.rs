//! [`Split`]: a number of base vertices, and how often their faces are split; and what came of one.

use crate::options::MAX_LEVELS;
use mesh_core::Cleaned;

/// The base meshes of results whose levels are left to us have about so many vertices: fewer lose the shape of parts, more take long to find.
const USUAL_BASE: f64 = 1_000.0;
/// The smallest base mesh that a closed surface can have.
const LEAST_BASE: f64 = 4.0;

/// A number of base vertices, and how often their faces are split.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Split {
    /// Base vertices that are asked for.
    pub base_vertices: usize,
    /// How often every base face is split in four.
    pub levels: u32,
}

/// A result that was made for the sake of its size, or was to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SizeTry {
    /// What it was made on.
    pub split: Split,
    /// Its triangles; `None` where it was not certified.
    pub triangles: Option<usize>,
    /// The greatest distance between it and the input, either way, as a share of the input's diagonal.
    pub error: Option<f64>,
}

/// What the counts of a mesh of even triangles over a surface follow from.
pub(super) struct Extent {
    area: f64,
    border: f64,
    euler: f64,
}

impl Extent {
    /// Of a cleaned input.
    pub(super) fn of(cleaned: &Cleaned) -> Self {
        let Cleaned { mesh, topology, .. } = cleaned;
        let borders = topology.edge_ids().filter(|&e| topology.is_border_edge(e)).map(|e| topology.ends(e));
        Self { area: mesh.total_area(), border: borders.map(|[v, w]| mesh.distance(v, w)).sum(), euler: topology.euler() as f64 }
    }

    /// The triangles whose edges have this mean length.
    pub(super) fn triangles_of_edge(&self, length: f64) -> f64 {
        self.area / (0.75f64.sqrt() / 2.0 * length * length)
    }

    /// The vertices of so many triangles: three edges for each but at the border, and Euler's formula.
    fn vertices(&self, triangles: f64) -> f64 {
        let edge = (self.area / (0.75f64.sqrt() / 2.0 * triangles)).sqrt();
        self.euler + 0.5 * (triangles + self.border / edge)
    }

    /// The triangles that have so many vertices.
    pub(super) fn triangles(&self, vertices: f64) -> f64 {
        let [mut low, mut high] = [1.0, 4.0 * (vertices + self.euler.abs())];
        // The number of vertices rises with that of triangles: halved so often, the interval is one number.
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if self.vertices(middle) < vertices { low = middle } else { high = middle }
        }
        high
    }

    /// The base mesh of so many triangles, split so often.
    pub(super) fn split(&self, triangles: f64, levels: u32) -> Split {
        let base = self.vertices(triangles / 4f64.powi(levels as i32));
        Split { base_vertices: base.round().max(LEAST_BASE) as usize, levels }
    }

    /// The number of levels for so many triangles whose base mesh comes nearest to the usual size, at least one where that leaves a base mesh.
    pub(super) fn levels(&self, triangles: f64) -> u32 {
        let base = |levels: u32| self.vertices(triangles / 4f64.powi(levels as i32));
        let off = |levels: u32| (base(levels).max(f64::MIN_POSITIVE) / USUAL_BASE).ln().abs();
        let sound = (1..=MAX_LEVELS).filter(|&levels| base(levels) >= LEAST_BASE);
        sound.min_by(|&k, &l| off(k).total_cmp(&off(l))).unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mesh_core::{CleanOptions, TriMesh, clean};

    fn extent(mesh: &TriMesh) -> Extent {
        Extent::of(&clean(&mesh.to_soup(), &CleanOptions::default()).unwrap())
    }

    /// On closed surfaces Euler's formula is exact: a sphere of 2 V - 4 triangles, a torus of 2 V.
    #[test]
    fn closed_surfaces_have_the_triangles_of_eulers_formula() {
        for (mesh, euler) in [(fixtures::icosphere(4), 2.0), (fixtures::torus(1.0, 0.4, 20, 12), 0.0)] {
            let extent = extent(&mesh);
            assert!((extent.triangles(1_000.0) - 2.0 * (1_000.0 - euler)).abs() < 1e-6);
            let split = extent.split(extent.triangles(10_000.0), 2);
            // Each level has the edges of the one before as new vertices: V, then V + 3 (V - euler), and so on.
            let finer = |v: f64| v + 3.0 * (v - euler);
            let made = finer(finer(split.base_vertices as f64));
            assert!((made / 10_000.0 - 1.0).abs() < 0.01, "{made}");
        }
    }

    /// Rows of equilateral triangles on a rectangle of 100 by 60: a row has a vertex more than edges, and there is a row more than strips.
    #[test]
    fn a_border_has_vertices_of_its_own() {
        let extent = extent(&fixtures::plane());
        let (edge, height) = (0.5, 0.5 * 0.75f64.sqrt());
        let triangles = 2.0 * (100.0 / edge) * (60.0 / height);
        let in_rows = (100.0 / edge + 1.0) * (60.0 / height + 1.0);
        assert!((extent.vertices(triangles) / in_rows - 1.0).abs() < 1e-3, "{}", extent.vertices(triangles));
        assert!((extent.triangles_of_edge(edge) / triangles - 1.0).abs() < 1e-9);
    }

    #[test]
    fn the_base_mesh_has_about_a_thousand_vertices() {
        let extent = extent(&fixtures::icosphere(4));
        for (vertices, levels) in [(5.0, 0), (20.0, 1), (2_000.0, 1), (10_000.0, 2), (16_000.0, 2), (60_000.0, 3), (1e9, 8)] {
            assert_eq!(extent.levels(extent.triangles(vertices)), levels, "{vertices}");
        }
    }
}
