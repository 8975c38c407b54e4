//! The vertices of the finest level in a base face, by their weights.

use mesh_core::VertexId;

/// The weights of a vertex of the finest level in its base face, times the number of segments of a side.
pub(crate) type Place = [usize; 3];

/// Where the corners of the finest faces in a base face are, in the order of the finest level.
pub(crate) fn finest_corners(levels: u32) -> Vec<[Place; 3]> {
    let n = 1usize << levels;
    let mut faces = vec![[[n, 0, 0], [0, n, 0], [0, 0, n]]];
    let middle = |p: Place, q: Place| [0, 1, 2].map(|i| (p[i] + q[i]) / 2);
    for _ in 0..levels {
        let children = |[a, b, c]: [Place; 3]| {
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, ab, ca], [b, bc, ab], [c, ca, bc], [bc, ca, ab]]
        };
        faces = faces.into_iter().flat_map(children).collect();
    }
    faces
}

/// The vertices of the finest level in a base face.
#[derive(Clone)]
pub(crate) struct Grid {
    /// Segments of a side.
    n: usize,
    /// The vertices at all places, by rising second and then third weight.
    vertices: Vec<VertexId>,
}

impl Grid {
    /// The vertices of the finest faces in a base face, whose corners are at these places. `None` where a place has no vertex.
    pub(crate) fn of_faces(n: usize, corners: &[[Place; 3]], faces: &[[VertexId; 3]]) -> Option<Self> {
        let mut vertices = vec![None; (n + 1) * (n + 2) / 2];
        for (&place, &v) in corners.iter().flatten().zip(faces.iter().flatten()) {
            vertices[index(n, place)] = Some(v);
        }
        Some(Self { n, vertices: vertices.into_iter().collect::<Option<_>>()? })
    }

    /// The grid with the vertices that a function has for its places.
    pub(crate) fn filled(n: usize, vertex: impl FnMut(Place) -> VertexId) -> Self {
        let places = (0..=n).flat_map(|q| (0..=n - q).map(move |r| [n - q - r, q, r]));
        Self { n, vertices: places.map(vertex).collect() }
    }

    /// Segments of a side.
    pub(crate) fn n(&self) -> usize {
        self.n
    }

    /// The vertex at a place.
    pub(crate) fn at(&self, place: Place) -> VertexId {
        self.vertices[index(self.n, place)]
    }
}

/// The rows before that of the second weight `q` have n + 1, n, n - 1 and so on places.
fn index(n: usize, [_, q, r]: Place) -> usize {
    q * (2 * n + 3 - q) / 2 + r
}
