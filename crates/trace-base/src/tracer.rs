//! Traces the edges of a base mesh that is tied to a surface, and charts its faces.

use crate::Untraced;
use crate::charts::charts;
use crate::cut_mesh::CutMesh;
use crate::lay::{lay, piece_met_twice};
use crate::path::{End, Way, shortest};
use crate::paths::Paths;
use crate::stops::{Stop, cut_at_stops};
use glam::DVec3;
use mesh_core::{EdgeId, IdVec, Topology, TriMesh, VertexId};
use region_map::{ArcId, Attachment, BaseMap, CornerId, RegionMap, Surface};

/// Points on working edges, where paths may cross them, are this share of a mean base edge apart.
const SPACING: f64 = 0.06;
/// A path that runs through a piece twice cannot be laid: the piece is halved and the path looked for anew, so many times.
const MOST_CUTS: usize = 50;
/// The surface is cut into so many pieces for each of its faces and each base edge at most: edges that wind over needles cut all others into
/// more and more. Measured: 3.1 at most on thirteen models; ADIS16480 with 4,000 base vertices came to 100, and 20 GB.
const MOST_PIECES: usize = 6;
/// So often the edges are traced in another order.
const TRIES: usize = 12;

/// A base mesh, the network that it follows, and where its edges shall run.
pub(crate) struct Tied<'a> {
    /// The surface, with the network that the base mesh follows.
    pub(crate) surface: &'a Surface,
    pub(crate) base: &'a TriMesh,
    /// Of the base mesh.
    pub(crate) topology: &'a Topology,
    /// The base vertex at every corner.
    pub(crate) corners: &'a IdVec<CornerId, VertexId>,
    /// The base vertices along every arc, with both ends. On a loop the last one is the first again, a round further.
    pub(crate) chains: &'a IdVec<ArcId, Vec<Stop>>,
    /// Where every base edge shall run, between its ends; with no points straight.
    pub(crate) via: IdVec<EdgeId, Vec<DVec3>>,
}

impl Tied<'_> {
    /// Traces all edges and charts the faces between them. Vertices inside sheets are moved to where the cut mesh has them.
    ///
    /// Where an edge was shut out by others, or a face has no chart, its edges come first in the next try; it fails where they did so
    /// already.
    pub(crate) fn map(&self, region: &mut RegionMap) -> Result<BaseMap, Untraced> {
        let mut first = Vec::new();
        for _ in 1..TRIES {
            let untraced = match self.try_map(region, &first) {
                Ok(map) => return Ok(map),
                Err(untraced) => untraced,
            };
            let edges = self.edges_of(untraced);
            if first.starts_with(&edges) || matches!(untraced, Untraced::Interrupted | Untraced::TooManyPieces(_)) {
                return Err(untraced);
            }
            first.splice(0..0, edges);
        }
        self.try_map(region, &first)
    }

    fn edges_of(&self, untraced: Untraced) -> Vec<EdgeId> {
        let ends = match untraced {
            Untraced::OtherSurface | Untraced::NotFinite | Untraced::Interrupted | Untraced::TooManyPieces(_) => vec![],
            Untraced::Edge(a, b) => vec![[a, b]],
            Untraced::Face(f) | Untraced::Chart(f) => {
                let [a, b, c] = self.base.face(f);
                vec![[a, b], [b, c], [c, a]]
            }
        };
        ends.into_iter().filter_map(|[a, b]| self.topology.find_edge(a, b)).collect()
    }

    fn try_map(&self, region: &mut RegionMap, first: &[EdgeId]) -> Result<BaseMap, Untraced> {
        let mut tracer = Tracer::new(self, region)?;
        let most_pieces = MOST_PIECES * (self.surface.mesh().n_faces() + self.topology.n_edges());
        for e in tracer.order(first) {
            if self.surface.interrupt().is_set() {
                return Err(Untraced::Interrupted);
            }
            tracer.trace(e)?;
            if tracer.cut.pieces().len() > most_pieces {
                return Err(Untraced::TooManyPieces(most_pieces));
            }
        }
        let map = charts(tracer.cut.clone(), self.base, &tracer.paths)?;
        for v in region.vertices() {
            if let Attachment::Sheet(_) = region.attachments[v] {
                region.points[v] = tracer.cut.point(tracer.vertices[v]).ok_or(Untraced::OtherSurface)?;
            }
        }
        Ok(map)
    }

    /// Where an edge shall run, from its first end to its second.
    fn way(&self, e: EdgeId, [from, to]: [DVec3; 2]) -> Way {
        Way::new([from].into_iter().chain(self.via[e].iter().copied()).chain([to]).collect())
    }

    fn length(&self, e: EdgeId) -> f64 {
        self.way(e, self.topology.ends(e).map(|v| self.base.position(v))).length()
    }
}

struct Tracer<'a> {
    tied: &'a Tied<'a>,
    cut: CutMesh,
    /// The cut mesh's vertex of every base vertex.
    vertices: IdVec<VertexId, u32>,
    paths: Paths,
    spacing: f64,
}

impl<'a> Tracer<'a> {
    /// Makes walls of all arcs, and vertices of all base vertices.
    fn new(tied: &'a Tied<'a>, region: &RegionMap) -> Result<Self, Untraced> {
        let mut cut = CutMesh::new(tied.surface.mesh());
        let network = tied.surface.network();
        let mut vertices: IdVec<VertexId, Option<u32>> = IdVec::filled(None, tied.base.n_vertices());
        for arc in &network.arcs {
            arc.vertices.windows(2).for_each(|w| cut.wall(w[0].0, w[1].0));
        }
        tied.corners.enumerate().for_each(|(c, &v)| vertices[v] = Some(network.corners[c].0));
        let mut paths = Paths::default();
        for (a, chain) in tied.chains.enumerate() {
            let mut run = cut_at_stops(&mut cut, &network.arcs[a], chain).into_iter();
            for pair in chain.windows(2) {
                let [v, w] = [pair[0].vertex, pair[1].vertex];
                // Where two stops are in one place there is no path between them.
                let path = run.next().ok_or(Untraced::Edge(v, w))?;
                (vertices[v], vertices[w]) = (path.first().copied(), path.last().copied());
                paths.keep(v, w, path);
            }
        }
        // Corners without arcs, then all others.
        tied.corners.iter().filter_map(|&v| vertices[v]).for_each(|v| cut.take(v));
        for (v, attachment) in region.attachments.enumerate() {
            if matches!(attachment, Attachment::Sheet(_)) {
                vertices[v] = cut.insert(region.points[v]);
            }
        }
        // Every vertex is at a corner, on an arc or in a sheet.
        let vertices: Option<Vec<u32>> = vertices.into_vec().into_iter().collect();
        let vertices = IdVec::from_vec(vertices.ok_or(Untraced::OtherSurface)?);
        let n = tied.topology.n_edges().max(1) as f64;
        let mean = tied.topology.edge_ids().map(|e| tied.length(e)).sum::<f64>() / n;
        Ok(Self { tied, cut, vertices, paths, spacing: SPACING * mean })
    }

    /// The edges still to trace, in order: those in `first`, then those of a shortest spanning tree, then the others, short ones first. On a
    /// sphere, what is left beside a tree is one disk, so that no edge of the tree shuts another one out.
    fn order(&self, first: &[EdgeId]) -> Vec<EdgeId> {
        let topology = self.tied.topology;
        let mut parent: IdVec<VertexId, VertexId> = self.tied.base.positions().ids().collect();
        let mut open = Vec::new();
        for e in topology.edge_ids() {
            let [a, b] = topology.ends(e);
            if self.paths.has(a, b) {
                join(&mut parent, a, b);
            } else {
                open.push((self.tied.length(e), e));
            }
        }
        open.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let in_tree = |&(_, e): &(f64, EdgeId)| {
            let [a, b] = topology.ends(e);
            join(&mut parent, a, b)
        };
        let (tree, rest): (Vec<_>, Vec<_>) = open.into_iter().partition(in_tree);
        let ordered = tree.into_iter().chain(rest).map(|(_, e)| e);
        // Each once; those to come first may be on arcs, which are traced already.
        let mut is_left = IdVec::<EdgeId, bool>::filled(false, topology.n_edges());
        ordered.clone().for_each(|e| is_left[e] = true);
        first.iter().copied().chain(ordered).filter(|&e| std::mem::replace(&mut is_left[e], false)).collect()
    }

    fn trace(&mut self, e: EdgeId) -> Result<(), Untraced> {
        let [a, b] = self.tied.topology.ends(e);
        let way = self.tied.way(e, [a, b].map(|v| self.cut.positions()[self.vertices[v] as usize]));
        let path = self.laid([a, b], &way).ok_or(Untraced::Edge(a, b))?;
        self.paths.keep(a, b, path);
        Ok(())
    }

    /// The vertices along the shortest path, a wall from now on.
    fn laid(&mut self, [a, b]: [VertexId; 2], way: &Way) -> Option<Vec<u32>> {
        for _ in 0..MOST_CUTS {
            let path = shortest(&self.cut, [&self.end(a, b), &self.end(b, a)], way, self.spacing)?;
            match piece_met_twice(&self.cut, &path) {
                None => return lay(&mut self.cut, &path, self.spacing),
                Some(piece) => self.cut.halve(piece)?,
            };
        }
        None
    }

    /// The end at `v` of the path to `w`. It must leave `v` between the traced edges that come before and after it round `v`.
    fn end(&self, v: VertexId, w: VertexId) -> End {
        let vertex = self.vertices[v];
        let ring: Vec<VertexId> = self.tied.topology.one_ring(v).collect();
        let own = ring.iter().position(|&x| x == w).unwrap_or(0);
        let spoke = |x: VertexId| self.paths.first_step(v, x);
        let n = ring.len();
        let before = (1..n).find_map(|k| spoke(ring[(own + n - k) % n]));
        let after = (1..n).find_map(|k| spoke(ring[(own + k) % n]));
        let sector = match (before, after) {
            (Some(from), Some(to)) => self.cut.sector(vertex, from, to),
            _ => self.cut.fan(vertex),
        };
        End { vertex, sector }
    }
}

/// Joins the trees of two vertices; false when they are one already.
fn join(parent: &mut IdVec<VertexId, VertexId>, a: VertexId, b: VertexId) -> bool {
    let mut root = |mut v: VertexId| {
        while parent[v] != v {
            parent[v] = parent[parent[v]];
            v = parent[v];
        }
        v
    };
    let (a, b) = (root(a), root(b));
    parent[a] = b;
    a != b
}
