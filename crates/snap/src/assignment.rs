//! Which vertex of the domain goes where: to a vertex of the surface that becomes a corner, or on the path along a minor crease.

use crate::minor::Piece;
use mesh_core::{IdVec, VertexId};
use region_map::{ArcSpan, Attachment, Domain, SheetId, Surface};
use std::collections::{BTreeMap, BTreeSet};

/// A piece of a minor crease with the domain vertices that shall lie on it, ends included.
#[derive(Clone, Debug)]
pub(crate) struct FollowedPiece {
    pub(crate) piece: Piece,
    pub(crate) path: Vec<VertexId>,
}

/// What has been assigned so far, and the domain and the surface that it is about.
pub(crate) struct Assignment<'a> {
    pub(crate) surface: &'a Surface,
    pub(crate) domain: &'a Domain,
    /// Mean edge length of the domain.
    pub(crate) edge_length: f64,
    /// The spans of the domain's region map, with the vertices that become corners slid to their places.
    spans: BTreeMap<[VertexId; 2], ArcSpan>,
    /// The domain vertex for each vertex of the surface that becomes a corner.
    corners: BTreeMap<VertexId, VertexId>,
    pieces: Vec<FollowedPiece>,
    is_assigned: IdVec<VertexId, bool>,
    /// What has been changed since the last [`Assignment::keep`], in order.
    changes: Vec<Change>,
}

/// A change that can be undone.
enum Change {
    /// A span had another value before.
    Span([VertexId; 2], ArcSpan),
    /// A vertex of the surface got a domain vertex.
    Corner(VertexId),
}

impl<'a> Assignment<'a> {
    pub(crate) fn new(surface: &'a Surface, domain: &'a Domain) -> Self {
        let Domain { mesh, topology, region } = domain;
        let length = |e| {
            let [a, b] = topology.ends(e);
            mesh.distance(a, b)
        };
        Self {
            surface,
            domain,
            edge_length: topology.edge_ids().map(length).sum::<f64>() / topology.n_edges().max(1) as f64,
            spans: region.spans.clone(),
            corners: BTreeMap::new(),
            pieces: Vec::new(),
            is_assigned: IdVec::filled(false, topology.n_vertices()),
            changes: Vec::new(),
        }
    }

    /// The spans as they are by now.
    pub(crate) fn spans(&self) -> &BTreeMap<[VertexId; 2], ArcSpan> {
        &self.spans
    }

    /// The domain vertex for each vertex of the surface that becomes a corner.
    pub(crate) fn corners(&self) -> &BTreeMap<VertexId, VertexId> {
        &self.corners
    }

    /// The pieces of minor creases that have a path.
    pub(crate) fn pieces(&self) -> &[FollowedPiece] {
        &self.pieces
    }

    /// Whether a piece closes a ring of pieces that have a path.
    pub(crate) fn closes_a_ring(&self, piece: &Piece) -> bool {
        let [from, to] = piece.ends();
        let (mut reached, mut open) = (BTreeSet::from([from]), vec![from]);
        while let Some(at) = open.pop() {
            let here = self.pieces.iter().map(|followed| followed.piece.ends()).filter(|ends| ends.contains(&at));
            open.extend(here.flatten().filter(|&v| reached.insert(v)));
        }
        reached.contains(&to)
    }

    /// Is a domain vertex inside this sheet, and not assigned?
    pub(crate) fn is_free_in(&self, v: VertexId, sheet: SheetId) -> bool {
        !self.is_assigned[v] && self.domain.region.attachments[v] == Attachment::Sheet(sheet)
    }

    /// May a domain vertex slide along its arc?
    pub(crate) fn is_free_on_arc(&self, v: VertexId) -> bool {
        !self.is_assigned[v] && matches!(self.domain.region.attachments[v], Attachment::Arc { .. })
    }

    /// Lets the domain vertex `v` take the vertex `w` of the surface, which becomes a corner.
    pub(crate) fn set_corner(&mut self, w: VertexId, v: VertexId) {
        self.corners.insert(w, v);
        self.is_assigned[v] = true;
        self.changes.push(Change::Corner(w));
    }

    /// Moves the ends of the edges at a domain vertex by this arc length.
    pub(crate) fn slide(&mut self, v: VertexId, edges: &[[VertexId; 2]], by: f64) {
        for &ends in edges.iter().filter(|ends| ends.contains(&v)) {
            let Some(span) = self.spans.get_mut(&ends) else { continue };
            self.changes.push(Change::Span(ends, *span));
            if ends[0] == v { span.from += by } else { span.to += by }
        }
    }

    /// Puts the inner vertices of a path on a piece of a minor crease.
    pub(crate) fn add_piece(&mut self, piece: Piece, path: Vec<VertexId>) {
        path.iter().skip(1).rev().skip(1).for_each(|&v| self.is_assigned[v] = true);
        self.pieces.push(FollowedPiece { piece, path });
    }

    /// From here on changes can be undone.
    pub(crate) fn keep(&mut self) {
        self.changes.clear();
    }

    /// Undoes what was assigned to corners, and all slides, since the last [`Assignment::keep`].
    pub(crate) fn undo(&mut self) {
        while let Some(change) = self.changes.pop() {
            match change {
                Change::Span(ends, span) => _ = self.spans.insert(ends, span),
                Change::Corner(w) => {
                    if let Some(v) = self.corners.remove(&w) {
                        self.is_assigned[v] = false;
                    }
                }
            }
        }
    }
}
