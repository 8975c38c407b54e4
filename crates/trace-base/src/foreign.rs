//! The base mesh as it came, and which of its components lies on which of the surface, turned to face the same way.

use crate::TraceError;
use glam::DVec3;
use mesh_core::{FaceId, Id as _, IdVec, SurfaceIndex, Topology, TriMesh, VertexId};
use region_map::Surface;

/// At so many places the distance between two components is measured.
const SAMPLES: usize = 50;
/// The reach of a base vertex: it may be moved this far to a corner or an arc, as a share of the mean length of its edges. Base meshes
/// that were made without regard to creases (by ACVD) have the nearest vertex up to half an edge away.
const REACH: f64 = 0.6;

/// A base mesh in components that are those of the surface.
pub(crate) struct Foreign {
    pub(crate) mesh: TriMesh,
    pub(crate) topology: Topology,
    /// The component of the surface that every vertex belongs to.
    pub(crate) component: IdVec<VertexId, u32>,
    /// How far every vertex may be moved to a corner or an arc.
    pub(crate) reach: IdVec<VertexId, f64>,
}

impl Foreign {
    /// Matches the components of the base mesh with those of the surface and turns those round that face inwards.
    pub(crate) fn new(surface: &Surface, base: &TriMesh) -> Result<Self, TraceError> {
        let (mesh, topology) = (surface.mesh(), surface.topology());
        let base_topology = Topology::new(base.faces(), base.n_vertices())?;
        if let Some(v) = base.positions().ids().find(|&v| base_topology.fan(v).next().is_none()) {
            return Err(TraceError::UnusedVertex(v));
        }
        let theirs = components(base, &base_topology);
        let ours = components(mesh, topology);
        let indices: Vec<SurfaceIndex> = ours.iter().map(|c| SurfaceIndex::of_faces(mesh, c.faces.iter().copied())).collect();
        let other = || TraceError::OtherTopology { base: summary(&theirs), surface: summary(&ours) };
        let matched = matched(base, &theirs, &ours, &indices).ok_or_else(other)?;
        let mut component = IdVec::filled(0, base.n_vertices());
        let mut faces: Vec<[u32; 3]> = base.faces().iter().map(|f| f.map(|v| v.0)).collect();
        for (part, &on) in theirs.iter().zip(&matched) {
            for &f in &part.faces {
                base.face(f).iter().for_each(|&v| component[v] = on as u32);
            }
            if faces_inwards(mesh, base, part, &indices[on]) {
                part.faces.iter().for_each(|f| faces[f.index()].swap(1, 2));
            }
        }
        let turned = TriMesh::new(base.positions().as_slice().to_vec(), faces)?;
        let topology = Topology::new(turned.faces(), turned.n_vertices())?;
        let reach = reach(&turned, &topology);
        Ok(Self { mesh: turned, topology, component, reach })
    }

    /// Where a base vertex came in.
    pub(crate) fn position(&self, v: VertexId) -> DVec3 {
        self.mesh.position(v)
    }
}

/// A connected part of a mesh.
struct Component {
    faces: Vec<FaceId>,
    vertices: Vec<VertexId>,
    euler: i64,
    border_loops: usize,
}

fn components(mesh: &TriMesh, topology: &Topology) -> Vec<Component> {
    let (of_face, n) = topology.components();
    let mut parts: Vec<Component> =
        (0..n).map(|_| Component { faces: Vec::new(), vertices: Vec::new(), euler: 0, border_loops: 0 }).collect();
    for (f, &c) in of_face.enumerate() {
        parts[c as usize].faces.push(f);
        parts[c as usize].euler += 1;
    }
    for v in mesh.positions().ids() {
        if let Some(h) = topology.fan(v).next() {
            let part = &mut parts[of_face[h.face()] as usize];
            part.vertices.push(v);
            part.euler += 1;
        }
    }
    topology.edge_ids().for_each(|e| parts[of_face[topology.edge_faces(e).0] as usize].euler -= 1);
    topology.border_loops().iter().for_each(|l| parts[of_face[l[0].face()] as usize].border_loops += 1);
    parts
}

fn summary(parts: &[Component]) -> String {
    let sum = |f: fn(&Component) -> i64| parts.iter().map(f).sum::<i64>();
    let (loops, euler) = (sum(|c| c.border_loops as i64), sum(|c| c.euler));
    format!("{} components, {loops} border loops and Euler number {euler}", parts.len())
}

/// For every component of the base one of the surface, of the same topology and as near as possible; the nearest pairs first.
fn matched(base: &TriMesh, theirs: &[Component], ours: &[Component], indices: &[SurfaceIndex]) -> Option<Vec<usize>> {
    if theirs.len() != ours.len() {
        return None;
    }
    let mut pairs = Vec::new();
    for (i, a) in theirs.iter().enumerate() {
        for (j, b) in ours.iter().enumerate() {
            if (a.euler, a.border_loops) == (b.euler, b.border_loops) {
                pairs.push((distance(base, a, &indices[j]), i, j));
            }
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut on = vec![None; theirs.len()];
    let mut taken = vec![false; ours.len()];
    for (_, i, j) in pairs {
        if on[i].is_none() && !taken[j] {
            (on[i], taken[j]) = (Some(j), true);
        }
    }
    on.into_iter().collect()
}

/// The mean distance of a component's vertices to a surface.
fn distance(base: &TriMesh, part: &Component, index: &SurfaceIndex) -> f64 {
    let sampled: Vec<VertexId> = part.vertices.iter().copied().step_by(part.vertices.len().div_ceil(SAMPLES).max(1)).collect();
    let sum: f64 = sampled.iter().filter_map(|&v| index.closest(base.position(v))).map(|c| c.distance).sum();
    sum / sampled.len().max(1) as f64
}

/// Does most of a component face against the surface below it?
fn faces_inwards(mesh: &TriMesh, base: &TriMesh, part: &Component, index: &SurfaceIndex) -> bool {
    let along = |&f: &FaceId| {
        let below = index.closest(base.centroid(f))?;
        Some(mesh_core::vector_area(base.triangle(f)).dot(mesh.normal(below.face)))
    };
    part.faces.iter().filter_map(along).sum::<f64>() < 0.0
}

fn reach(base: &TriMesh, topology: &Topology) -> IdVec<VertexId, f64> {
    let reach = |v| {
        let (sum, n) = topology.one_ring(v).fold((0.0, 0), |(sum, n), w| (sum + base.distance(v, w), n + 1));
        REACH * sum / f64::from(n.max(1))
    };
    base.positions().ids().map(reach).collect()
}
