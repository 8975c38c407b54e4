//! A patch on its own: pieces of working faces that can be cut at edges.

use glam::DVec3;
use mesh_core::{FaceId, TriMesh, VertexId};
use region_map::ChartFace;
use rustc_hash::FxHashMap;

/// The faces of a patch with local vertex numbers. Cutting an edge cuts the one or two pieces beside it.
pub(crate) struct PieceMesh {
    pub(crate) positions: Vec<DVec3>,
    pub(crate) pieces: Vec<ChartFace>,
    /// The piece on the left of every directed edge.
    left: FxHashMap<[u32; 2], u32>,
    local: FxHashMap<VertexId, u32>,
}

impl PieceMesh {
    /// The pieces are whole faces at first.
    pub(crate) fn new(mesh: &TriMesh, faces: &[FaceId]) -> Self {
        let mut pieces =
            Self { positions: Vec::new(), pieces: Vec::new(), left: FxHashMap::default(), local: FxHashMap::default() };
        for &source in faces {
            let vertices = mesh.face(source).map(|v| pieces.take(mesh, v));
            let barycentric = [DVec3::X, DVec3::Y, DVec3::Z];
            pieces.add(ChartFace { vertices, source, barycentric });
        }
        pieces
    }

    fn take(&mut self, mesh: &TriMesh, v: VertexId) -> u32 {
        *self.local.entry(v).or_insert_with(|| {
            self.positions.push(mesh.position(v));
            self.positions.len() as u32 - 1
        })
    }

    fn add(&mut self, piece: ChartFace) {
        self.pieces.push(piece);
        self.register(self.pieces.len() as u32 - 1);
    }

    fn register(&mut self, i: u32) {
        let v = self.pieces[i as usize].vertices;
        for c in 0..3 {
            self.left.insert([v[c], v[(c + 1) % 3]], i);
        }
    }

    /// The local number of a working vertex.
    pub(crate) fn local(&self, v: VertexId) -> Option<u32> {
        self.local.get(&v).copied()
    }

    /// A new vertex `s` (0 to 1) of the way from `a` to `b`, which must be joined by an edge.
    pub(crate) fn cut(&mut self, a: u32, b: u32, s: f64) -> u32 {
        let m = self.positions.len() as u32;
        self.positions.push(self.positions[a as usize].lerp(self.positions[b as usize], s));
        for (from, to, s) in [(a, b, s), (b, a, 1.0 - s)] {
            if let Some(i) = self.left.remove(&[from, to]) {
                self.cut_piece(i, from, s, m);
            }
        }
        m
    }

    /// Cuts piece `i` from the point `m`, at `s` of its edge that starts at `from`, to the opposite corner.
    fn cut_piece(&mut self, i: u32, from: u32, s: f64, m: u32) {
        let whole = self.pieces[i as usize].clone();
        let Some(c) = (0..3).find(|&c| whole.vertices[c] == from) else { return };
        let middle = whole.barycentric[c].lerp(whole.barycentric[(c + 1) % 3], s);
        let mut second = whole.clone();
        second.vertices[c] = m;
        second.barycentric[c] = middle;
        let first = &mut self.pieces[i as usize];
        first.vertices[(c + 1) % 3] = m;
        first.barycentric[(c + 1) % 3] = middle;
        self.register(i);
        self.add(second);
    }

    /// Cuts, in the middle, every inner edge between two vertices of the border.
    ///
    /// Then no edge joins two vertices of one side of the polygon but those along it: what the injectivity of the chart hangs on.
    pub(crate) fn cut_dividing_edges(&mut self, is_border: &[bool]) {
        let mut dividing = Vec::new();
        for piece in &self.pieces {
            for c in 0..3 {
                let (a, b) = (piece.vertices[c], piece.vertices[(c + 1) % 3]);
                if a < b && is_border[a as usize] && is_border[b as usize] && self.left.contains_key(&[b, a]) {
                    dividing.push((a, b));
                }
            }
        }
        for (a, b) in dividing {
            self.cut(a, b, 0.5);
        }
    }
}
