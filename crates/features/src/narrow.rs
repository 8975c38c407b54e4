//! Tips of sheets between two creases that meet at hardly any angle, as at the end of a step that fades out: they are cut off.
//!
//! Between the two no triangle has an area worth the name, on any level, and a result with triangles without area is refused as a whole.

use crate::crease::{Kinds, away};
use glam::DVec3;
use mesh_core::{FaceId, HalfedgeId, Topology, TriMesh, VertexId, distance_to_segment};
use region_map::{ArcKind, Network, NetworkError, SheetId, spokes};
use std::collections::{BTreeMap, BTreeSet};

/// A tip is cut off where two creases are closer than [`THIN`] for this length, in base edge lengths: there an edge of the third level has a triangle
/// with an angle of half a degree. Wider tips are kept to their ends, with thin triangles: cutting them all off took mean AR of the fixture part from
/// .848 to .838.
const THIN_LENGTH: f64 = 0.125;
/// See [`THIN_LENGTH`], in base edge lengths.
const THIN: f64 = 0.001;
/// A tip that is cut off ends where its creases are as far apart as this, in base edge lengths: a tenth of an edge of the third level.
const BLUNT: f64 = 0.0125;
/// Angle of a sheet between two creases up to which it may have a tip there, in degrees.
const SHARP_ANGLE: f64 = 60.0;
/// Tips are cut off up to this length, in base edge lengths: what is narrow for longer is a strip, and is kept.
const LONGEST: f64 = 2.0;

/// Gives the narrow tips of sheets to the sheet beside: the creases between the two end where they are far enough apart. Returns the network of
/// what is left.
pub(crate) fn cut_narrow_tips(
    mesh: &TriMesh,
    topology: &Topology,
    kinds: &mut Kinds,
    base_edge_length: f64,
) -> Result<Network, NetworkError> {
    let network = Network::trace(mesh, topology, kinds, |_| false, Vec::new())?;
    let sheets = Sheets { mesh, topology, network: &network, base_edge_length };
    let on_creases: BTreeSet<VertexId> = network.arcs.iter().flat_map(|arc| arc.vertices.iter().copied()).collect();
    let tips: Vec<_> = on_creases.into_iter().flat_map(|v| sheets.tips_at(v)).collect();
    if tips.is_empty() {
        return Ok(network);
    }
    for tip in tips {
        sheets.give_away(&sheets.faces_of(&tip), kinds);
    }
    Network::trace(mesh, topology, kinds, |_| false, Vec::new())
}

/// The narrow end of a sheet.
struct Tip {
    /// A face of it.
    first: FaceId,
    /// The creases along its two sides as far as it is narrow, from where they meet.
    sides: [Vec<DVec3>; 2],
}

/// The sheets of a surface with its network.
struct Sheets<'a> {
    mesh: &'a TriMesh,
    topology: &'a Topology,
    network: &'a Network,
    base_edge_length: f64,
}

impl Sheets<'_> {
    fn is_crease(&self, h: HalfedgeId) -> bool {
        let arc = self.network.arc_of_edge[self.topology.edge(h)];
        arc.is_some_and(|arc| self.network.arcs[arc].kind == ArcKind::Sharp)
    }

    /// The narrow tips of sheets at a vertex. Each is between two creases that follow each other around it.
    fn tips_at(&self, v: VertexId) -> Vec<Tip> {
        let spokes: Vec<HalfedgeId> = spokes(self.topology, v).collect();
        let creases: Vec<usize> = (0..spokes.len()).filter(|&i| self.is_crease(spokes[i])).collect();
        if creases.len() < 2 || self.topology.is_border_vertex(v) {
            return Vec::new();
        }
        let n = creases.len();
        let sectors = (0..n).map(|i| {
            let (begin, end) = (creases[i], creases[(i + 1) % n]);
            let len = (end + spokes.len() - begin) % spokes.len();
            (0..=len).map(|k| spokes[(begin + k) % spokes.len()]).collect::<Vec<_>>()
        });
        sectors.filter_map(|sector| self.tip_in(&sector)).collect()
    }

    /// The tip between the first and the last of some halfedges that follow each other around a vertex, if it is narrow.
    fn tip_in(&self, sector: &[HalfedgeId]) -> Option<Tip> {
        let [first, last] = [sector[0], sector[sector.len() - 1]];
        let directions: Vec<DVec3> =
            sector.iter().map(|&h| away(self.mesh, self.topology, self.topology.edge(h), self.topology.from(h))).collect();
        let angle: f64 = directions.windows(2).map(|pair| pair[0].angle_between(pair[1])).sum();
        if angle > SHARP_ANGLE.to_radians() {
            return None;
        }
        let [a, b] = [first, last].map(|h| self.along(h));
        let nearer = |width: f64, side: &[DVec3], other: &[DVec3]| -> Vec<DVec3> {
            side.iter().take_while(|&&p| distance(p, other) < width * self.base_edge_length).copied().collect()
        };
        let is_thin = length(&nearer(THIN, &a, &b)).max(length(&nearer(THIN, &b, &a))) > THIN_LENGTH * self.base_edge_length;
        let sides = [nearer(BLUNT, &a, &b), nearer(BLUNT, &b, &a)];
        let has_end = sides[0].len() < a.len() && sides[1].len() < b.len();
        (is_thin && has_end).then_some(Tip { first: first.face(), sides })
    }

    /// The positions along a crease, from where a halfedge of it begins, to the next corner or beyond the longest tip.
    fn along(&self, mut h: HalfedgeId) -> Vec<DVec3> {
        let begin = self.topology.from(h);
        let mut positions = vec![self.mesh.position(begin)];
        let mut length = 0.0;
        while length < LONGEST * self.base_edge_length {
            let [from, to] = [self.topology.from(h), self.topology.to(h)];
            positions.push(self.mesh.position(to));
            length += self.mesh.distance(from, to);
            let edge = self.topology.edge(h);
            let mut others = spokes(self.topology, to)
                .filter(|&g| self.topology.edge(g) != edge && self.network.is_barrier(self.topology.edge(g)));
            match (others.next(), others.next()) {
                (Some(next), None) if to != begin && self.is_crease(next) && self.topology.from(next) == to => h = next,
                _ => break,
            }
        }
        positions
    }

    /// The faces of a tip: those that hang together with its first face and are near both sides.
    fn faces_of(&self, tip: &Tip) -> BTreeSet<FaceId> {
        let is_narrow =
            |f: FaceId| tip.sides.iter().all(|side| distance(self.mesh.centroid(f), side) < BLUNT * self.base_edge_length);
        let (mut faces, mut open) = (BTreeSet::from([tip.first]), vec![tip.first]);
        while let Some(f) = open.pop() {
            let inner = self.topology.halfedges(f).into_iter().filter(|&h| !self.network.is_barrier(self.topology.edge(h)));
            for g in inner.filter_map(|h| self.topology.twin(h)).map(HalfedgeId::face) {
                if is_narrow(g) && faces.insert(g) {
                    open.push(g);
                }
            }
        }
        faces
    }

    /// Gives faces of a sheet to the one beside with which they share most.
    fn give_away(&self, faces: &BTreeSet<FaceId>, kinds: &mut Kinds) {
        let sides = || faces.iter().flat_map(|&f| self.topology.halfedges(f));
        let beside = |h: HalfedgeId| self.topology.twin(h).map(HalfedgeId::face).filter(|g| !faces.contains(g));
        let mut shared: BTreeMap<SheetId, f64> = BTreeMap::new();
        for (h, g) in sides().filter(|&h| self.is_crease(h)).filter_map(|h| Some((h, beside(h)?))) {
            *shared.entry(self.network.sheet_of_face[g]).or_default() +=
                self.mesh.distance(self.topology.from(h), self.topology.to(h));
        }
        let Some((&taker, _)) = shared.iter().max_by(|a, b| a.1.total_cmp(b.1).then(b.0.cmp(a.0))) else { return };
        for h in sides() {
            let e = self.topology.edge(h);
            let is_taken = beside(h).is_none_or(|g| self.network.sheet_of_face[g] == taker);
            if self.is_crease(h) && is_taken {
                kinds[e] = None;
            } else if !self.network.is_barrier(e) && !is_taken {
                kinds[e] = Some(ArcKind::Sharp);
            }
        }
    }
}

/// From a point to a chain of points.
fn distance(p: DVec3, chain: &[DVec3]) -> f64 {
    chain.windows(2).map(|ends| distance_to_segment(p, ends[0], ends[1])).fold(p.distance(chain[0]), f64::min)
}

fn length(chain: &[DVec3]) -> f64 {
    chain.windows(2).map(|ends| ends[0].distance(ends[1])).sum()
}
