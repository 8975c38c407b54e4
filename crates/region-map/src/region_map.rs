//! How a domain mesh hangs on the network: the paper's regional relationship and its three classes (section 4.2).

use crate::{ArcId, CornerId, Network, SheetId};
use mesh_core::{FaceId, Id, IdVec, SurfacePoint, Topology, VertexId};
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

/// How many domain vertices are attached to what.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ClassCounts {
    /// At corners.
    pub at_corners: usize,
    /// On arcs, between their ends.
    pub on_arcs: usize,
    /// Inside sheets.
    pub in_sheets: usize,
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
    /// A face is in a sheet that the network does not have.
    #[error("face {0} is in a sheet that the network does not have")]
    NoSuchSheet(FaceId),
    /// Two faces that meet at an edge off the arcs belong to different sheets.
    #[error("faces {0} and {1} meet off the arcs and belong to different sheets")]
    SheetChanges(FaceId, FaceId),
    /// A border edge lies on no arc.
    #[error("the border edge between vertices {0} and {1} lies on no arc")]
    BareBorder(VertexId, VertexId),
    /// The faces beside an edge on an arc are not in the sheets beside the arc.
    #[error("the faces beside the edge between vertices {0} and {1} are not in the sheets beside its arc")]
    WrongSide(VertexId, VertexId),
    /// The edges along an arc leave a part of it out, or cover it twice.
    #[error("the edges on arc {0} do not cover it once")]
    ArcNotCovered(ArcId),
    /// A corner without a vertex.
    #[error("no vertex is at corner {0} of the network")]
    EmptyCorner(CornerId),
    /// A vertex is attached to a place that does not exist, to another arc length than a span that ends at it says, to a sheet
    /// that one of its faces is not in, to a corner that another vertex is at, or has the wrong number of spans.
    #[error("vertex {0} is attached to a place that the network, its edges or its faces contradict")]
    Misattached(VertexId),
}

/// Arc lengths agree to rounding: to this share of the length of their arc.
const SAME_LENGTH: f64 = 1e-9;

impl RegionMap {
    /// The map of a working mesh onto itself: for a mesh that serves as its own base mesh.
    ///
    /// The network must be one of this mesh, as that of a `Surface` is; else the map fits neither.
    pub fn identity(topology: &Topology, network: &Network) -> Self {
        let point = |v| {
            topology
                .fan(v)
                .next()
                .map_or(SurfacePoint::at_corner(FaceId(0), 0), |h| SurfacePoint::at_corner(h.face(), h.corner()))
        };
        let points: IdVec<VertexId, SurfacePoint> = (0..topology.n_vertices()).map(|i| point(VertexId::new(i))).collect();
        let sheet = |p: &SurfacePoint| network.sheet_of_face.get(p.face).copied().unwrap_or(SheetId(0));
        let attachments = points.iter().map(|p| Attachment::Sheet(sheet(p))).collect();
        let mut map = Self { attachments, points, sheet_of_face: network.sheet_of_face.clone(), spans: BTreeMap::new() };
        let is_there = |v: VertexId| v.index() < topology.n_vertices();
        for (arc, a) in network.arcs.enumerate().filter(|(_, a)| a.vertices.iter().all(|&v| is_there(v))) {
            for (v, t) in a.vertices.windows(2).zip(a.lengths.windows(2)) {
                map.attachments[v[0]] = Attachment::Arc { arc, t: t[0] };
                map.insert_span(v[0], v[1], ArcSpan { arc, from: t[0], to: t[1] });
            }
        }
        for (c, &v) in network.corners.enumerate().filter(|(_, v)| is_there(**v)) {
            map.attachments[v] = Attachment::Corner(c);
        }
        map
    }

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

    /// Checks that this is a map of the domain mesh with this topology into this network: all corners and arcs are there, every
    /// vertex, edge and face is where its neighbours say, and all borders are on arcs.
    ///
    /// The points are only checked to be on faces that exist: in a subdivided domain they follow with the projection.
    pub fn check(&self, domain: &Topology, network: &Network) -> Result<(), RegionMapError> {
        self.check_sizes(domain)?;
        for (v, point) in self.points.enumerate() {
            if network.sheet_of_face.get(point.face).is_none() || !point.barycentric.is_finite() {
                return Err(RegionMapError::Misattached(v));
            }
        }
        self.check_spans(domain, network)?;
        self.check_vertices(domain, network)?;
        self.check_edges(domain, network)?;
        self.check_arcs(network)
    }

    /// Checks that the tables are as long as the domain mesh with this topology needs.
    pub fn check_sizes(&self, domain: &Topology) -> Result<(), RegionMapError> {
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

    /// Spans are on edges, and their ends are attached to their arc lengths.
    fn check_spans(&self, domain: &Topology, network: &Network) -> Result<(), RegionMapError> {
        for (&[a, b], span) in &self.spans {
            // The lower end comes first, so both are there where the higher one is.
            let is_there = a < b && b.index() < domain.n_vertices() && domain.find_edge(a, b).is_some();
            if !is_there {
                return Err(RegionMapError::NoSuchEdge(a, b));
            }
            for (v, t) in [(a, span.from), (b, span.to)] {
                if !self.agrees(network, v, span.arc, t) {
                    return Err(RegionMapError::Misattached(v));
                }
            }
        }
        Ok(())
    }

    /// A vertex on an arc has two spans, one at a corner as many as arcs end there, one in a sheet only faces in that sheet.
    fn check_vertices(&self, domain: &Topology, network: &Network) -> Result<(), RegionMapError> {
        let mut arc_ends = IdVec::<CornerId, usize>::filled(0, network.corners.len());
        network.arcs.iter().filter_map(|a| a.corners).flatten().for_each(|c| arc_ends[c] += 1);
        let mut n_spans = IdVec::<VertexId, usize>::filled(0, self.attachments.len());
        self.spans.keys().flatten().for_each(|&v| n_spans[v] += 1);
        let mut taken = IdVec::<CornerId, bool>::filled(false, network.corners.len());
        for (v, attachment) in self.attachments.enumerate() {
            let fits = match *attachment {
                Attachment::Corner(c) => arc_ends.get(c) == Some(&n_spans[v]) && !std::mem::replace(&mut taken[c], true),
                Attachment::Arc { arc, t } => network.arcs.get(arc).is_some() && t.is_finite() && n_spans[v] == 2,
                Attachment::Sheet(s) => domain.fan(v).all(|h| self.sheet_of_face[h.face()] == s) && s.index() < network.n_sheets,
            };
            if !fits {
                return Err(RegionMapError::Misattached(v));
            }
        }
        match taken.enumerate().find(|(_, taken)| !**taken) {
            Some((c, _)) => Err(RegionMapError::EmptyCorner(c)),
            None => Ok(()),
        }
    }

    /// Faces are in sheets; across an edge these are the same, across one on an arc those beside the arc.
    fn check_edges(&self, domain: &Topology, network: &Network) -> Result<(), RegionMapError> {
        if let Some((f, _)) = self.sheet_of_face.enumerate().find(|(_, s)| s.index() >= network.n_sheets) {
            return Err(RegionMapError::NoSuchSheet(f));
        }
        for e in domain.edge_ids() {
            let [a, b] = domain.ends(e);
            let (f, g) = domain.edge_faces(e);
            let Some(span) = self.span(a, b) else {
                match g {
                    None => return Err(RegionMapError::BareBorder(a, b)),
                    Some(g) if self.sheet_of_face[f] != self.sheet_of_face[g] => return Err(RegionMapError::SheetChanges(f, g)),
                    Some(_) => continue,
                }
            };
            // The edge's halfedge runs from a to b: its face is on the left.
            let [left, right] = network.arcs[span.arc].sheets;
            let expected = if span.from <= span.to { [left, right] } else { [right, left] };
            if [Some(f), g].map(|f| Some(self.sheet_of_face[f?])) != expected {
                return Err(RegionMapError::WrongSide(a, b));
            }
        }
        Ok(())
    }

    /// The spans of every arc add up to it.
    fn check_arcs(&self, network: &Network) -> Result<(), RegionMapError> {
        let mut covered = IdVec::<ArcId, f64>::filled(0.0, network.arcs.len());
        self.spans.values().for_each(|s| covered[s.arc] += (s.to - s.from).abs());
        for (id, arc) in network.arcs.enumerate() {
            // Every span adds the rounding of its two ends.
            let tolerance = SAME_LENGTH * arc.length() * self.spans.len().max(1) as f64;
            if (covered[id] - arc.length()).abs() > tolerance {
                return Err(RegionMapError::ArcNotCovered(id));
            }
        }
        Ok(())
    }

    /// Does vertex `v` sit at arc length `t` of `arc`, to rounding?
    fn agrees(&self, network: &Network, v: VertexId, arc: ArcId, t: f64) -> bool {
        let Some(a) = network.arcs.get(arc) else { return false };
        let near = |x: f64, y: f64| (x - y).abs() <= SAME_LENGTH * a.length();
        match self.attachments[v] {
            Attachment::Sheet(_) => false,
            Attachment::Arc { arc: own, t: own_t } if a.is_loop() => {
                let apart = (a.normalise(own_t) - a.normalise(t)).abs();
                own == arc && near(apart.min(a.length() - apart), 0.0)
            }
            Attachment::Arc { arc: own, t: own_t } => own == arc && near(own_t, t),
            Attachment::Corner(c) => {
                a.corners.is_some_and(|[first, last]| (first == c && near(t, 0.0)) || (last == c && near(t, a.length())))
            }
        }
    }

    /// How many vertices belong to each of the paper's classes.
    pub fn class_counts(&self) -> ClassCounts {
        let mut counts = ClassCounts::default();
        for a in &self.attachments {
            *match a {
                Attachment::Corner(_) => &mut counts.at_corners,
                Attachment::Arc { .. } => &mut counts.on_arcs,
                Attachment::Sheet(_) => &mut counts.in_sheets,
            } += 1;
        }
        counts
    }

    /// All vertex ids.
    pub fn vertices(&self) -> impl Iterator<Item = VertexId> + use<> {
        (0..self.attachments.len()).map(VertexId::new)
    }
}
