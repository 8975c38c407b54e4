//! [`Editor`]: a base mesh that can be changed, and what can be asked of it.
//!
//! Every edit keeps the mesh simplicial and its topology, or is refused and changes nothing.

use super::samples::{Placed, Samples};
use super::star::{Face, Ring, edges_of};
use crate::BaseError;
use glam::DVec3;
use mesh_core::{FaceId, Id, IdVec, TriMesh, VertexId};
use region_map::{ArcSpan, Attachment, BaseMap, BaseMesh, Domain, MapFaceId, RegionMap, Sizing, Surface};
use rustc_hash::FxHashMap;

/// A base mesh under edit. Faces and vertices that are gone leave gaps in the numbering until [`Editor::finish`].
pub(crate) struct Editor<'a> {
    pub(super) surface: &'a Surface,
    pub(super) faces: IdVec<FaceId, Option<Face>>,
    /// The samples of the working mesh in every face.
    pub(super) covered: IdVec<FaceId, Vec<Placed>>,
    pub(super) samples: Samples,
    /// Lengths of edges on the surface, as far as they were asked for. The map does not change where an edge is while it is there.
    pub(super) lengths: FxHashMap<[VertexId; 2], f64>,
    pub(super) star: IdVec<VertexId, Vec<FaceId>>,
    pub(super) on_border: IdVec<VertexId, bool>,
    pub(super) positions: IdVec<VertexId, DVec3>,
    pub(super) region: RegionMap,
    pub(super) map: BaseMap,
    pub(super) n_vertices: usize,
}

impl<'a> Editor<'a> {
    /// Begins with a base mesh of the surface.
    pub(crate) fn new(surface: &'a Surface, base: BaseMesh) -> Self {
        let BaseMesh { domain: Domain { mesh: base, topology, region }, map, map_faces } = base;
        let on_border = base.positions().ids().map(|v| topology.is_border_vertex(v)).collect();
        let mut star = IdVec::filled(Vec::new(), base.n_vertices());
        let mut faces = IdVec::new();
        let (samples, mut content) = Samples::new(surface, &map, map_faces.iter().map(|f| f.index() + 1).max().unwrap_or(0));
        let mut covered = IdVec::new();
        for (f, &vertices) in base.faces().enumerate() {
            let here = covered.push(std::mem::take(&mut content[map_faces[f]]));
            let normal = samples.mean_normal(&covered[here]).unwrap_or_else(|| surface_normal(surface, &map, map_faces[f]));
            faces.push(Some(Face { vertices, sheet: region.sheet_of_face[f], map: map_faces[f], normal }));
            vertices.iter().for_each(|&v| star[v].push(f));
        }
        let n_vertices = star.iter().filter(|s: &&Vec<FaceId>| !s.is_empty()).count();
        Self {
            surface,
            faces,
            covered,
            samples,
            lengths: FxHashMap::default(),
            star,
            on_border,
            positions: base.positions().clone(),
            region,
            map,
            n_vertices,
        }
    }

    /// Whether the work on the surface shall end.
    pub(crate) fn is_interrupted(&self) -> bool {
        self.surface.interrupt().is_set()
    }
    /// Number of vertices now.
    pub(crate) fn n_vertices(&self) -> usize {
        self.n_vertices
    }
    /// All vertices that there are now.
    pub(crate) fn vertices(&self) -> Vec<VertexId> {
        self.star.enumerate().filter(|(_, s)| !s.is_empty()).map(|(v, _)| v).collect()
    }
    /// All faces now.
    pub(crate) fn faces(&self) -> Vec<[VertexId; 3]> {
        self.faces.iter().flatten().map(|f| f.vertices).collect()
    }
    /// True while there is a face with these corners, in this order.
    pub(crate) fn is_face(&self, corners: [VertexId; 3]) -> bool {
        self.find_face(corners).is_some()
    }
    pub(super) fn find_face(&self, corners: [VertexId; 3]) -> Option<FaceId> {
        self.star_of(corners[0]).iter().copied().find(|&f| self.face(f).is_some_and(|f| f.from(corners[0]) == corners))
    }
    /// All edges now, ends rising, in a fixed order.
    pub(crate) fn edges(&self) -> Vec<[VertexId; 2]> {
        edges_of(self.faces.iter().flatten())
    }
    /// The edges of all faces at some vertices, ends rising, in a fixed order.
    pub(crate) fn edges_near(&self, vertices: &[VertexId]) -> Vec<[VertexId; 2]> {
        edges_of(vertices.iter().flat_map(|&v| &self.star[v]).filter_map(|&f| self.faces[f].as_ref()))
    }
    /// True while both vertices are joined.
    pub(crate) fn is_edge(&self, a: VertexId, b: VertexId) -> bool {
        self.star_of(a).iter().any(|&f| self.face(f).is_some_and(|f| f.vertices.contains(&b)))
    }
    /// Position of a vertex.
    pub(crate) fn position(&self, v: VertexId) -> DVec3 {
        self.positions[v]
    }
    /// Attachment of a vertex.
    pub(crate) fn attachment(&self, v: VertexId) -> Attachment {
        self.region.attachments[v]
    }
    /// The angle of the surface at a corner `v`, in degrees, from the arc that leads to `next` counter-clockwise to the arc that leads to `last`; `None`
    /// where `v` is no corner, or one of the two edges is on no arc.
    pub(crate) fn opening(&self, v: VertexId, next: VertexId, last: VertexId) -> Option<f64> {
        let Attachment::Corner(corner) = self.attachment(v) else { return None };
        let (network, mesh, topology) = (self.surface.network(), self.surface.mesh(), self.surface.topology());
        let along = |to: VertexId| {
            let span = self.span(v, to)?;
            let on_arc = &network.arcs[span.arc].vertices;
            if span.from < span.to { on_arc.get(1) } else { on_arc.iter().rev().nth(1) }
        };
        let (first, end) = (along(next)?, along(last)?);
        let start = topology.find_halfedge(network.corners[corner], *first)?;
        let fan = std::iter::successors(Some(start), |h| topology.twin(h.prev()).filter(|&h| h != start));
        let mut degrees = 0.0;
        for h in fan {
            degrees += mesh_core::angles(mesh.triangle(h.face()))[h.corner()].to_degrees();
            if topology.opposite(h) == *end {
                break;
            }
        }
        Some(degrees)
    }
    /// What the sizing field says at a vertex.
    pub(crate) fn size(&self, sizing: &Sizing, v: VertexId) -> f64 {
        sizing.at(self.surface.mesh(), self.region.points[v])
    }
    /// Area of the working mesh.
    pub(crate) fn surface_area(&self) -> f64 {
        self.surface.mesh().total_area()
    }
    /// The part of an arc that an edge lies on.
    pub(crate) fn span(&self, a: VertexId, b: VertexId) -> Option<ArcSpan> {
        // Most edges have an end inside a sheet, and need not be looked for.
        let is_inside = |v: VertexId| matches!(self.attachment(v), Attachment::Sheet(_));
        if is_inside(a) || is_inside(b) { None } else { self.region.span(a, b) }
    }
    /// The faces at a vertex.
    pub(crate) fn faces_at(&self, v: VertexId) -> impl Iterator<Item = Face> + '_ {
        self.star[v].iter().filter_map(|&f| self.face(f))
    }
    /// Positions of the corners of a face.
    pub(crate) fn triangle(&self, f: &Face) -> [DVec3; 3] {
        f.vertices.map(|v| self.positions[v])
    }
    /// Number of edges at a vertex.
    pub(crate) fn valence(&self, v: VertexId) -> usize {
        self.star[v].len() + usize::from(self.on_border[v])
    }
    /// True on the border of the surface.
    pub(crate) fn is_on_border(&self, v: VertexId) -> bool {
        self.on_border[v]
    }
    /// The faces at a vertex; none at one that is not there.
    pub(super) fn star_of(&self, v: VertexId) -> &[FaceId] {
        self.star.get(v).map_or(&[], Vec::as_slice)
    }
    pub(super) fn face(&self, f: FaceId) -> Option<Face> {
        self.faces[f]
    }

    /// The third vertices of the faces on the left and on the right of the edge from `a` to `b`, with the faces.
    pub(super) fn beside(&self, a: VertexId, b: VertexId) -> [Option<(FaceId, VertexId)>; 2] {
        let find = |from: VertexId, to: VertexId| {
            self.star_of(from).iter().find_map(|&f| {
                let [_, next, opposite] = self.face(f)?.from(from);
                (next == to).then_some((f, opposite))
            })
        };
        [find(a, b), find(b, a)]
    }

    /// The faces on the left and on the right of the edge from `a` to `b`, with their third vertices.
    pub(crate) fn faces_beside(&self, a: VertexId, b: VertexId) -> [Option<(Face, VertexId)>; 2] {
        self.beside(a, b).map(|side| side.and_then(|(f, v)| Some((self.face(f)?, v))))
    }

    /// The one-ring of a vertex; `None` for a vertex that is gone.
    pub(crate) fn ring(&self, v: VertexId) -> Option<Ring> {
        let spokes: Vec<(VertexId, VertexId, FaceId)> = self
            .star_of(v)
            .iter()
            .filter_map(|&f| {
                let [_, next, last] = self.face(f)?.from(v);
                Some((next, last, f))
            })
            .collect();
        let first = spokes.iter().find(|s| spokes.iter().all(|t| t.1 != s.0)).or(spokes.first())?;
        let mut ring = Ring { vertices: vec![first.0], faces: Vec::new(), closed: false };
        let mut at = first.0;
        while let Some(s) = spokes.iter().find(|s| s.0 == at)
            && ring.faces.len() < spokes.len()
        {
            ring.faces.push(s.2);
            at = s.1;
            ring.vertices.push(at);
        }
        ring.closed = at == first.0;
        if ring.closed {
            ring.vertices.pop();
        }
        Some(ring)
    }

    /// The base mesh, without gaps in the numbering. Vertices and faces keep their order.
    pub(crate) fn finish(self) -> Result<BaseMesh, BaseError> {
        let mut number = IdVec::<VertexId, Option<VertexId>>::filled(None, self.star.len());
        let (mut attachments, mut points, mut positions) = (IdVec::new(), IdVec::new(), Vec::new());
        for v in self.vertices() {
            number[v] = Some(attachments.push(self.region.attachments[v]));
            points.push(self.region.points[v]);
            positions.push(self.positions[v]);
        }
        let renumbered = |v: VertexId| number[v].ok_or_else(|| BaseError::Internal(format!("vertex {v} is gone but used")));
        let (mut faces, mut map_faces, mut sheet_of_face) = (Vec::new(), IdVec::new(), IdVec::new());
        for face in self.faces.iter().flatten() {
            let [a, b, c] = face.vertices;
            faces.push([renumbered(a)?.0, renumbered(b)?.0, renumbered(c)?.0]);
            map_faces.push(face.map);
            sheet_of_face.push(face.sheet);
        }
        let mut region = RegionMap { attachments, points, sheet_of_face, spans: Default::default() };
        for (&[a, b], &span) in &self.region.spans {
            region.insert_span(renumbered(a)?, renumbered(b)?, span);
        }
        let mesh = TriMesh::new(positions, faces).map_err(|e| BaseError::Internal(e.to_string()))?;
        let domain = Domain::new(mesh, region).map_err(|e| BaseError::Internal(e.to_string()))?;
        domain.check(self.surface.network()).map_err(|e| BaseError::Internal(e.to_string()))?;
        Ok(BaseMesh { domain, map: self.map, map_faces })
    }
}

/// Normal of the surface at the middle of a face of the map.
pub(super) fn surface_normal(surface: &Surface, map: &BaseMap, face: MapFaceId) -> DVec3 {
    surface.normals().at(map.locate(face, DVec3::splat(1.0 / 3.0)))
}
