//! The working mesh in pieces: faces cut where base vertices and paths need it.

use chart::{Cut, PieceMesh, Thirds};
use glam::{DMat3, DVec3};
use mesh_core::{FaceId, Id as _, SurfacePoint, TriMesh};
use region_map::ChartFace;
use rustc_hash::{FxHashMap, FxHashSet};

/// Pieces of working faces. Edges can become walls, which nothing crosses, and vertices taken, which no further path runs through.
#[derive(Clone)]
pub(crate) struct CutMesh {
    mesh: PieceMesh,
    is_taken: Vec<bool>,
    /// A piece at every vertex.
    piece_at: Vec<Option<u32>>,
    /// The pieces of a cut face beyond the first, which has the number of the face.
    more_pieces: FxHashMap<FaceId, Vec<u32>>,
    walls: FxHashSet<[u32; 2]>,
}

/// A point this close to an edge or a vertex of its piece, as a share of the height over it, is put there.
const TOUCH: f64 = 1e-3;
/// A point that is too close to a wall or a taken vertex is moved this share of the way to the middle of its piece.
const INWARDS: f64 = 0.2;

impl CutMesh {
    /// The pieces are whole faces at first, the vertices those of the mesh.
    pub(crate) fn new(mesh: &TriMesh) -> Self {
        let mut piece_at = vec![None; mesh.n_vertices()];
        for (f, vertices) in mesh.faces().enumerate() {
            vertices.iter().for_each(|v| piece_at[v.index()] = Some(f.0));
        }
        Self {
            mesh: PieceMesh::of_mesh(mesh),
            is_taken: vec![false; mesh.n_vertices()],
            piece_at,
            more_pieces: FxHashMap::default(),
            walls: FxHashSet::default(),
        }
    }

    /// Positions of the vertices.
    pub(crate) fn positions(&self) -> &[DVec3] {
        self.mesh.positions()
    }

    /// All pieces.
    pub(crate) fn pieces(&self) -> &[ChartFace] {
        self.mesh.pieces()
    }

    /// The piece on the left of the edge from `a` to `b`.
    pub(crate) fn left(&self, a: u32, b: u32) -> Option<u32> {
        self.mesh.left(a, b)
    }

    /// Does an edge join the two?
    pub(crate) fn are_joined(&self, a: u32, b: u32) -> bool {
        self.mesh.are_joined(a, b)
    }

    /// Does a path or a base vertex have this vertex?
    pub(crate) fn is_taken(&self, v: u32) -> bool {
        self.is_taken[v as usize]
    }

    /// No further path runs through this vertex.
    pub(crate) fn take(&mut self, v: u32) {
        self.is_taken[v as usize] = true;
    }

    pub(crate) fn is_wall(&self, a: u32, b: u32) -> bool {
        self.walls.contains(&[a.min(b), a.max(b)])
    }

    /// Nothing crosses this edge from now on, and no path meets its ends.
    pub(crate) fn wall(&mut self, a: u32, b: u32) {
        self.walls.insert([a.min(b), a.max(b)]);
        self.take(a);
        self.take(b);
    }

    /// The other two vertices of a piece at `v`, counter-clockwise.
    fn others(&self, piece: u32, v: u32) -> [u32; 2] {
        let vertices = self.pieces()[piece as usize].vertices;
        let c = vertices.iter().position(|&w| w == v).unwrap_or(0);
        [vertices[(c + 1) % 3], vertices[(c + 2) % 3]]
    }

    /// The pieces round a vertex.
    pub(crate) fn fan(&self, v: u32) -> Vec<u32> {
        let Some(start) = self.piece_at[v as usize] else { return Vec::new() };
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
        let v = self.pieces()[piece as usize].vertices;
        let edges = (0..3).map(|c| [v[c], v[(c + 1) % 3]]).filter(|&[a, b]| !self.is_wall(a, b));
        let length = |[a, b]: [u32; 2]| self.positions()[a as usize].distance(self.positions()[b as usize]);
        let [a, b] = edges.max_by(|&e, &f| length(e).total_cmp(&length(f)))?;
        self.cut(a, b, 0.5)
    }

    /// A new vertex `s` (0 to 1) of the way from `a` to `b`; `None` when no edge joins them. The halves of a wall are walls.
    pub(crate) fn cut(&mut self, a: u32, b: u32, s: f64) -> Option<u32> {
        let Cut { vertex, sides } = self.mesh.cut(a, b, s)?;
        self.add_vertex();
        for halves in sides.into_iter().flatten() {
            self.meet(halves.first);
            self.add(halves.second);
        }
        if self.walls.remove(&[a.min(b), a.max(b)]) {
            self.wall(a, vertex);
            self.wall(vertex, b);
        }
        Some(vertex)
    }

    /// Cuts a piece in three at a point inside.
    fn cut_inside(&mut self, piece: u32, weights: DVec3) -> Option<u32> {
        let Thirds { vertex, pieces: [first, second, third] } = self.mesh.cut_inside(piece, weights)?;
        self.add_vertex();
        self.meet(first);
        self.add(second);
        self.add(third);
        Some(vertex)
    }

    fn add_vertex(&mut self) {
        self.is_taken.push(false);
        self.piece_at.push(None);
    }

    /// Notes a piece at its vertices.
    fn meet(&mut self, piece: u32) {
        for v in self.pieces()[piece as usize].vertices {
            self.piece_at[v as usize] = Some(piece);
        }
    }

    /// Notes a new piece at its vertices, and in its face.
    fn add(&mut self, piece: u32) {
        self.more_pieces.entry(self.pieces()[piece as usize].source).or_default().push(piece);
        self.meet(piece);
    }

    /// A vertex at (or very near to) a point, of no path or base vertex yet and off all walls, taken from now on.
    pub(crate) fn insert(&mut self, point: SurfacePoint) -> Option<u32> {
        let (piece, w) = self.piece_with(point);
        let vertices = self.pieces()[piece as usize].vertices;
        let inside = w.lerp(DVec3::splat(1.0 / 3.0), INWARDS);
        let near = (0..3).find(|&c| w[c] > 1.0 - TOUCH);
        let beside = (0..3).find(|&c| w[c] < TOUCH);
        let v = match (near, beside) {
            (Some(c), _) if !self.is_taken(vertices[c]) => vertices[c],
            (None, Some(c)) if !self.is_wall(vertices[(c + 1) % 3], vertices[(c + 2) % 3]) => {
                let (a, b) = ((c + 1) % 3, (c + 2) % 3);
                let cut = self.cut(vertices[a], vertices[b], w[b] / (w[a] + w[b]));
                cut.or_else(|| self.cut_inside(piece, inside))?
            }
            (None, None) => self.cut_inside(piece, w)?,
            _ => self.cut_inside(piece, inside)?,
        };
        self.take(v);
        Some(v)
    }

    /// The piece that holds a point, and the barycentric coordinates in it.
    fn piece_with(&self, point: SurfacePoint) -> (u32, DVec3) {
        let first = point.face.index() as u32;
        let more = self.more_pieces.get(&point.face).into_iter().flatten();
        let weights = |&i: &u32| {
            let [a, b, c] = self.pieces()[i as usize].barycentric;
            let w = DMat3::from_cols(a, b, c).inverse() * point.barycentric;
            if w.is_finite() { w } else { DVec3::NEG_INFINITY }
        };
        let pieces = std::iter::once(&first).chain(more).map(|i| (*i, weights(i)));
        let deepest = pieces.max_by(|a, b| a.1.min_element().total_cmp(&b.1.min_element())).unwrap_or((first, DVec3::ONE));
        let w = if deepest.1.is_finite() { deepest.1.max(DVec3::ZERO) } else { DVec3::ONE };
        (deepest.0, w / w.element_sum())
    }

    /// A vertex as a point of the working mesh.
    pub(crate) fn point(&self, v: u32) -> Option<SurfacePoint> {
        let piece = &self.pieces()[self.piece_at[v as usize]? as usize];
        let c = piece.vertices.iter().position(|&w| w == v)?;
        Some(SurfacePoint::new(piece.source, piece.barycentric[c]))
    }

    /// Cuts, in the middle, every edge between two taken vertices that is no wall: charts of the regions between walls are
    /// injective then.
    pub(crate) fn cut_dividing_edges(&mut self) {
        let divides = |a: u32, b: u32| self.is_taken(a) && self.is_taken(b) && !self.is_wall(a, b);
        for [a, b] in self.mesh.edges_where(divides) {
            self.cut(a, b, 0.5);
        }
    }
}
