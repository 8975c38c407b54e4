//! Who has which vertex of the domain: corners to be, and the paths along minor creases.

use crate::bends::within;
use crate::minor::Piece;
use crate::path::Path;
use crate::sector::leaves_alike;
use mesh_core::{HalfedgeId, IdVec, SurfaceIndex, TriMesh, VertexId};
use region_map::{ArcId, ArcSpan, Attachment, CornerId, Domain, SheetId, Surface};
use std::collections::BTreeMap;

/// So many vertices are asked how far the domain is, about.
const DEPTH_SAMPLES: usize = 2_000;

/// A piece of a minor crease with the domain vertices that shall lie on it, ends included.
#[derive(Clone, Debug)]
pub(crate) struct Track {
    pub(crate) piece: Piece,
    pub(crate) path: Vec<VertexId>,
}

/// The domain and what was claimed of it.
pub(crate) struct Claims<'a> {
    pub(crate) surface: &'a Surface,
    pub(crate) domain: &'a Domain,
    index: SurfaceIndex,
    edge_length: f64,
    typical_depth: f64,
    at_corner: IdVec<CornerId, Option<VertexId>>,
    /// The edges on each arc.
    edges_on: IdVec<ArcId, Vec<[VertexId; 2]>>,
    /// The spans of the map, with the vertices at pins slid there.
    pub(crate) spans: BTreeMap<[VertexId; 2], ArcSpan>,
    /// The domain vertices at vertices of the working mesh that will be corners.
    pub(crate) pins: BTreeMap<VertexId, VertexId>,
    pub(crate) tracks: Vec<Track>,
    /// True for the domain vertices at pins and on tracks.
    taken: IdVec<VertexId, bool>,
}

impl<'a> Claims<'a> {
    pub(crate) fn new(surface: &'a Surface, domain: &'a Domain) -> Self {
        let Domain { mesh, topology, region } = domain;
        let mut at_corner = IdVec::filled(None, surface.network().corners.len());
        for (v, attachment) in region.attachments.enumerate() {
            if let Attachment::Corner(c) = *attachment {
                at_corner[c] = Some(v);
            }
        }
        let mut edges_on = IdVec::filled(Vec::new(), surface.network().arcs.len());
        region.spans.iter().for_each(|(&ends, span)| edges_on[span.arc].push(ends));
        let length = |e| {
            let [a, b] = topology.ends(e);
            mesh.distance(a, b)
        };
        let edge_length = topology.edge_ids().map(length).sum::<f64>() / topology.n_edges().max(1) as f64;
        let index = SurfaceIndex::new(mesh);
        Self {
            surface,
            domain,
            typical_depth: typical_depth(surface.mesh(), &index),
            index,
            edge_length,
            at_corner,
            edges_on,
            spans: region.spans.clone(),
            pins: BTreeMap::new(),
            tracks: Vec::new(),
            taken: IdVec::filled(false, topology.n_vertices()),
        }
    }

    /// Mean edge length of the domain.
    pub(crate) fn edge_length(&self) -> f64 {
        self.edge_length
    }

    /// How much farther a piece of a minor crease lies from the domain, in the mean, than the surface does elsewhere.
    pub(crate) fn depth(&self, piece: &Piece) -> f64 {
        let depths = piece.vertices.iter().map(|&v| depth(self.surface.mesh(), v, &self.index));
        depths.sum::<f64>() / piece.vertices.len() as f64 / self.typical_depth.max(f64::MIN_POSITIVE)
    }

    /// Is a domain vertex inside this sheet, and nobody's?
    pub(crate) fn is_free_in(&self, v: VertexId, sheet: SheetId) -> bool {
        !self.taken[v] && self.domain.region.attachments[v] == Attachment::Sheet(sheet)
    }

    /// The domain vertex for a vertex of an arc: the one there, or the nearer free end of the edge that passes it, slid there.
    pub(crate) fn pin_on_arc(&mut self, w: VertexId) -> Option<VertexId> {
        if let Some(&v) = self.pins.get(&w) {
            return Some(v);
        }
        let network = self.surface.network();
        if let Some(corner) = network.corner_of_vertex[w] {
            return self.at_corner[corner];
        }
        let (arc, t) = self.place_on_arc(w)?;
        let (&ends, along) =
            self.edges_on[arc].iter().find_map(|ends| Some((ends, within(&network.arcs[arc], &self.spans[ends], t)?)))?;
        let span = self.spans[&ends];
        let step = along * (span.to - span.from);
        let slides = [(ends[0], step), (ends[1], step - (span.to - span.from))];
        let is_free = |v: VertexId| !self.taken[v] && matches!(self.domain.region.attachments[v], Attachment::Arc { .. });
        let free = slides.into_iter().filter(|&(v, _)| is_free(v));
        let (v, slide) = free.min_by(|(_, a), (_, b)| a.abs().total_cmp(&b.abs()))?;
        for ends in self.edges_on[arc].iter().filter(|ends| ends.contains(&v)) {
            let span = self.spans.get_mut(ends)?;
            if ends[0] == v { span.from += slide } else { span.to += slide }
        }
        self.take(w, v);
        Some(v)
    }

    fn place_on_arc(&self, w: VertexId) -> Option<(ArcId, f64)> {
        let (topology, network) = (self.surface.topology(), self.surface.network());
        let around = topology.fan(w).flat_map(|h| [h, h.prev()]);
        let arc = around.filter_map(|h| network.arc_of_edge[topology.edge(h)]).next()?;
        let i = network.arcs[arc].vertices.iter().position(|&v| v == w)?;
        Some((arc, network.arcs[arc].lengths[i]))
    }

    /// The domain vertex for a vertex of a minor crease: as on an arc where it meets one, else the nearest free one in the sheet.
    fn pin(&mut self, w: VertexId, sheet: SheetId) -> Option<VertexId> {
        let network = self.surface.network();
        if self.pins.contains_key(&w) || network.corner_of_vertex[w].is_some() || self.place_on_arc(w).is_some() {
            return self.pin_on_arc(w);
        }
        let position = self.surface.mesh().position(w);
        let closest = self.index.closest_where(position, |f| self.domain.region.sheet_of_face[f] == sheet)?;
        let corners = self.domain.mesh.face(closest.face).into_iter().filter(|&v| self.is_free_in(v, sheet));
        let from = |v: VertexId| self.domain.mesh.position(v).distance_squared(position);
        let v = corners.min_by(|&a, &b| from(a).total_cmp(&from(b)).then(a.cmp(&b)))?;
        self.take(w, v);
        Some(v)
    }

    fn take(&mut self, w: VertexId, v: VertexId) {
        self.pins.insert(w, v);
        self.taken[v] = true;
    }

    /// Claims a path along a piece of a minor crease, and returns its vertices; or nothing, when there is none.
    pub(crate) fn follow(&mut self, piece: &Piece) -> Option<Vec<VertexId>> {
        let (spans, pins) = (self.spans.clone(), self.pins.clone());
        let path = self.path(piece);
        if let Some(path) = &path {
            path[1..path.len() - 1].iter().for_each(|&v| self.taken[v] = true);
            self.tracks.push(Track { piece: piece.clone(), path: path.clone() });
        } else {
            self.pins.iter().filter(|(w, _)| !pins.contains_key(w)).for_each(|(_, &v)| self.taken[v] = false);
            (self.spans, self.pins) = (spans, pins);
        }
        path
    }

    fn path(&mut self, piece: &Piece) -> Option<Vec<VertexId>> {
        let ([w, w_next, ..], [.., x_next, x]) = (&piece.vertices[..], &piece.vertices[..]) else { return None };
        let [start, end] = [self.pin(*w, piece.sheet)?, self.pin(*x, piece.sheet)?];
        let path = Path { claims: self, piece, start, end }.shortest()?;
        let [leaving, arriving] = [[path[0], path[1]], [path[path.len() - 1], path[path.len() - 2]]];
        let alike = leaves_alike(self, leaving, [*w, *w_next]) && leaves_alike(self, arriving, [*x, *x_next]);
        alike.then_some(path)
    }

    /// The domain faces around a vertex, as halfedges that leave it.
    pub(crate) fn spokes(&self, v: VertexId) -> impl Iterator<Item = HalfedgeId> + '_ {
        self.domain.topology.fan(v)
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
