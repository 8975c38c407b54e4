//! [`Proxy`]: a smaller surface with the same corners, arcs and sheets.

use crate::collapse::collapsed;
use crate::{ProxyError, ProxyOptions};
use mesh_core::{FaceId, HalfedgeId, Id as _, IdVec, Topology, TriMesh, VertexId};
use region_map::{Arc, ArcId, Network, Sizing, Surface};

/// A small surface that stands for a dense one: some of its vertices, where they were, with the same corners, arcs and sheets by the
/// same ids.
#[derive(Clone, Debug)]
pub struct Proxy {
    /// The small surface. It has no minor creases.
    pub surface: Surface,
    /// For every vertex the vertex of the dense surface that it is.
    pub vertices: IdVec<VertexId, VertexId>,
    /// For every vertex of the dense surface the vertex here that it was merged into.
    pub(crate) stands_for: IdVec<VertexId, VertexId>,
    /// For every arc the arc lengths on the dense surface of its vertices here.
    pub(crate) arc_lengths: IdVec<ArcId, Vec<f64>>,
}

impl Proxy {
    /// The proxy of a surface: its vertices are merged into their neighbours, the flattest places first, as far as the options want. `sizing` says
    /// where edges and distances must be smaller than elsewhere.
    ///
    /// The topology stays, corners stay, and vertices on arcs only go along them. A surface with an interrupt that is set ends early, with more faces
    /// than wanted. Fails where an option is out of its range or the sizing is of another mesh.
    pub fn new(surface: &Surface, sizing: &Sizing, options: &ProxyOptions) -> Result<Self, ProxyError> {
        options.check()?;
        if sizing.relative.len() != surface.mesh().n_vertices() {
            return Err(ProxyError::NotOfSurface);
        }
        let triangles = collapsed(surface, sizing, options);
        let alive: IdVec<VertexId, bool> = (0..surface.mesh().n_vertices()).map(|v| triangles.is_there(v as u32)).collect();
        let vertices: IdVec<VertexId, VertexId> = alive.ids().filter(|&v| alive[v]).collect();
        let mut number = IdVec::filled(VertexId(u32::MAX), alive.len());
        vertices.enumerate().for_each(|(v, &dense)| number[dense] = v);
        let stands_for = triangles.representatives().into_iter().map(|v| number[VertexId(v)]).collect();
        let source: Vec<FaceId> = (0..triangles.faces.len()).filter(|&f| triangles.faces[f].is_some()).map(FaceId::new).collect();
        let faces = triangles.faces.iter().flatten().map(|face| face.map(|v| number[VertexId(v)].0)).collect();
        let mesh = TriMesh::new(vertices.iter().map(|&v| surface.mesh().position(v)).collect(), faces)?;
        let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
        let (network, arc_lengths) = network(surface, &mesh, &topology, &number, &source)?;
        let surface = Surface::new(mesh, topology, network)?.with_interrupt(surface.interrupt().clone());
        Ok(Self { surface, vertices, stands_for, arc_lengths })
    }

    /// A sizing field of the dense surface, at the vertices that are left.
    pub fn sizing(&self, dense: &Sizing) -> Result<Sizing, ProxyError> {
        let relative = self.vertices.iter().map(|&v| dense.relative.get(v).copied()).collect::<Option<_>>();
        relative.map(|relative| Sizing { relative }).ok_or(ProxyError::NotOfSurface)
    }
}

/// The dense network on what is left, and the dense arc lengths of the vertices on its arcs.
fn network(
    dense: &Surface,
    mesh: &TriMesh,
    topology: &Topology,
    number: &IdVec<VertexId, VertexId>,
    source: &[FaceId],
) -> Result<(Network, IdVec<ArcId, Vec<f64>>), ProxyError> {
    let old = dense.network();
    let mut arc_of_edge = IdVec::filled(None, topology.n_edges());
    let (mut arcs, mut arc_lengths) = (IdVec::new(), IdVec::new());
    for (id, arc) in old.arcs.enumerate() {
        let kept = arc.vertices.iter().zip(&arc.lengths).filter(|(v, _)| number[**v].index() < mesh.n_vertices());
        let (vertices, dense_lengths): (Vec<VertexId>, Vec<f64>) = kept.map(|(v, t)| (number[*v], *t)).unzip();
        let (vertices, dense_lengths) = closed(arc, vertices, dense_lengths);
        let edge = |ends: &[VertexId]| {
            let h = topology.find_halfedge(ends[0], ends[1]).or_else(|| topology.find_halfedge(ends[1], ends[0]));
            h.ok_or(ProxyError::LostArcEdge(ends[0], ends[1]))
        };
        let halfedges: Vec<HalfedgeId> = vertices.windows(2).map(edge).collect::<Result<_, _>>()?;
        halfedges.iter().for_each(|&h| arc_of_edge[topology.edge(h)] = Some(id));
        let mut lengths = vec![0.0];
        for ends in vertices.windows(2) {
            lengths.push(lengths[lengths.len() - 1] + mesh.distance(ends[0], ends[1]));
        }
        arcs.push(Arc { vertices, halfedges, lengths, ..arc.clone() });
        arc_lengths.push(dense_lengths);
    }
    let mut corner_of_vertex = IdVec::filled(None, mesh.n_vertices());
    let corners = old.corners.iter().map(|&v| number[v]).collect();
    old.corners.enumerate().for_each(|(c, &v)| corner_of_vertex[number[v]] = Some(c));
    let sheet_of_face = source.iter().map(|&f| old.sheet_of_face[f]).collect();
    let network =
        Network { corners, arcs, arc_of_edge, corner_of_vertex, sheet_of_face, n_sheets: old.n_sheets, minor: Vec::new() };
    Ok((network, arc_lengths))
}

/// The vertices that are left of an arc, with their arc lengths. A loop whose first vertex is gone begins and ends at the next one that is left.
fn closed(arc: &Arc, mut vertices: Vec<VertexId>, mut lengths: Vec<f64>) -> (Vec<VertexId>, Vec<f64>) {
    if arc.is_loop() && vertices.first() != vertices.last() {
        vertices.extend(vertices.first().copied());
        lengths.extend(lengths.first().map(|first| first + arc.length()));
    }
    (vertices, lengths)
}
