//! Finds the domain vertices for bends and pieces of minor creases.

use crate::assignment::Assignment;
use crate::bends::within;
use crate::minor::Piece;
use crate::path::Path;
use crate::sector::leaves_alike;
use mesh_core::{IdVec, SurfaceIndex, TriMesh, VertexId};
use region_map::{ArcId, Attachment, CornerId, Domain, SheetId, Surface};

/// So many vertices are asked how far the domain is, about.
const DEPTH_SAMPLES: usize = 2_000;

/// An assignment that grows, with what it takes to find vertices.
pub(crate) struct Assigner<'a> {
    pub(crate) assignment: Assignment<'a>,
    /// The faces of the domain.
    index: SurfaceIndex,
    /// The median distance of the surface from the domain.
    typical_depth: f64,
    /// The domain vertex at each corner of the network.
    at_corner: IdVec<CornerId, Option<VertexId>>,
    /// The domain edges on each arc.
    edges_on: IdVec<ArcId, Vec<[VertexId; 2]>>,
    /// Where the vertices of the surface are on arcs, but for those at corners.
    on_arc: IdVec<VertexId, Option<(ArcId, f64)>>,
}

impl<'a> Assigner<'a> {
    pub(crate) fn new(surface: &'a Surface, domain: &'a Domain) -> Self {
        let (network, region) = (surface.network(), &domain.region);
        let mut at_corner = IdVec::filled(None, network.corners.len());
        for (v, attachment) in region.attachments.enumerate() {
            if let Attachment::Corner(c) = *attachment {
                at_corner[c] = Some(v);
            }
        }
        let mut edges_on = IdVec::filled(Vec::new(), network.arcs.len());
        region.spans.iter().for_each(|(&ends, span)| edges_on[span.arc].push(ends));
        let mut on_arc = IdVec::filled(None, surface.mesh().n_vertices());
        for (arc, a) in network.arcs.enumerate() {
            for (&v, &t) in a.vertices.iter().zip(&a.lengths) {
                // A closed arc ends with its first vertex: that is at its beginning.
                if network.corner_of_vertex[v].is_none() && on_arc[v].is_none() {
                    on_arc[v] = Some((arc, t));
                }
            }
        }
        let index = SurfaceIndex::new(&domain.mesh);
        Self {
            assignment: Assignment::new(surface, domain),
            typical_depth: typical_depth(surface.mesh(), &index),
            index,
            at_corner,
            edges_on,
            on_arc,
        }
    }

    /// How much farther a piece of a minor crease lies from the domain, in the mean, than the surface does elsewhere.
    pub(crate) fn depth(&self, piece: &Piece) -> f64 {
        let depths = piece.vertices.iter().map(|&v| depth(self.assignment.surface.mesh(), v, &self.index));
        depths.sum::<f64>() / piece.vertices.len() as f64 / self.typical_depth.max(f64::MIN_POSITIVE)
    }

    /// The domain vertex for a vertex of an arc: the one there, or the nearer free end of the edge that passes it, slid there.
    pub(crate) fn take_on_arc(&mut self, w: VertexId) -> Option<VertexId> {
        if let Some(&v) = self.assignment.corners().get(&w) {
            return Some(v);
        }
        let network = self.assignment.surface.network();
        if let Some(corner) = network.corner_of_vertex[w] {
            return self.at_corner[corner];
        }
        let (arc, t) = self.on_arc[w]?;
        let (edges, spans) = (&self.edges_on[arc], self.assignment.spans());
        let (&ends, along) = edges.iter().find_map(|ends| Some((ends, within(&network.arcs[arc], &spans[ends], t)?)))?;
        let span = spans[&ends];
        let step = along * (span.to - span.from);
        let slides = [(ends[0], step), (ends[1], step - (span.to - span.from))];
        let free = slides.into_iter().filter(|&(v, _)| self.assignment.is_free_on_arc(v));
        let (v, slide) = free.min_by(|(_, a), (_, b)| a.abs().total_cmp(&b.abs()))?;
        self.assignment.slide(v, edges, slide);
        self.assignment.set_corner(w, v);
        Some(v)
    }

    /// The domain vertex for a vertex of a minor crease: as on an arc where it meets one, else the nearest free one in the sheet.
    fn take(&mut self, w: VertexId, sheet: SheetId) -> Option<VertexId> {
        let Assignment { surface, domain, .. } = self.assignment;
        let is_corner = self.assignment.corners().contains_key(&w) || surface.network().corner_of_vertex[w].is_some();
        if is_corner || self.on_arc[w].is_some() {
            return self.take_on_arc(w);
        }
        let position = surface.mesh().position(w);
        let closest = self.index.closest_where(position, |f| domain.region.sheet_of_face[f] == sheet)?;
        let corners = domain.mesh.face(closest.face).into_iter().filter(|&v| self.assignment.is_free_in(v, sheet));
        let from = |v: VertexId| domain.mesh.position(v).distance_squared(position);
        let v = corners.min_by(|&a, &b| from(a).total_cmp(&from(b)).then(a.cmp(&b)))?;
        self.assignment.set_corner(w, v);
        Some(v)
    }

    /// Assigns a path to a piece of a minor crease, and returns its vertices; or nothing, when there is none.
    pub(crate) fn follow(&mut self, piece: &Piece) -> Option<Vec<VertexId>> {
        self.assignment.keep();
        let path = self.path(piece);
        match &path {
            Some(path) => self.assignment.add_piece(piece.clone(), path.clone()),
            None => self.assignment.undo(),
        }
        path
    }

    fn path(&mut self, piece: &Piece) -> Option<Vec<VertexId>> {
        let ([w, w_next, ..], [.., x_next, x]) = (&piece.vertices[..], &piece.vertices[..]) else { return None };
        let [start, end] = [self.take(*w, piece.sheet)?, self.take(*x, piece.sheet)?];
        let path = Path::new(&self.assignment, piece, start, end).shortest()?;
        let ([first, second, ..], [.., before, last]) = (&path[..], &path[..]) else { return None };
        let alike = leaves_alike(&self.assignment, [*first, *second], [*w, *w_next])
            && leaves_alike(&self.assignment, [*last, *before], [*x, *x_next]);
        alike.then_some(path)
    }
}

/// How far a vertex of the working mesh lies from the domain.
fn depth(mesh: &TriMesh, v: VertexId, domain: &SurfaceIndex) -> f64 {
    domain.closest(mesh.position(v)).map_or(0.0, |closest| closest.distance)
}

/// The median depth, of some vertices spread over the working mesh.
fn typical_depth(mesh: &TriMesh, domain: &SurfaceIndex) -> f64 {
    let step = mesh.n_vertices().div_ceil(DEPTH_SAMPLES).max(1);
    let mut depths: Vec<f64> = mesh.positions().ids().step_by(step).map(|v| depth(mesh, v, domain)).collect();
    depths.sort_by(f64::total_cmp);
    depths.get(depths.len() / 2).copied().unwrap_or(0.0)
}
