//! A base mesh that can be changed: flip, split, move and take away a vertex, each recorded in the base map.
//!
//! Every edit keeps the mesh simplicial and its topology, or is refused and changes nothing.

mod moves;
mod removal;
mod replace;
mod samples;

use crate::BaseError;
use crate::layout::quad;
use crate::star::{Face, Ring, edges_of};
use glam::{DVec2, DVec3};
use mesh_core::{FaceId, Id, IdVec, SurfacePoint, TriMesh, VertexId};
use rayon::prelude::*;
use region_map::{ArcSpan, Attachment, BaseMap, BaseMesh, Domain, MapFaceId, RegionMap, Sizing, Surface};
pub(crate) use removal::{Filling, Hole, Removal};
use replace::Edit;
use rustc_hash::FxHashMap;
use samples::{Placed, Samples};

/// An edge counts as at most this many times as long as its chord: half a circle over its diameter.
const LONGEST_DETOUR: f64 = 2.5;
/// The direction of an arc at a vertex is that to the point this far along the edge.
const NEAR_START: f64 = 0.1;
/// Steps in which the length of an edge is measured on the surface.
const LENGTH_STEPS: usize = 4;

/// A base mesh under change. Faces and vertices that are gone leave holes until [`Editor::finish`].
#[derive(Clone)]
pub(crate) struct Editor<'a> {
    surface: &'a Surface,
    faces: IdVec<FaceId, Option<Face>>,
    /// The samples in every face.
    covered: IdVec<FaceId, Vec<Placed>>,
    samples: Samples,
    /// Surface lengths of edges; what the map makes of an edge stays the same as long as the edge is there.
    lengths: FxHashMap<[VertexId; 2], f64>,
    star: IdVec<VertexId, Vec<FaceId>>,
    on_border: IdVec<VertexId, bool>,
    positions: IdVec<VertexId, DVec3>,
    region: RegionMap,
    map: BaseMap,
    n_vertices: usize,
}

impl<'a> Editor<'a> {
    /// Takes a base mesh of the surface apart.
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
    fn find_face(&self, corners: [VertexId; 3]) -> Option<FaceId> {
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
    /// Unit direction in which an edge on an arc leaves `v`, along the arc.
    pub(crate) fn arc_direction(&self, v: VertexId, to: VertexId) -> Option<DVec3> {
        let span = self.span(v, to)?;
        let arc = &self.surface.network().arcs[span.arc];
        let near = arc.position(self.surface.mesh(), span.from + NEAR_START * (span.to - span.from));
        (near - self.positions[v]).try_normalize()
    }
    /// Length on the surface of what the map makes of an edge, on an arc that of its span. A chord would not see a limb that the
    /// edge cuts off; but where the map itself winds, splitting the edge would only wind it more, so the detour is bounded.
    pub(crate) fn surface_length(&self, a: VertexId, b: VertexId) -> f64 {
        self.lengths.get(&[a.min(b), a.max(b)]).copied().unwrap_or_else(|| self.measured_length(a, b))
    }
    /// Bounds of the length of an edge on the surface. They take no time, and neither does the length itself on an arc.
    pub(crate) fn length_bounds(&self, a: VertexId, b: VertexId) -> [f64; 2] {
        let chord = self.positions[a].distance(self.positions[b]);
        if self.span(a, b).is_some() { [0.0, f64::INFINITY] } else { [chord, LONGEST_DETOUR * chord] }
    }
    /// Edges with their lengths on the surface, which are kept.
    pub(crate) fn with_lengths(&mut self, edges: Vec<[VertexId; 2]>) -> Vec<([VertexId; 2], f64)> {
        let lengths: Vec<_> = edges.into_par_iter().map(|[a, b]| ([a, b], self.surface_length(a, b))).collect();
        self.lengths.extend(lengths.iter().copied());
        lengths
    }
    fn measured_length(&self, a: VertexId, b: VertexId) -> f64 {
        if let Some(span) = self.span(a, b) {
            return (span.to - span.from).abs();
        }
        let Some((face, corner)) = self.star[a].iter().find_map(|&f| {
            let face = self.face(f)?;
            Some((face, [face.corner(a)?, face.corner(b)?]))
        }) else {
            return 0.0;
        };
        let along = |i: usize| {
            let s = i as f64 / LENGTH_STEPS as f64;
            let mut weights = DVec3::ZERO;
            (weights[corner[0]], weights[corner[1]]) = (1.0 - s, s);
            self.map.locate(face.map, weights).position(self.surface.mesh())
        };
        let inner = (1..LENGTH_STEPS).map(along).chain([self.positions[b]]);
        let length = inner.fold((0.0, self.positions[a]), |(sum, last), p| (sum + last.distance(p), p)).0;
        length.min(LONGEST_DETOUR * self.positions[a].distance(self.positions[b]))
    }
    /// Length of an edge on the surface over that of its chord, at most [`LONGEST_DETOUR`].
    pub(crate) fn detour(&self, a: VertexId, b: VertexId) -> f64 {
        self.surface_length(a, b) / self.positions[a].distance(self.positions[b]).max(f64::MIN_POSITIVE)
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
    fn star_of(&self, v: VertexId) -> &[FaceId] {
        self.star.get(v).map_or(&[], Vec::as_slice)
    }
    fn face(&self, f: FaceId) -> Option<Face> {
        self.faces[f]
    }

    /// The third vertices of the faces on the left and on the right of the edge from `a` to `b`, with the faces.
    fn beside(&self, a: VertexId, b: VertexId) -> [Option<(FaceId, VertexId)>; 2] {
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

    /// Replaces the edge between `a` and `b` by the other diagonal of its two faces. False when that is no simplicial mesh or the
    /// edge lies on an arc.
    pub(crate) fn flip(&mut self, a: VertexId, b: VertexId) -> bool {
        let [Some((f, c)), Some((g, d))] = self.beside(a, b) else { return false };
        if self.span(a, b).is_some() || c == d || self.is_edge(c, d) {
            return false;
        }
        let [pa, pb, pc, pd] = quad([a, b, c, d].map(|v| self.positions[v]));
        let old = vec![(f, [a, b, c], [pa, pb, pc]), (g, [b, a, d], [pb, pa, pd])];
        let new = vec![([a, d, c], [pa, pd, pc]), ([d, b, c], [pd, pb, pc])];
        self.replace(&[Edit { old, new }], None)
    }

    /// Puts a vertex in the middle of an edge, on an arc at the middle of its span. `None` when that fails.
    pub(crate) fn split(&mut self, a: VertexId, b: VertexId) -> Option<VertexId> {
        let sides = self.beside(a, b);
        let (f, _) = sides[0].or(sides[1])?;
        let face = self.face(f)?;
        let mut weights = DVec3::splat(0.5);
        weights[(0..3).find(|&c| face.vertices[c] != a && face.vertices[c] != b)?] = 0.0;
        let span = self.span(a, b);
        let (attachment, point) = match span {
            Some(s) => {
                let arc = &self.surface.network().arcs[s.arc];
                let t = arc.normalise(0.5 * (s.from + s.to));
                (Attachment::Arc { arc: s.arc, t }, arc.point(self.surface.topology(), t))
            }
            None => (Attachment::Sheet(face.sheet), self.map.locate(face.map, weights)),
        };
        let m = self.add_vertex(attachment, point, sides.contains(&None));
        self.lengths.remove(&[a.min(b), a.max(b)]);
        // Halving a triangle means the same in every layout of it.
        let [pa, pb, pc] = [DVec2::ZERO, DVec2::X, DVec2::Y];
        let pm = pa.midpoint(pb);
        let halved = |(f, c): (FaceId, VertexId), a: VertexId, b: VertexId| Edit {
            old: vec![(f, [a, b, c], [pa, pb, pc])],
            new: vec![([a, m, c], [pa, pm, pc]), ([m, b, c], [pm, pb, pc])],
        };
        let edits = [sides[0].map(|side| halved(side, a, b)), sides[1].map(|side| halved(side, b, a))];
        if !self.replace_anyway(&edits.into_iter().flatten().collect::<Vec<_>>()) {
            return None;
        }
        if let Some(s) = span {
            let middle = 0.5 * (s.from + s.to);
            self.region.spans.remove(&[a.min(b), a.max(b)]);
            self.region.insert_span(a, m, ArcSpan { to: middle, ..s });
            self.region.insert_span(m, b, ArcSpan { from: middle, ..s });
        }
        self.n_vertices += 1;
        Some(m)
    }

    /// Puts a vertex in the middle of a face. `None` when there is no such face.
    pub(crate) fn split_face(&mut self, face: [VertexId; 3]) -> Option<VertexId> {
        let id = self.find_face(face)?;
        let Face { sheet, map, .. } = self.face(id)?;
        let point = self.map.locate(map, DVec3::splat(1.0 / 3.0));
        let m = self.add_vertex(Attachment::Sheet(sheet), point, false);
        // Cutting a triangle at its middle means the same in every layout of it.
        let flat = [DVec2::ZERO, DVec2::X, DVec2::Y];
        let middle = flat.iter().sum::<DVec2>() / 3.0;
        let part = |i: usize| ([face[i], face[(i + 1) % 3], m], [flat[i], flat[(i + 1) % 3], middle]);
        if !self.replace_anyway(&[Edit { old: vec![(id, face, flat)], new: vec![part(0), part(1), part(2)] }]) {
            return None;
        }
        self.n_vertices += 1;
        Some(m)
    }

    fn add_vertex(&mut self, attachment: Attachment, point: SurfacePoint, on_border: bool) -> VertexId {
        self.on_border.push(on_border);
        self.region.attachments.push(attachment);
        self.region.points.push(point);
        self.star.push(Vec::new());
        self.positions.push(point.position(self.surface.mesh()))
    }

    /// The base mesh, without holes in the numbering; corners of the network first, then the rest in order.
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
fn surface_normal(surface: &Surface, map: &BaseMap, face: MapFaceId) -> DVec3 {
    surface.normals().at(map.locate(face, DVec3::splat(1.0 / 3.0)))
}
