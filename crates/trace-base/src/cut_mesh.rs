//! The working mesh in pieces: faces cut where base vertices and paths need it.

use glam::{DMat3, DVec3};
use mesh_core::{FaceId, Id as _, SurfacePoint, TriMesh};
use region_map::ChartFace;
use rustc_hash::{FxHashMap, FxHashSet};

/// Pieces of working faces. Edges can become walls, which nothing crosses, and vertices taken, which no further path runs through.
#[derive(Clone)]
pub(crate) struct CutMesh {
    pub(crate) positions: Vec<DVec3>,
    pub(crate) pieces: Vec<ChartFace>,
    pub(crate) taken: Vec<bool>,
    /// The piece on the left of every directed edge.
    left: FxHashMap<[u32; 2], u32>,
    /// A piece at every vertex.
    piece_at: Vec<u32>,
    /// The pieces of a cut face beyond the first, which has the number of the face.
    more_pieces: FxHashMap<FaceId, Vec<u32>>,
    walls: FxHashSet<[u32; 2]>,
}

/// A point this close to an edge or a vertex of its piece, as a share of the height over it, is put there.
const TOUCH: f64 = 1e-3;
/// A point too close to what it may not touch goes this share of the way to the middle of its piece.
const INWARDS: f64 = 0.2;

impl CutMesh {
    /// The pieces are whole faces at first, the vertices those of the mesh.
    pub(crate) fn new(mesh: &TriMesh) -> Self {
        let mut cut = Self {
            positions: mesh.positions().as_slice().to_vec(),
            pieces: Vec::new(),
            taken: vec![false; mesh.n_vertices()],
            left: FxHashMap::default(),
            piece_at: vec![u32::MAX; mesh.n_vertices()],
            more_pieces: FxHashMap::default(),
            walls: FxHashSet::default(),
        };
        for (source, f) in mesh.faces().enumerate() {
            cut.pieces.push(ChartFace { vertices: f.map(|v| v.0), source, barycentric: [DVec3::X, DVec3::Y, DVec3::Z] });
            cut.register(source.0);
        }
        cut
    }

    fn register(&mut self, i: u32) {
        let v = self.pieces[i as usize].vertices;
        for c in 0..3 {
            self.left.insert([v[c], v[(c + 1) % 3]], i);
            self.piece_at[v[c] as usize] = i;
        }
    }

    fn add(&mut self, piece: ChartFace) {
        let i = self.pieces.len() as u32;
        self.more_pieces.entry(piece.source).or_default().push(i);
        self.pieces.push(piece);
        self.register(i);
    }

    fn add_vertex(&mut self, position: DVec3) -> u32 {
        self.positions.push(position);
        self.taken.push(false);
        self.piece_at.push(u32::MAX);
        self.positions.len() as u32 - 1
    }

    /// The piece on the left of the edge from `a` to `b`.
    pub(crate) fn left(&self, a: u32, b: u32) -> Option<u32> {
        self.left.get(&[a, b]).copied()
    }

    /// Does an edge join the two?
    pub(crate) fn joined(&self, a: u32, b: u32) -> bool {
        self.left(a, b).or(self.left(b, a)).is_some()
    }

    pub(crate) fn is_wall(&self, a: u32, b: u32) -> bool {
        self.walls.contains(&[a.min(b), a.max(b)])
    }

    /// Nothing crosses this edge from now on, and no path meets its ends.
    pub(crate) fn wall(&mut self, a: u32, b: u32) {
        self.walls.insert([a.min(b), a.max(b)]);
        self.taken[a as usize] = true;
        self.taken[b as usize] = true;
    }

    /// The other two vertices of a piece at `v`, counter-clockwise.
    pub(crate) fn others(&self, piece: u32, v: u32) -> [u32; 2] {
        let vertices = self.pieces[piece as usize].vertices;
        let c = vertices.iter().position(|&w| w == v).unwrap_or(0);
        [vertices[(c + 1) % 3], vertices[(c + 2) % 3]]
    }

    /// The pieces round a vertex.
    pub(crate) fn fan(&self, v: u32) -> Vec<u32> {
        let start = self.piece_at[v as usize];
        let mut fan = vec![start];
        let turn = |piece: u32, forward: bool| {
            let [x, y] = self.others(piece, v);
            if forward { self.left(v, y) } else { self.left(x, v) }
        };
        for forward in [true, false] {
            let mut at = start;
            while let Some(next) = turn(at, forward) {
                if next == start {
                    return fan;
                }
                fan.push(next);
                at = next;
            }
        }
        fan
    }

    /// The pieces at `v` from the edge to `from` counter-clockwise to the edge to `to`.
    pub(crate) fn sector(&self, v: u32, from: u32, to: u32) -> Vec<u32> {
        let mut sector = Vec::new();
        let mut at = from;
        while let Some(piece) = self.left(v, at) {
            sector.push(piece);
            at = self.others(piece, v)[1];
            if at == to || at == from {
                break;
            }
        }
        sector
    }

    /// Cuts a piece through the middle of its longest edge that is no wall; `None` where all are.
    pub(crate) fn halve(&mut self, piece: u32) -> Option<u32> {
        let v = self.pieces[piece as usize].vertices;
        let edges = (0..3).map(|c| [v[c], v[(c + 1) % 3]]).filter(|&[a, b]| !self.is_wall(a, b));
        let length = |[a, b]: [u32; 2]| self.positions[a as usize].distance(self.positions[b as usize]);
        let [a, b] = edges.max_by(|&e, &f| length(e).total_cmp(&length(f)))?;
        self.cut(a, b, 0.5)
    }

    /// A new vertex `s` (0 to 1) of the way from `a` to `b`; `None` when no edge joins them. The halves of a wall are walls.
    pub(crate) fn cut(&mut self, a: u32, b: u32, s: f64) -> Option<u32> {
        if !self.joined(a, b) {
            return None;
        }
        let m = self.add_vertex(self.positions[a as usize].lerp(self.positions[b as usize], s));
        for (from, to, s) in [(a, b, s), (b, a, 1.0 - s)] {
            if let Some(i) = self.left.remove(&[from, to]) {
                self.cut_piece(i, from, s, m);
            }
        }
        if self.walls.remove(&[a.min(b), a.max(b)]) {
            self.wall(a, m);
            self.wall(m, b);
        }
        Some(m)
    }

    /// Cuts piece `i` from the point `m`, at `s` of its edge that starts at `from`, to the opposite corner.
    fn cut_piece(&mut self, i: u32, from: u32, s: f64, m: u32) {
        let whole = self.pieces[i as usize].clone();
        let Some(c) = whole.vertices.iter().position(|&v| v == from) else { return };
        let middle = whole.barycentric[c].lerp(whole.barycentric[(c + 1) % 3], s);
        let mut second = whole.clone();
        (second.vertices[c], second.barycentric[c]) = (m, middle);
        let first = &mut self.pieces[i as usize];
        (first.vertices[(c + 1) % 3], first.barycentric[(c + 1) % 3]) = (m, middle);
        self.register(i);
        self.add(second);
    }

    /// Cuts a piece in three at a point inside.
    fn cut_inside(&mut self, i: u32, w: DVec3) -> u32 {
        let whole = self.pieces[i as usize].clone();
        let [a, b, c] = whole.vertices.map(|v| self.positions[v as usize]);
        let m = self.add_vertex(w.x * a + w.y * b + w.z * c);
        let [a, b, c] = whole.barycentric;
        let middle = w.x * a + w.y * b + w.z * c;
        let part = |k: usize| {
            let mut part = whole.clone();
            (part.vertices[k], part.barycentric[k]) = (m, middle);
            part
        };
        self.pieces[i as usize] = part(0);
        self.register(i);
        self.add(part(1));
        self.add(part(2));
        m
    }

    /// A vertex at (or very near to) a point, of no path or base vertex yet and off all walls, taken from now on.
    pub(crate) fn insert(&mut self, point: SurfacePoint) -> u32 {
        let (piece, w) = self.piece_with(point);
        let vertices = self.pieces[piece as usize].vertices;
        let inside = w.lerp(DVec3::splat(1.0 / 3.0), INWARDS);
        let near = (0..3).find(|&c| w[c] > 1.0 - TOUCH);
        let beside = (0..3).find(|&c| w[c] < TOUCH);
        let v = match (near, beside) {
            (Some(c), _) if !self.taken[vertices[c] as usize] => vertices[c],
            (None, Some(c)) if !self.is_wall(vertices[(c + 1) % 3], vertices[(c + 2) % 3]) => {
                let (a, b) = ((c + 1) % 3, (c + 2) % 3);
                let cut = self.cut(vertices[a], vertices[b], w[b] / (w[a] + w[b]));
                cut.unwrap_or_else(|| self.cut_inside(piece, inside))
            }
            (None, None) => self.cut_inside(piece, w),
            _ => self.cut_inside(piece, inside),
        };
        self.taken[v as usize] = true;
        v
    }

    /// The piece that holds a point, and the barycentric coordinates in it.
    fn piece_with(&self, point: SurfacePoint) -> (u32, DVec3) {
        let first = point.face.index() as u32;
        let more = self.more_pieces.get(&point.face).into_iter().flatten();
        let weights = |&i: &u32| {
            let [a, b, c] = self.pieces[i as usize].barycentric;
            let w = DMat3::from_cols(a, b, c).inverse() * point.barycentric;
            if w.is_finite() { w } else { DVec3::NEG_INFINITY }
        };
        let pieces = std::iter::once(&first).chain(more).map(|i| (*i, weights(i)));
        let deepest = pieces.max_by(|a, b| a.1.min_element().total_cmp(&b.1.min_element())).unwrap_or((first, DVec3::ONE));
        let w = if deepest.1.is_finite() { deepest.1.max(DVec3::ZERO) } else { DVec3::ONE };
        (deepest.0, w / w.element_sum())
    }

    /// A vertex as a point of the working mesh.
    pub(crate) fn point(&self, v: u32) -> SurfacePoint {
        let piece = &self.pieces[self.piece_at[v as usize] as usize];
        let c = piece.vertices.iter().position(|&w| w == v).unwrap_or(0);
        SurfacePoint::new(piece.source, piece.barycentric[c])
    }

    /// Cuts, in the middle, every edge between two taken vertices that is no wall: charts of the regions between walls are
    /// injective then.
    pub(crate) fn cut_dividing_edges(&mut self) {
        let mut dividing = Vec::new();
        for piece in &self.pieces {
            for c in 0..3 {
                let (a, b) = (piece.vertices[c], piece.vertices[(c + 1) % 3]);
                if a < b && self.taken[a as usize] && self.taken[b as usize] && !self.is_wall(a, b) {
                    dividing.push((a, b));
                }
            }
        }
        for (a, b) in dividing {
            self.cut(a, b, 0.5);
        }
    }
}
