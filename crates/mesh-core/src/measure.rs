//! Areas, normals, boxes and triangle quality.

use crate::{FaceId, IdVec, TriMesh, VertexId};
use glam::DVec3;

/// The vector area of a triangle: its normal, as long as its area.
pub fn vector_area([a, b, c]: [DVec3; 3]) -> DVec3 {
    0.5 * (b - a).cross(c - a)
}

/// Area of a triangle.
pub fn area(triangle: [DVec3; 3]) -> f64 {
    vector_area(triangle).length()
}

/// Unit normal of a triangle, zero for one without area.
pub fn normal(triangle: [DVec3; 3]) -> DVec3 {
    vector_area(triangle).normalize_or_zero()
}

/// Quality ("aspect ratio", AR) of a triangle: `6 / sqrt(3) * S / (p h)` with area `S`, half perimeter `p` and longest edge
/// `h`; 1 for an equilateral one, 0 for one without area (the paper's \[32\], see `docs/method.md`).
pub fn aspect_ratio([a, b, c]: [DVec3; 3]) -> f64 {
    let lengths = [a.distance(b), b.distance(c), c.distance(a)];
    let half_perimeter = 0.5 * lengths.iter().sum::<f64>();
    let longest = lengths.into_iter().fold(0.0, f64::max);
    let ph = half_perimeter * longest;
    if ph > 0.0 { 6.0 / 3f64.sqrt() * area([a, b, c]) / ph } else { 0.0 }
}

/// The greatest [`inverse_mean_ratio`], so that one needle does not outweigh all; that of a triangle that faces the other way.
const WORST_INVERSE_MEAN_RATIO: f64 = 100.0;

/// Inverse mean ratio of a triangle with sides `a`, `b`, `c`: `(a^2 + b^2 + c^2) / (4 sqrt3 A)`, 1 for an equilateral one that faces along
/// the unit vector `normal`, at most 100; `A` is the area seen along it. What faces the other way has 100.
pub fn inverse_mean_ratio(triangle: [DVec3; 3], normal: DVec3) -> f64 {
    let [a, b, c] = triangle;
    let edges = a.distance_squared(b) + b.distance_squared(c) + c.distance_squared(a);
    let ratio = edges / (4.0 * 3f64.sqrt() * vector_area(triangle).dot(normal));
    if (0.0..WORST_INVERSE_MEAN_RATIO).contains(&ratio) { ratio } else { WORST_INVERSE_MEAN_RATIO }
}

/// The interior angles of a triangle in radians, in the order of its corners; 0 beside an edge without length.
pub fn angles(t: [DVec3; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| {
        let (u, v) = (t[(i + 1) % 3] - t[i], t[(i + 2) % 3] - t[i]);
        u.cross(v).length().atan2(u.dot(v))
    })
}

/// The edge length of a mesh of `n` vertices whose equilateral triangles cover this area (the paper's eq. 3): such a mesh has two
/// triangles of area `sqrt(3)/4 h^2` for every vertex. 0 vertices count as 1.
pub fn equilateral_edge_length(area: f64, n: usize) -> f64 {
    (2.0 * area / (3f64.sqrt() * n.max(1) as f64)).sqrt()
}

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Least coordinates.
    pub min: DVec3,
    /// Greatest coordinates.
    pub max: DVec3,
}

impl Bounds {
    /// The box of some points, `None` without points.
    pub fn of(points: impl IntoIterator<Item = DVec3>) -> Option<Self> {
        points.into_iter().map(|p| Self { min: p, max: p }).reduce(|a, b| Self { min: a.min.min(b.min), max: a.max.max(b.max) })
    }
    /// Whether the two boxes have a point in common.
    pub fn meets(&self, other: &Self) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }
    /// Length of the diagonal.
    pub fn diagonal(&self) -> f64 {
        self.min.distance(self.max)
    }
    /// Middle of the box.
    pub fn centre(&self) -> DVec3 {
        0.5 * (self.min + self.max)
    }
}

impl TriMesh {
    /// Area of a face.
    pub fn area(&self, f: FaceId) -> f64 {
        area(self.triangle(f))
    }
    /// Unit normal of a face, zero for a face without area.
    pub fn normal(&self, f: FaceId) -> DVec3 {
        normal(self.triangle(f))
    }
    /// Unit normals of all faces.
    pub fn normals(&self) -> IdVec<FaceId, DVec3> {
        self.faces().ids().map(|f| self.normal(f)).collect()
    }
    /// Areas of all faces.
    pub fn areas(&self) -> IdVec<FaceId, f64> {
        self.faces().ids().map(|f| self.area(f)).collect()
    }
    /// Sum of the areas of all faces.
    pub fn total_area(&self) -> f64 {
        self.faces().ids().map(|f| self.area(f)).sum()
    }
    /// Middle of a face.
    pub fn centroid(&self, f: FaceId) -> DVec3 {
        let [a, b, c] = self.triangle(f);
        (a + b + c) / 3.0
    }
    /// The box of the vertices that faces use, `None` without faces.
    pub fn bounds(&self) -> Option<Bounds> {
        Bounds::of(self.faces().iter().flatten().map(|&v| self.position(v)))
    }
    /// Diagonal of the box, the length that tolerances and errors are measured by; 0 without faces.
    pub fn diagonal(&self) -> f64 {
        self.bounds().map_or(0.0, |b| b.diagonal())
    }
    /// Length of the edge between two vertices.
    pub fn distance(&self, a: VertexId, b: VertexId) -> f64 {
        self.position(a).distance(self.position(b))
    }
    /// Length of a chain of edges, given by its vertices in order; 0 for fewer than two.
    pub fn chain_length(&self, chain: &[VertexId]) -> f64 {
        chain.windows(2).map(|w| self.distance(w[0], w[1])).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quality_of_known_triangles() {
        let equilateral = [DVec3::ZERO, DVec3::X, DVec3::new(0.5, 0.75f64.sqrt(), 0.0)];
        assert!((aspect_ratio(equilateral) - 1.0).abs() < 1e-15);
        assert!(angles(equilateral).iter().all(|a| (a.to_degrees() - 60.0).abs() < 1e-12));
        let right = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let expected = 6.0 / 3f64.sqrt() * 0.5 / ((2.0 + 2f64.sqrt()) / 2.0 * 2f64.sqrt());
        assert!((aspect_ratio(right) - expected).abs() < 1e-15);
        assert_eq!(aspect_ratio([DVec3::X; 3]), 0.0);
        assert_eq!(normal([DVec3::ZERO, DVec3::X, 2.0 * DVec3::X]), DVec3::ZERO);
    }

    #[test]
    fn a_chain_is_as_long_as_its_edges() {
        let mesh = TriMesh::new(vec![DVec3::ZERO, 3.0 * DVec3::X, 4.0 * DVec3::Y], vec![[0, 1, 2]]).unwrap();
        let length = |chain: &[u32]| mesh.chain_length(&chain.iter().copied().map(VertexId).collect::<Vec<_>>());
        assert_eq!([length(&[]), length(&[2]), length(&[1, 0, 2]), length(&[0, 1, 2, 0])], [0.0, 0.0, 7.0, 12.0]);
    }

    #[test]
    fn equilateral_triangles_cover_the_area() {
        for n in [1, 4, 200] {
            let h = equilateral_edge_length(7.0, n);
            let triangle = area([DVec3::ZERO, h * DVec3::X, h * DVec3::new(0.5, 0.75f64.sqrt(), 0.0)]);
            assert!((2.0 * n as f64 * triangle - 7.0).abs() < 1e-12);
        }
        assert_eq!(equilateral_edge_length(7.0, 0), equilateral_edge_length(7.0, 1));
    }
}
