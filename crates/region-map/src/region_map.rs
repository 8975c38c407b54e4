//! How a domain mesh hangs on the network: the paper's regional relationship and its three classes (section 4.2).

use crate::{ArcId, CornerId, Network, SheetId};
use mesh_core::{FaceId, HalfedgeId, Id, IdVec, SurfacePoint, Topology, VertexId};
use std::collections::BTreeMap;

/// Where a domain vertex belongs. The paper's classes one, three and two, in this order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Attachment {
    /// At a corner: it never moves.
    Corner(CornerId),
    /// On an arc at an arc length: it moves along the arc.
    Arc {
        /// The arc.
        arc: ArcId,
        /// Arc length from the arc's first vertex; wraps around on a loop.
        t: f64,
    },
    /// Inside a sheet: it moves over the sheet.
    Sheet(SheetId),
}

/// The part of an arc that a domain edge lies on, from the edge's lower vertex id to its higher one.
///
/// On a loop the arc lengths are not wrapped: `to` may be below 0 or beyond the loop's length, and their difference tells the way round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArcSpan {
    /// The arc.
    pub arc: ArcId,
    /// Arc length at the lower vertex id.
    pub from: f64,
    /// Arc length at the higher vertex id.
    pub to: f64,
}

/// Attachments of the vertices, edges and faces of a domain mesh.
#[derive(Clone, Debug)]
pub struct RegionMap {
    /// Attachment of every domain vertex.
    pub attachments: IdVec<VertexId, Attachment>,
    /// The point of the working mesh that every domain vertex sits at.
    pub points: IdVec<VertexId, SurfacePoint>,
    /// Sheet of every domain face.
    pub sheet_of_face: IdVec<FaceId, SheetId>,
    /// The domain edges that lie on arcs, by their ends in rising order.
    pub spans: BTreeMap<[VertexId; 2], ArcSpan>,
}

/// Why a region map and a domain mesh don't agree.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RegionMapError {
    /// A table is as long as another mesh would need.
    #[error("the region map is of another mesh: {what} has {found} entries, {expected} are needed")]
    WrongSize {
        /// Which table.
        what: &'static str,
        /// Its length.
        found: usize,
        /// The length that the mesh needs.
        expected: usize,
    },
    /// An edge on an arc is not an edge of the mesh.
    #[error("an arc span joins vertices {0} and {1}, which no face joins")]
    NoSuchEdge(VertexId, VertexId),
    /// Two faces that meet at an edge off the arcs belong to different sheets.
    #[error("faces {0} and {1} meet off the arcs and belong to different sheets")]
    SheetChanges(FaceId, FaceId),
    /// A border edge lies on no arc.
    #[error("the border edge between vertices {0} and {1} lies on no arc")]
    BareBorder(VertexId, VertexId),
    /// A vertex is attached to another arc length than a span that ends at it says, or to a sheet that none of its faces is in.
    #[error("vertex {0} is attached to a place that its edges and faces contradict")]
    Misattached(VertexId),
}

impl RegionMap {
    /// The span of the edge between two vertices, as seen from `a` to `b`.
    pub fn span(&self, a: VertexId, b: VertexId) -> Option<ArcSpan> {
        let key = if a < b { [a, b] } else { [b, a] };
        let span = *self.spans.get(&key)?;
        Some(if a < b { span } else { ArcSpan { from: span.to, to: span.from, ..span } })
    }

    /// Sets the span of the edge from `a` to `b`.
    pub fn insert_span(&mut self, a: VertexId, b: VertexId, span: ArcSpan) {
        if a < b {
            self.spans.insert([a, b], span);
        } else {
            self.spans.insert([b, a], ArcSpan { from: span.to, to: span.from, ..span });
        }
    }

    /// Checks that this is a map of the domain mesh with this topology into this network.
    pub fn check(&self, domain: &Topology, network: &Network) -> Result<(), RegionMapError> {
        self.check_sizes(domain)?;
        for (&[a, b], span) in &self.spans {
            domain.find_edge(a, b).ok_or(RegionMapError::NoSuchEdge(a, b))?;
            for (v, t) in [(a, span.from), (b, span.to)] {
                if !self.agrees(network, v, span.arc, t) {
                    return Err(RegionMapError::Misattached(v));
                }
            }
        }
        for e in domain.edge_ids() {
            let [a, b] = domain.ends(e);
            if self.span(a, b).is_some() {
                continue;
            }
            match domain.edge_faces(e) {
                (_, None) => return Err(RegionMapError::BareBorder(a, b)),
                (f, Some(g)) if self.sheet_of_face[f] != self.sheet_of_face[g] => return Err(RegionMapError::SheetChanges(f, g)),
                _ => {}
            }
        }
        for (v, attachment) in self.attachments.enumerate() {
            if let Attachment::Sheet(s) = *attachment
                && domain.fan(v).map(HalfedgeId::face).any(|f| self.sheet_of_face[f] != s)
            {
                return Err(RegionMapError::Misattached(v));
            }
        }
        Ok(())
    }

    fn check_sizes(&self, domain: &Topology) -> Result<(), RegionMapError> {
        let sizes = [
            ("attachments", self.attachments.len(), domain.n_vertices()),
            ("points", self.points.len(), domain.n_vertices()),
            ("sheet_of_face", self.sheet_of_face.len(), domain.n_faces()),
        ];
        match sizes.into_iter().find(|(_, found, expected)| found != expected) {
            Some((what, found, expected)) => Err(RegionMapError::WrongSize { what, found, expected }),
            None => Ok(()),
        }
    }

    /// Does vertex `v` sit at arc length `t` of `arc`, to rounding?
    fn agrees(&self, network: &Network, v: VertexId, arc: ArcId, t: f64) -> bool {
        let a = &network.arcs[arc];
        let near = |x: f64, y: f64| (x - y).abs() <= 1e-9 * a.length();
        match self.attachments[v] {
            Attachment::Sheet(_) => false,
            Attachment::Arc { arc: own, t: own_t } => {
                own == arc
                    && (near(own_t, t)
                        || (a.is_loop() && near((own_t - t).rem_euclid(a.length()).min((t - own_t).rem_euclid(a.length())), 0.0)))
            }
            Attachment::Corner(c) => {
                a.corners.is_some_and(|[first, last]| (first == c && near(t, 0.0)) || (last == c && near(t, a.length())))
            }
        }
    }

    /// How many vertices sit at corners, on arcs and inside sheets.
    pub fn class_counts(&self) -> [usize; 3] {
        let mut counts = [0; 3];
        for a in &self.attachments {
            counts[match a {
                Attachment::Corner(_) => 0,
                Attachment::Arc { .. } => 1,
                Attachment::Sheet(_) => 2,
            }] += 1;
        }
        counts
    }

    /// All vertex ids.
    pub fn vertices(&self) -> impl Iterator<Item = VertexId> + use<> {
        (0..self.attachments.len()).map(VertexId::new)
    }
}
