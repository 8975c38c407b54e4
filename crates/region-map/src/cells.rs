//! The cells of a segmentation: patches, the arcs between them and the corners where arcs meet.

use crate::chain::{Chain, spokes, trace_chains};
use crate::network::{both_sides, on_edge, segment};
use crate::{ArcSpan, Network, PatchId, Segmentation, Surface};
use glam::DVec3;
use mesh_core::{EdgeId, FaceId, HalfedgeId, IdVec, SurfacePoint, Topology, TriMesh, VertexId, define_id};
use rustc_hash::FxHashMap;

define_id! {
    /// A corner of the cells: three or more patches (or the outside) meet there, or it is a corner of the network.
    CellCornerId "cc"
    /// An arc of the cells.
    CellArcId "ca"
}

/// A chain of edges between two patches, or between a patch and the outside.
#[derive(Clone, Debug)]
pub struct CellArc {
    /// Vertices in order. A closed chain ends with its first vertex.
    pub vertices: Vec<VertexId>,
    /// For every edge of the chain one of its halfedges, in either direction.
    pub halfedges: Vec<HalfedgeId>,
    /// Arc length up to every vertex.
    pub lengths: Vec<f64>,
    /// The corners at both ends; the same one twice for a closed chain.
    pub corners: [CellCornerId; 2],
    /// The part of a network arc that this one covers, from first to last vertex; `None` for a smooth arc.
    pub on: Option<ArcSpan>,
}

impl CellArc {
    /// Total length.
    pub fn length(&self) -> f64 {
        self.lengths.last().copied().unwrap_or(0.0)
    }
    /// The point at arc length `t`, as a point of a face beside the arc.
    pub fn point(&self, topology: &Topology, t: f64) -> SurfacePoint {
        let (i, s) = segment(&self.lengths, t);
        on_edge(topology, self.halfedges[i], self.vertices[i], s)
    }
    /// The position at arc length `t`.
    pub fn position(&self, mesh: &TriMesh, t: f64) -> DVec3 {
        let (i, s) = segment(&self.lengths, t);
        mesh.position(self.vertices[i]).lerp(mesh.position(self.vertices[i + 1]), s)
    }
}

/// A patch with its border.
#[derive(Clone, Debug)]
pub struct CellPatch {
    /// Its faces, rising.
    pub faces: Vec<FaceId>,
    /// The arcs round it, the patch on their left; `false` where the arc is run through backwards.
    pub border: Vec<(CellArcId, bool)>,
}

/// Why a segmentation is not a complex of disks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum CellError {
    /// The segmentation is of another mesh.
    #[error("the segmentation is of another mesh, or its number of patches is wrong")]
    OtherMesh,
    /// The border of a patch is not one cycle of distinct vertices: the patch is not a disk.
    #[error("patch {0} is not a disk with a simple border")]
    NotADisk(PatchId),
    /// An arc of the network runs through a patch.
    #[error("an arc of the network runs inside patch {0}")]
    ArcInside(PatchId),
    /// A corner of the network lies inside a patch.
    #[error("a corner of the network (vertex {1}) lies inside patch {0}")]
    CornerInside(PatchId, VertexId),
}

/// Patches, arcs and corners of a segmentation. Every patch is a disk, every arc has different patches (or the outside) beside it.
#[derive(Clone, Debug)]
pub struct Cells {
    /// The vertex of every corner.
    pub corners: IdVec<CellCornerId, VertexId>,
    /// All arcs.
    pub arcs: IdVec<CellArcId, CellArc>,
    /// All patches.
    pub patches: IdVec<PatchId, CellPatch>,
}

impl Cells {
    /// Traces the cells of a segmentation and checks that they are disks which the network bounds.
    pub fn trace(surface: &Surface, segmentation: &Segmentation) -> Result<Self, CellError> {
        let (mesh, topology, network) = (surface.mesh(), surface.topology(), surface.network());
        if !segmentation.fits(mesh) {
            return Err(CellError::OtherMesh);
        }
        let patch = |h: HalfedgeId| segmentation.patch_of_face[h.face()];
        let separates = |e: EdgeId| {
            let h = topology.halfedge(e);
            topology.twin(h).is_none_or(|twin| patch(twin) != patch(h))
        };
        check_connected(topology, segmentation, separates)?;
        if let Some(e) = topology.edge_ids().find(|&e| network.is_barrier(e) && !separates(e)) {
            return Err(CellError::ArcInside(patch(topology.halfedge(e))));
        }
        let mut is_corner = IdVec::<VertexId, bool>::filled(false, topology.n_vertices());
        for v in mesh.positions().ids() {
            let Some(h) = topology.fan(v).next() else { continue };
            let degree = spokes(topology, v).filter(|&h| separates(topology.edge(h))).count();
            is_corner[v] = degree > 2 || network.corner_of_vertex[v].is_some();
            if is_corner[v] && degree == 0 {
                return Err(CellError::CornerInside(patch(h), v));
            }
        }
        let chains = trace_chains(topology, separates, |v| is_corner[v]);
        // A closed chain without corner gets one where the trace began.
        chains.iter().for_each(|c| is_corner[c.vertices[0]] = true);
        let corners: IdVec<CellCornerId, VertexId> = mesh.positions().ids().filter(|&v| is_corner[v]).collect();
        let corner_of: FxHashMap<VertexId, CellCornerId> = corners.enumerate().map(|(c, &v)| (v, c)).collect();
        let arc = |c: Chain| {
            let ends = [c.vertices[0], c.vertices[c.vertices.len() - 1]].map(|v| corner_of[&v]);
            let lengths = c.lengths(mesh);
            let on = covered(topology, network, &c, lengths[lengths.len() - 1]);
            CellArc { lengths, corners: ends, on, vertices: c.vertices, halfedges: c.halfedges }
        };
        let arcs = chains.into_iter().map(arc).collect();
        let patches = borders(topology, segmentation, &arcs)?;
        Ok(Self { corners, arcs, patches })
    }

    /// The patches on the left and on the right of an arc, `None` outside of the surface.
    pub fn beside(&self, topology: &Topology, segmentation: &Segmentation, arc: CellArcId) -> [Option<PatchId>; 2] {
        let a = &self.arcs[arc];
        both_sides(topology, a.halfedges[0], a.vertices[0]).map(|h| Some(segmentation.patch_of_face[h?.face()]))
    }

    /// How many segments every arc needs so that no two base edges have the same ends: 3 on a closed arc, 2 where another arc
    /// shares both ends, else 1.
    pub fn least_segments(&self) -> IdVec<CellArcId, usize> {
        let mut sharing: FxHashMap<[CellCornerId; 2], usize> = FxHashMap::default();
        let sorted = |arc: &CellArc| {
            let [a, b] = arc.corners;
            [a.min(b), a.max(b)]
        };
        for arc in &self.arcs {
            *sharing.entry(sorted(arc)).or_default() += 1;
        }
        let least = |arc: &CellArc| match sorted(arc) {
            [a, b] if a == b => 3,
            both if sharing[&both] > 1 => 2,
            _ => 1,
        };
        self.arcs.iter().map(least).collect()
    }
}

/// A patch in several parts is not a disk, whatever its border and Euler number say.
fn check_connected(
    topology: &Topology,
    segmentation: &Segmentation,
    separates: impl Fn(EdgeId) -> bool,
) -> Result<(), CellError> {
    let (parts, _) = topology.regions(|e| !separates(e));
    let mut part_of: IdVec<PatchId, Option<u32>> = IdVec::filled(None, segmentation.n_patches);
    for (f, &patch) in segmentation.patch_of_face.enumerate() {
        if *part_of[patch].get_or_insert(parts[f]) != parts[f] {
            return Err(CellError::NotADisk(patch));
        }
    }
    Ok(())
}

/// The part of a network arc that a chain of this length covers.
fn covered(topology: &Topology, network: &Network, chain: &Chain, length: f64) -> Option<ArcSpan> {
    let id = network.arc_of_edge[topology.edge(chain.halfedges[0])]?;
    let arc = &network.arcs[id];
    let [first, second] = [chain.vertices[0], chain.vertices[1]];
    let (i, edge) = arc.vertices.windows(2).enumerate().find(|(_, w)| **w == [first, second] || **w == [second, first])?;
    Some(if edge[0] == first {
        ArcSpan { arc: id, from: arc.lengths[i], to: arc.lengths[i] + length }
    } else {
        ArcSpan { arc: id, from: arc.lengths[i + 1], to: arc.lengths[i + 1] - length }
    })
}

/// Walks round every patch and collects its arcs.
fn borders(
    topology: &Topology,
    segmentation: &Segmentation,
    arcs: &IdVec<CellArcId, CellArc>,
) -> Result<IdVec<PatchId, CellPatch>, CellError> {
    // For every patch: start vertex of an arc side -> (arc, direction, end vertex). Distinct starts are part of the disk rule.
    let mut sides: IdVec<PatchId, FxHashMap<VertexId, (CellArcId, bool, VertexId)>> =
        IdVec::filled(FxHashMap::default(), segmentation.n_patches);
    let mut first: IdVec<PatchId, Option<VertexId>> = IdVec::filled(None, segmentation.n_patches);
    for (id, arc) in arcs.enumerate() {
        let (start, end) = (arc.vertices[0], arc.vertices[arc.vertices.len() - 1]);
        let h = arc.halfedges[0];
        for side in [Some(h), topology.twin(h)].into_iter().flatten() {
            let patch = segmentation.patch_of_face[side.face()];
            let forward = topology.from(side) == start;
            let (from, to) = if forward { (start, end) } else { (end, start) };
            if sides[patch].insert(from, (id, forward, to)).is_some() {
                return Err(CellError::NotADisk(patch));
            }
            first[patch].get_or_insert(from);
        }
    }
    let mut patches = IdVec::new();
    for (patch, faces) in segmentation.faces_of_patches().enumerate() {
        let mut border = Vec::new();
        let start = first[patch].ok_or(CellError::NotADisk(patch))?;
        let mut at = start;
        while let Some((arc, forward, to)) = sides[patch].remove(&at) {
            border.push((arc, forward));
            at = to;
        }
        let is_disk = at == start && sides[patch].is_empty() && euler(topology, faces) == 1;
        if !is_disk {
            return Err(CellError::NotADisk(patch));
        }
        patches.push(CellPatch { faces: faces.clone(), border });
    }
    Ok(patches)
}

/// Euler number of a set of faces, as a closed set: 1 for a disk.
fn euler(topology: &Topology, faces: &[FaceId]) -> i64 {
    let mut vertices: Vec<VertexId> = faces.iter().flat_map(|&f| topology.face(f)).collect();
    let mut edges: Vec<EdgeId> = faces.iter().flat_map(|&f| topology.halfedges(f)).map(|h| topology.edge(h)).collect();
    vertices.sort_unstable();
    vertices.dedup();
    edges.sort_unstable();
    edges.dedup();
    vertices.len() as i64 - edges.len() as i64 + faces.len() as i64
}
