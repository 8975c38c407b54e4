//! Faces that can be cut into pieces.

use glam::DVec3;
use mesh_core::{FaceId, TriMesh, VertexId};
use region_map::ChartFace;
use rustc_hash::FxHashMap;

/// Pieces of working faces, joined at their edges, with vertices of their own. Cutting an edge cuts the one or two pieces beside it.
#[derive(Clone, Debug)]
pub struct PieceMesh {
    positions: Vec<DVec3>,
    pieces: Vec<ChartFace>,
    /// The piece on the left of every directed edge.
    left: FxHashMap<[u32; 2], u32>,
    /// The numbers of the working vertices; `None` where they have kept their own.
    numbers: Option<FxHashMap<VertexId, u32>>,
}

/// What cutting an edge made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cut {
    /// The new vertex.
    pub vertex: u32,
    /// The pieces on the left and on the right of the edge, each cut in two; `None` at a border.
    pub sides: [Option<Halves>; 2],
}

/// A piece that was cut in two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Halves {
    /// The half that has kept the number of the piece.
    pub first: u32,
    /// The half with a new number.
    pub second: u32,
}

/// A piece that was cut in three at a point inside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Thirds {
    /// The new vertex.
    pub vertex: u32,
    /// The three pieces; the first has kept the number.
    pub pieces: [u32; 3],
}

/// A whole face as a piece.
const WHOLE: [DVec3; 3] = [DVec3::X, DVec3::Y, DVec3::Z];

impl PieceMesh {
    /// All faces of a mesh: pieces and vertices have the numbers of its faces and vertices.
    pub fn of_mesh(mesh: &TriMesh) -> Self {
        let positions = mesh.positions().as_slice().to_vec();
        let mut all = Self { positions, pieces: Vec::new(), left: FxHashMap::default(), numbers: None };
        for (source, f) in mesh.faces().enumerate() {
            all.push(ChartFace { vertices: f.map(|v| v.0), source, barycentric: WHOLE });
        }
        all
    }

    /// Some faces of a mesh, numbered in the order given, their vertices in the order of the faces. Faces that it has not are left out.
    pub fn of_faces(mesh: &TriMesh, faces: &[FaceId]) -> Self {
        let mut numbers = FxHashMap::default();
        let mut some = Self { positions: Vec::new(), pieces: Vec::new(), left: FxHashMap::default(), numbers: None };
        for &source in faces {
            let Some(face) = mesh.faces().get(source) else { continue };
            let vertices = face.map(|v| *numbers.entry(v).or_insert_with(|| some.add_vertex(mesh.position(v))));
            some.push(ChartFace { vertices, source, barycentric: WHOLE });
        }
        some.numbers = Some(numbers);
        some
    }

    /// Positions of the vertices.
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// All pieces.
    pub fn pieces(&self) -> &[ChartFace] {
        &self.pieces
    }

    /// The number here of a vertex of the mesh; `None` when it is in none of the faces.
    pub fn number(&self, v: VertexId) -> Option<u32> {
        match &self.numbers {
            Some(numbers) => numbers.get(&v).copied(),
            None => (v.0 < self.positions.len() as u32).then_some(v.0),
        }
    }

    /// The piece on the left of the edge from `a` to `b`.
    pub fn left(&self, a: u32, b: u32) -> Option<u32> {
        self.left.get(&[a, b]).copied()
    }

    /// Does an edge join the two?
    pub fn are_joined(&self, a: u32, b: u32) -> bool {
        self.left(a, b).or(self.left(b, a)).is_some()
    }

    /// The edges of the pieces for which something holds, from the lower vertex to the higher, as the pieces run through them that way.
    pub fn edges_where(&self, holds: impl Fn(u32, u32) -> bool) -> Vec<[u32; 2]> {
        let sides = |piece: &ChartFace| {
            let v = piece.vertices;
            [[v[0], v[1]], [v[1], v[2]], [v[2], v[0]]]
        };
        self.pieces.iter().flat_map(sides).filter(|&[a, b]| a < b && holds(a, b)).collect()
    }

    /// Cuts the edge between `a` and `b` at a new vertex `s` (0 to 1) of the way; `None` when no edge joins them.
    pub fn cut(&mut self, a: u32, b: u32, s: f64) -> Option<Cut> {
        if !self.are_joined(a, b) {
            return None;
        }
        let vertex = self.add_vertex(self.positions[a as usize].lerp(self.positions[b as usize], s));
        let sides = [(a, b, s), (b, a, 1.0 - s)].map(|(from, to, s)| {
            let piece = self.left.remove(&[from, to])?;
            self.halve(piece, from, s, vertex)
        });
        Some(Cut { vertex, sides })
    }

    /// Cuts a piece from the vertex `m`, at `s` of its edge that starts at `from`, to the opposite corner.
    fn halve(&mut self, piece: u32, from: u32, s: f64, m: u32) -> Option<Halves> {
        let whole = self.pieces[piece as usize].clone();
        let c = whole.vertices.iter().position(|&v| v == from)?;
        let middle = whole.barycentric[c].lerp(whole.barycentric[(c + 1) % 3], s);
        let mut second = whole.clone();
        (second.vertices[c], second.barycentric[c]) = (m, middle);
        let first = &mut self.pieces[piece as usize];
        (first.vertices[(c + 1) % 3], first.barycentric[(c + 1) % 3]) = (m, middle);
        self.register(piece);
        Some(Halves { first: piece, second: self.push(second) })
    }

    /// Cuts a piece in three at a point inside, given by its barycentric coordinates in the piece; `None` when there is no such piece.
    pub fn cut_inside(&mut self, piece: u32, weights: DVec3) -> Option<Thirds> {
        let whole = self.pieces.get(piece as usize)?.clone();
        let at = |[a, b, c]: [DVec3; 3]| weights.x * a + weights.y * b + weights.z * c;
        let vertex = self.add_vertex(at(whole.vertices.map(|v| self.positions[v as usize])));
        let middle = at(whole.barycentric);
        let part = |corner: usize| {
            let mut part = whole.clone();
            (part.vertices[corner], part.barycentric[corner]) = (vertex, middle);
            part
        };
        self.pieces[piece as usize] = part(0);
        self.register(piece);
        Some(Thirds { vertex, pieces: [piece, self.push(part(1)), self.push(part(2))] })
    }

    fn add_vertex(&mut self, position: DVec3) -> u32 {
        self.positions.push(position);
        self.positions.len() as u32 - 1
    }

    fn push(&mut self, piece: ChartFace) -> u32 {
        let number = self.pieces.len() as u32;
        self.pieces.push(piece);
        self.register(number);
        number
    }

    fn register(&mut self, piece: u32) {
        let v = self.pieces[piece as usize].vertices;
        for c in 0..3 {
            self.left.insert([v[c], v[(c + 1) % 3]], piece);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Every piece has the corners that it says it has in its face, and all of them cover each face once.
    fn check(mesh: &TriMesh, pieces: &PieceMesh) {
        let mut areas = vec![0.0; mesh.n_faces()];
        for piece in pieces.pieces() {
            let face = mesh.triangle(piece.source);
            for (v, w) in piece.vertices.iter().zip(piece.barycentric) {
                let there = w.x * face[0] + w.y * face[1] + w.z * face[2];
                assert!(there.distance(pieces.positions()[*v as usize]) < 1e-12);
            }
            let corners = piece.vertices.map(|v| pieces.positions()[v as usize]);
            assert!(mesh_core::vector_area(corners).dot(mesh.normal(piece.source)) > 0.0, "no piece is turned over");
            areas[piece.source.0 as usize] += mesh_core::area(corners);
        }
        for f in mesh.faces().ids() {
            assert!((areas[f.0 as usize] / mesh.area(f) - 1.0).abs() < 1e-9);
        }
        for (i, piece) in pieces.pieces().iter().enumerate() {
            let v = piece.vertices;
            assert!((0..3).all(|c| pieces.left(v[c], v[(c + 1) % 3]) == Some(i as u32)));
        }
    }

    proptest! {
        #[test]
        fn pieces_cover_their_faces(cuts in prop::collection::vec((any::<u32>(), 0..4usize, 0.1f64..0.9), 0..40)) {
            let mesh = fixtures::cube(1);
            let mut pieces = PieceMesh::of_mesh(&mesh);
            for (piece, corner, s) in cuts {
                let piece = piece % pieces.pieces().len() as u32;
                let v = pieces.pieces()[piece as usize].vertices;
                if corner == 3 {
                    prop_assert!(pieces.cut_inside(piece, DVec3::new(s, 1.0 - s, 1.0) / 2.0).is_some());
                } else {
                    let cut = pieces.cut(v[corner], v[(corner + 1) % 3], s);
                    prop_assert!(cut.is_some_and(|c| c.sides.iter().all(Option::is_some)), "a cube has no border");
                }
            }
            check(&mesh, &pieces);
        }
    }

    #[test]
    fn what_is_not_there_is_not_cut() {
        let mut pieces = PieceMesh::of_mesh(&fixtures::plane());
        let n = pieces.pieces().len() as u32;
        assert_eq!(pieces.cut(0, u32::MAX, 0.5), None);
        assert_eq!(pieces.cut_inside(n, DVec3::splat(1.0 / 3.0)), None);
        assert_eq!(pieces.number(VertexId(u32::MAX)), None);
        assert_eq!(pieces.pieces().len(), n as usize);
        assert!(PieceMesh::of_faces(&fixtures::plane(), &[FaceId(u32::MAX)]).pieces().is_empty());
    }
}
