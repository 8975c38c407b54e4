//! The feature network: corners, arcs and the sheets between them.

use crate::chain::{spokes, trace_chains};
use glam::DVec3;
use mesh_core::{EdgeId, FaceId, HalfedgeId, Id, IdVec, SurfacePoint, Topology, TriMesh, VertexId, define_id};

define_id! {
    /// A corner of the network: it never moves.
    CornerId "c"
    /// An arc of the network.
    ArcId "a"
    /// A sheet: a part of the surface that no arc crosses.
    SheetId "s"
}

/// What an arc follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArcKind {
    /// A crease.
    Sharp,
    /// The border of the surface.
    Border,
    /// Edges that the user marked.
    Marked,
}

impl ArcKind {
    /// The kinds of all edges by angle alone: borders, and creases where the normals of both faces are more than this apart, in
    /// degrees. For meshes without noise; the crate `features` weighs what it finds.
    pub fn by_angle(mesh: &TriMesh, topology: &Topology, degrees: f64) -> IdVec<EdgeId, Option<Self>> {
        let kind = |e| match topology.edge_faces(e) {
            (_, None) => Some(Self::Border),
            (f, Some(g)) => (mesh.normal(f).angle_between(mesh.normal(g)) > degrees.to_radians()).then_some(Self::Sharp),
        };
        topology.edge_ids().map(kind).collect()
    }
}

/// What any base mesh on a network has at least.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LeastBase {
    /// Vertices.
    pub vertices: usize,
    /// Triangles.
    pub triangles: usize,
}

/// Lengths of creases, in the units of the mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CreaseLengths {
    /// Of those that are arcs.
    pub kept: f64,
    /// Of those that were found and left out.
    pub minor: f64,
}

/// Why there is no network.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NetworkError {
    /// A table is as long as another mesh would need.
    #[error("the network is of another mesh: {what} has {found} entries, {expected} are needed")]
    WrongSize {
        /// Which table.
        what: &'static str,
        /// Its length.
        found: usize,
        /// The length that the mesh needs.
        expected: usize,
    },
    /// A minor crease names a vertex that is not there.
    #[error("a minor crease runs through vertex {0}, which is not there")]
    NoSuchVertex(VertexId),
    /// A table names something that is not there.
    #[error("the network contradicts itself: {0}")]
    Contradiction(&'static str),
}

/// A chain of edges between two corners, or a closed chain without one.
#[derive(Clone, Debug)]
pub struct Arc {
    /// What it follows.
    pub kind: ArcKind,
    /// Vertices in order. A closed chain ends with its first vertex.
    pub vertices: Vec<VertexId>,
    /// For every edge of the chain one of its halfedges, in either direction.
    pub halfedges: Vec<HalfedgeId>,
    /// Arc length up to every vertex, from 0 to [`Arc::length`].
    pub lengths: Vec<f64>,
    /// The corners at both ends (they may be the same one), `None` for a closed chain without corner.
    pub corners: Option<[CornerId; 2]>,
    /// The sheets on its left and on its right, `None` outside of the surface. They are the same where it ends inside a sheet.
    pub sheets: [Option<SheetId>; 2],
}

impl Arc {
    /// Total length.
    pub fn length(&self) -> f64 {
        self.lengths.last().copied().unwrap_or(0.0)
    }

    /// True for a closed chain without a corner, on which arc lengths wrap around.
    pub fn is_loop(&self) -> bool {
        self.corners.is_none()
    }

    /// The arc length `t` brought into `[0, length]`: wrapped around on a loop, else clamped.
    pub fn normalise(&self, t: f64) -> f64 {
        let length = self.length();
        let wrapped = if self.is_loop() && length > 0.0 { t.rem_euclid(length) } else { t };
        wrapped.clamp(0.0, length)
    }

    /// The edge (its index in the chain) at arc length `t`, and how far along it, 0 to 1.
    pub fn segment(&self, t: f64) -> (usize, f64) {
        segment(&self.lengths, self.normalise(t))
    }

    /// The position at arc length `t`.
    pub fn position(&self, mesh: &TriMesh, t: f64) -> DVec3 {
        let (i, s) = self.segment(t);
        mesh.position(self.vertices[i]).lerp(mesh.position(self.vertices[i + 1]), s)
    }

    /// The point at arc length `t`, as a point of a face beside the arc.
    pub fn point(&self, topology: &Topology, t: f64) -> SurfacePoint {
        let (i, s) = self.segment(t);
        on_edge(topology, self.halfedges[i], self.vertices[i], s)
    }

    /// The halfedges along the edge at arc length `t`: the one that runs with the arc (the surface on its left) and the one
    /// against it; one of them is `None` on the border.
    pub fn sides(&self, topology: &Topology, t: f64) -> [Option<HalfedgeId>; 2] {
        let (i, _) = self.segment(t);
        both_sides(topology, self.halfedges[i], self.vertices[i])
    }
}

/// The segment of a polyline with these cumulative lengths that `t` lies on, and how far along it, 0 to 1.
pub(crate) fn segment(lengths: &[f64], t: f64) -> (usize, f64) {
    let last = lengths.len().saturating_sub(2);
    let i = lengths.partition_point(|&l| l <= t).saturating_sub(1).min(last);
    let length = lengths[i + 1] - lengths[i];
    let s = if length > 0.0 { ((t - lengths[i]) / length).clamp(0.0, 1.0) } else { 0.0 };
    (i, s)
}

/// The point `s` (0 to 1) of the way from `start` along the edge of halfedge `h`.
pub(crate) fn on_edge(topology: &Topology, h: HalfedgeId, start: VertexId, s: f64) -> SurfacePoint {
    let s = if topology.from(h) == start { s } else { 1.0 - s };
    let mut point = SurfacePoint::at_corner(h.face(), h.corner());
    point.barycentric[h.corner()] = 1.0 - s;
    point.barycentric[(h.corner() + 1) % 3] = s;
    point
}

/// Corners, arcs and sheets of a working mesh.
#[derive(Clone, Debug)]
pub struct Network {
    /// The vertex of every corner.
    pub corners: IdVec<CornerId, VertexId>,
    /// All arcs.
    pub arcs: IdVec<ArcId, Arc>,
    /// The arc that an edge lies on.
    pub arc_of_edge: IdVec<EdgeId, Option<ArcId>>,
    /// The corner at a vertex.
    pub corner_of_vertex: IdVec<VertexId, Option<CornerId>>,
    /// The sheet of every face.
    pub sheet_of_face: IdVec<FaceId, SheetId>,
    /// Number of sheets.
    pub n_sheets: usize,
    /// Creases that were found and not kept, as chains of vertices.
    pub minor: Vec<Vec<VertexId>>,
}

impl Network {
    /// Traces the arcs along all edges that have a kind, between corners.
    ///
    /// Corners are the vertices for which `is_corner` holds and all whose number of feature edges is neither 0 nor 2, or where
    /// two kinds meet; a vertex without faces is none. Border edges must have a kind (they always bound). `minor` is kept as
    /// given.
    ///
    /// Fails where mesh, topology and `kinds` are of different sizes, or `minor` names a vertex that is not there.
    pub fn trace(
        mesh: &TriMesh,
        topology: &Topology,
        kinds: &IdVec<EdgeId, Option<ArcKind>>,
        is_corner: impl Fn(VertexId) -> bool,
        minor: Vec<Vec<VertexId>>,
    ) -> Result<Self, NetworkError> {
        check_sizes(&[
            ("the topology's list of vertices", topology.n_vertices(), mesh.n_vertices()),
            ("the topology's list of faces", topology.n_faces(), mesh.n_faces()),
            ("the list of kinds", kinds.len(), topology.n_edges()),
        ])?;
        check_minor(&minor, mesh)?;
        let mut corners = IdVec::new();
        let mut corner_of_vertex = IdVec::filled(None, topology.n_vertices());
        for v in mesh.positions().ids() {
            if topology.fan(v).next().is_some() && (is_corner(v) || ends_arcs(topology, kinds, v)) {
                corner_of_vertex[v] = Some(corners.push(v));
            }
        }
        let (regions, n_sheets) = topology.regions(|e| kinds[e].is_none());
        let sheet_of_face: IdVec<FaceId, SheetId> = regions.iter().map(|&r| SheetId(r)).collect();
        let mut arcs = IdVec::new();
        let mut arc_of_edge = IdVec::filled(None, topology.n_edges());
        for chain in trace_chains(topology, |e| kinds[e].is_some(), |v| corner_of_vertex[v].is_some()) {
            let Some(kind) = kinds[topology.edge(chain.halfedges[0])] else { continue };
            for &h in &chain.halfedges {
                arc_of_edge[topology.edge(h)] = Some(ArcId::new(arcs.len()));
            }
            let ends = [chain.vertices[0], chain.vertices[chain.vertices.len() - 1]].map(|v| corner_of_vertex[v]);
            let corners = if let [Some(a), Some(b)] = ends { Some([a, b]) } else { None };
            let sheets = both_sides(topology, chain.halfedges[0], chain.vertices[0]).map(|h| Some(sheet_of_face[h?.face()]));
            let lengths = chain.lengths(mesh);
            arcs.push(Arc { kind, vertices: chain.vertices, halfedges: chain.halfedges, lengths, corners, sheets });
        }
        Ok(Self { corners, arcs, arc_of_edge, corner_of_vertex, sheet_of_face, n_sheets, minor })
    }

    /// Checks that the tables are as long as a mesh and its topology need, and that all that they name is there.
    pub(crate) fn check(&self, mesh: &TriMesh, topology: &Topology) -> Result<(), NetworkError> {
        self.check_sizes(mesh, topology)?;
        let has_vertex = |v: &VertexId| v.index() < mesh.n_vertices();
        let has_sheet = |s: &SheetId| s.index() < self.n_sheets;
        let has_arc = |a: &ArcId| self.arcs.get(*a).is_some();
        let has_corner = |c: &CornerId| self.corners.get(*c).is_some();
        let is_whole = |a: &Arc| {
            let n = a.halfedges.len();
            n > 0
                && (a.vertices.len(), a.lengths.len()) == (n + 1, n + 1)
                && a.vertices.iter().all(has_vertex)
                && a.halfedges.iter().all(|h| h.face().index() < mesh.n_faces())
                && a.corners.iter().flatten().all(has_corner)
                && a.sheets.iter().flatten().all(has_sheet)
        };
        let rules = [
            (self.n_sheets <= mesh.n_faces(), "there are more sheets than faces"),
            (self.sheet_of_face.iter().all(has_sheet), "a face is in a sheet that is not there"),
            (self.arc_of_edge.iter().flatten().all(has_arc), "an edge is on an arc that is not there"),
            (self.corner_of_vertex.iter().flatten().all(has_corner), "a vertex is at a corner that is not there"),
            (self.corners.iter().all(has_vertex), "a corner is at a vertex that is not there"),
            (self.arcs.iter().all(is_whole), "an arc has no edge, tables of different lengths, or parts that are not there"),
        ];
        match rules.into_iter().find(|(is_kept, _)| !is_kept) {
            Some((_, what)) => Err(NetworkError::Contradiction(what)),
            None => check_minor(&self.minor, mesh),
        }
    }

    fn check_sizes(&self, mesh: &TriMesh, topology: &Topology) -> Result<(), NetworkError> {
        check_sizes(&[
            ("the topology's list of vertices", topology.n_vertices(), mesh.n_vertices()),
            ("the topology's list of faces", topology.n_faces(), mesh.n_faces()),
            ("the list of sheets", self.sheet_of_face.len(), mesh.n_faces()),
            ("the list of arcs at edges", self.arc_of_edge.len(), topology.n_edges()),
            ("the list of corners at vertices", self.corner_of_vertex.len(), mesh.n_vertices()),
        ])
    }

    /// True where an edge lies on an arc: nothing may cross it.
    pub fn is_barrier(&self, e: EdgeId) -> bool {
        self.arc_of_edge[e].is_some()
    }

    /// Total length of all arcs.
    pub fn total_length(&self) -> f64 {
        self.arcs.iter().map(Arc::length).sum()
    }

    /// The least vertices and triangles of any base mesh on this network: a vertex at each corner, and on the arcs what keeps base edges
    /// apart (3 edges on a closed arc, 2 where arcs share both ends). The triangles follow by Euler's formula.
    pub fn least_base(&self, topology: &Topology) -> LeastBase {
        let mut ends: Vec<_> = self.arcs.iter().filter_map(|arc| arc.corners).map(|[a, b]| [a.min(b), a.max(b)]).collect();
        ends.sort_unstable();
        let are_shared = |[a, b]: [CornerId; 2]| {
            let first = ends.partition_point(|&e| e < [a.min(b), a.max(b)]);
            ends.get(first + 1) == Some(&[a.min(b), a.max(b)])
        };
        let segments = |arc: &Arc| match arc.corners {
            None => 3,
            Some([a, b]) if a == b => 3,
            // One of those that share their ends may be a single edge.
            Some(ends) => 1 + usize::from(are_shared(ends)),
        };
        let inside = |arc: &Arc| segments(arc) - usize::from(!arc.is_loop());
        let vertices = self.corners.len() + self.arcs.iter().map(inside).sum::<usize>();
        let border: usize = self.arcs.iter().filter(|arc| arc.kind == ArcKind::Border).map(segments).sum();
        let triangles = 2 * (vertices as i64 - topology.euler()) - border as i64;
        LeastBase { vertices, triangles: triangles.max(0) as usize }
    }

    /// How long the creases are.
    pub fn crease_lengths(&self, mesh: &TriMesh) -> CreaseLengths {
        let kept = self.arcs.iter().filter(|arc| arc.kind == ArcKind::Sharp).map(Arc::length).sum();
        CreaseLengths { kept, minor: self.minor.iter().map(|chain| mesh.chain_length(chain)).sum() }
    }
}

/// Checks that minor creases run through vertices that are there.
fn check_minor(minor: &[Vec<VertexId>], mesh: &TriMesh) -> Result<(), NetworkError> {
    match minor.iter().flatten().find(|v| v.index() >= mesh.n_vertices()) {
        Some(&v) => Err(NetworkError::NoSuchVertex(v)),
        None => Ok(()),
    }
}

/// Finds the first table, of those given by name, length and the length needed, that has another length.
fn check_sizes(tables: &[(&'static str, usize, usize)]) -> Result<(), NetworkError> {
    match tables.iter().find(|(_, found, expected)| found != expected) {
        Some(&(what, found, expected)) => Err(NetworkError::WrongSize { what, found, expected }),
        None => Ok(()),
    }
}

/// The two halfedges of the edge of `h`: the one that starts at `start`, and the other one.
pub(crate) fn both_sides(topology: &Topology, h: HalfedgeId, start: VertexId) -> [Option<HalfedgeId>; 2] {
    let twin = topology.twin(h);
    if topology.from(h) == start { [Some(h), twin] } else { [twin, Some(h)] }
}

/// Do arcs end at a vertex because of the edges that meet there?
fn ends_arcs(topology: &Topology, kinds: &IdVec<EdgeId, Option<ArcKind>>, v: VertexId) -> bool {
    let mut at_vertex = spokes(topology, v).filter_map(|h| kinds[topology.edge(h)]);
    match (at_vertex.next(), at_vertex.next(), at_vertex.next()) {
        (None, ..) => false,
        (Some(a), Some(b), None) => a != b,
        _ => true,
    }
}
