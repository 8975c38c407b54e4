//! The network at the resolution of the base mesh: what is too small or too weak to be worth base vertices is dropped.
//!
//! A scan has creases that are strips of sharp triangles, with spurs on both sides and crumbs beside them. A base vertex at each
//! of their junctions would use up the base mesh before its first smooth patch.

use crate::chains::{Chain, Chains};
use crate::crease::{Creases, Kinds};
use crate::jump::Jumps;
use mesh_core::{EdgeId, FaceId, IdVec, Topology, TriMesh, VertexId};
use region_map::{Arc, ArcId, ArcKind, CornerId, Network, NetworkError, SheetId};
use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};

// Tried together on 17 models (raw and kept corners: rocker-arm 281 and 17 at 174 base vertices, chinese_lion 1638 and 32 at
// 654; of the crease length over 40 degrees fandisk, block and joint keep all, casting .985, crank_cse .993).

/// Sheets with less area than this, in squared base edge lengths, are dissolved: a quarter of a base triangle.
const TINY_SHEET: f64 = 0.1;
/// Spurs with less persistence than this, in base edge lengths, are dropped.
const SPUR: f64 = 0.5;
/// Connected parts of the network with less persistence than this, in base edge lengths, are dropped. Measured: with 1.6, rocker-arm keeps
/// one rim that costs much shape (mean AR .926 instead of .980).
const ISLAND: f64 = 2.0;
/// A closed crease of this mean strength is the rim of a hole or a pin, and kept however short it is, as long as all such take no more than
/// [`RIMS`] of the base vertices, [`LEAST_VERTICES`] each.
const RIM_STRENGTH: f64 = 0.8;
/// See [`RIM_STRENGTH`].
const RIMS: f64 = 0.35;
/// Vertices of a closed base arc.
const LEAST_VERTICES: f64 = 3.0;
/// A crease that stands out from its surroundings, and where the surface jumps, by this angle (degrees) or more has its full length as
/// persistence.
const FULL_ANGLE: f64 = 45.0;
/// Below this angle it has none. Measured: with 0, crumbs on the noise of the fixture organic_raw add up (mean AR .857, with 20 .917), and
/// casting and the fixture scan keep the same creases.
const NO_ANGLE: f64 = 20.0;

/// Drops creases from `kinds` and returns them as chains of vertices. Borders and marked edges stay.
pub(crate) fn simplify(
    mesh: &TriMesh,
    topology: &Topology,
    creases: &Creases,
    kinds: &mut Kinds,
    base_edge_length: f64,
    persistence_factor: f64,
) -> Result<Vec<Vec<VertexId>>, NetworkError> {
    if base_edge_length <= 0.0 {
        return Ok(Vec::new());
    }
    let network = Network::trace(mesh, topology, kinds, |_| false, Vec::new())?;
    let persistence = persistence(mesh, topology, creases, &network, base_edge_length);
    let mut chains = Chains::new(&network, &persistence);
    dissolve_tiny_sheets(mesh, topology, &network, &mut chains, TINY_SHEET * base_edge_length.powi(2));
    drop_weak_spurs(&mut chains, SPUR * persistence_factor);
    drop_weak_islands(&mut chains, network.corners.len(), ISLAND * persistence_factor, Rims::new(mesh, base_edge_length));
    take_dropped(mesh, topology, &network, &chains, kinds)
}

/// Length times strength of every arc, in base edge lengths. The strength of an edge is how much its angle stands out from those of the
/// smooth edges of its two faces, or how much the surface jumps there, whichever is less, as a share of full strength. Noise has a
/// contrast and no jump.
fn persistence(
    mesh: &TriMesh,
    topology: &Topology,
    creases: &Creases,
    network: &Network,
    base_edge_length: f64,
) -> IdVec<ArcId, f64> {
    let smooth = |f: FaceId| topology.halfedges(f).map(|h| topology.edge(h)).into_iter().filter(|&e| !network.is_barrier(e));
    let contrast = |e: EdgeId| {
        let (f, g) = topology.edge_faces(e);
        let around = mean(smooth(f).chain(g.into_iter().flat_map(smooth)).map(|e| creases.angle[e]));
        creases.angle[e] - around
    };
    let jumps = Jumps { mesh, topology, network, base_edge_length };
    let of_edge = |e: EdgeId| {
        let [a, b] = topology.ends(e);
        mesh.distance(a, b) * ((contrast(e).min(jumps.at(e)) - NO_ANGLE) / (FULL_ANGLE - NO_ANGLE)).clamp(0.0, 1.0)
    };
    let of_arc = |arc: &Arc| arc.halfedges.iter().map(|&h| of_edge(topology.edge(h))).sum::<f64>() / base_edge_length;
    network.arcs.iter().map(of_arc).collect()
}

/// The mean, 0 without values.
fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (n, sum) = values.fold((0, 0.0), |(n, sum), x| (n + 1, sum + x));
    sum / f64::from(n.max(1))
}

/// Merges every sheet of less area than `limit` with its neighbour across the chain that stands out least, the smallest first.
fn dissolve_tiny_sheets(mesh: &TriMesh, topology: &Topology, network: &Network, chains: &mut Chains, limit: f64) {
    let mut sheets = Sheets::new(mesh, topology, network);
    let key = |area: f64, sheet: SheetId| Reverse((area.to_bits(), sheet)); // areas are not negative: their bits are in order
    let mut queue: BinaryHeap<_> = sheets.area.enumerate().filter(|&(_, &a)| a < limit).map(|(s, &a)| key(a, s)).collect();
    while let Some(Reverse((bits, sheet))) = queue.pop() {
        if sheets.root(sheet) != sheet || sheets.area[sheet].to_bits() != bits {
            continue; // it has been merged since
        }
        let Some(weakest) = sheets.weakest_side(sheet, chains) else { continue };
        let merged = sheets.merge_across(weakest);
        chains.drop_chain(weakest);
        if sheets.area[merged] < limit {
            queue.push(key(sheets.area[merged], merged));
        }
    }
}

/// Sheets that grow together.
struct Sheets {
    /// Area of every sheet that is not part of another one.
    area: IdVec<SheetId, f64>,
    parent: IdVec<SheetId, SheetId>,
    /// Creases on the border of a sheet, dropped ones and inner ones included.
    arcs: IdVec<SheetId, Vec<ArcId>>,
    beside: IdVec<ArcId, [SheetId; 2]>,
}

impl Sheets {
    fn new(mesh: &TriMesh, topology: &Topology, network: &Network) -> Self {
        let mut area = IdVec::filled(0.0, network.n_sheets);
        for (f, &sheet) in network.sheet_of_face.enumerate() {
            area[sheet] += mesh.area(f);
        }
        let beside: IdVec<ArcId, _> = network
            .arcs
            .iter()
            .map(|arc| {
                let h = arc.halfedges[0];
                [h, topology.twin(h).unwrap_or(h)].map(|h| network.sheet_of_face[h.face()])
            })
            .collect();
        let mut arcs = IdVec::filled(Vec::new(), network.n_sheets);
        for (id, sides) in beside.enumerate() {
            sides.iter().for_each(|&s| arcs[s].push(id));
        }
        Self { parent: area.ids().collect(), area, arcs, beside }
    }

    fn root(&self, mut sheet: SheetId) -> SheetId {
        while self.parent[sheet] != sheet {
            sheet = self.parent[sheet];
        }
        sheet
    }

    /// The crease between this sheet and another one that stands out least.
    fn weakest_side(&self, sheet: SheetId, chains: &Chains) -> Option<ArcId> {
        let is_side = |id: ArcId| {
            let [a, b] = self.beside[id].map(|s| self.root(s));
            a != b
        };
        let sides = self.arcs[sheet].iter().filter_map(|&arc| chains.of_arc(arc));
        let sides = sides.filter(|&(id, s)| s.kind == ArcKind::Sharp && is_side(id));
        sides.min_by(|(i, s), (j, t)| s.strength().total_cmp(&t.strength()).then(i.cmp(j))).map(|(id, _)| id)
    }

    /// Makes one sheet of the two beside an arc: the one with more arcs takes the other.
    fn merge_across(&mut self, arc: ArcId) -> SheetId {
        let [a, b] = self.beside[arc].map(|s| self.root(s));
        let (keep, gone) = if self.arcs[a].len() >= self.arcs[b].len() { (a, b) } else { (b, a) };
        self.parent[gone] = keep;
        self.area[keep] += self.area[gone];
        let taken = std::mem::take(&mut self.arcs[gone]);
        self.arcs[keep].extend(taken);
        keep
    }
}

/// Drops creases with a loose end and little persistence, the weakest first. What a spur leaves behind may be a spur itself.
fn drop_weak_spurs(chains: &mut Chains, limit: f64) {
    let key = |id: ArcId, s: &Chain| (s.persistence.to_bits(), id); // not negative: the bits are in order
    let mut spurs: BTreeSet<_> =
        chains.iter().filter(|(_, s)| is_weak_spur(chains, s, limit)).map(|(id, s)| key(id, s)).collect();
    while let Some((bits, id)) = spurs.pop_first() {
        let is_current = |s: &Chain| s.persistence.to_bits() == bits && is_weak_spur(chains, s, limit);
        if !chains.of_arc(id).is_some_and(|(chain, s)| chain == id && is_current(s)) {
            continue; // it has become part of a longer one
        }
        for joined in chains.drop_chain(id) {
            if let Some((id, s)) = chains.of_arc(joined).filter(|(_, s)| is_weak_spur(chains, s, limit)) {
                spurs.insert(key(id, s));
            }
        }
    }
}

/// True for a weak crease that ends loosely at one end, and not at the other one.
fn is_weak_spur(chains: &Chains, chain: &Chain, limit: f64) -> bool {
    let loose_ends = chain.ends.into_iter().flatten().filter(|&c| chains.degree(c) == 1).count();
    chain.kind == ArcKind::Sharp && loose_ends == 1 && chain.persistence < limit
}

/// Drops connected parts of the network that have only creases and together little persistence.
fn drop_weak_islands(chains: &mut Chains, n_corners: usize, limit: f64, rims: Rims) {
    let mut parent: IdVec<CornerId, CornerId> = (0..n_corners as u32).map(CornerId).collect();
    let root = |parent: &IdVec<CornerId, CornerId>, mut c: CornerId| {
        while parent[c] != c {
            c = parent[c];
        }
        c
    };
    for [a, b] in chains.iter().filter_map(|(_, s)| s.ends) {
        let (a, b) = (root(&parent, a), root(&parent, b));
        parent[a.max(b)] = a.min(b);
    }
    let worth = |s: &Chain| if s.kind == ArcKind::Sharp { s.persistence } else { f64::INFINITY };
    let mut total = IdVec::<CornerId, f64>::filled(0.0, n_corners);
    for (s, [end, _]) in chains.iter().filter_map(|(_, s)| s.ends.map(|e| (s, e))) {
        total[root(&parent, end)] += worth(s);
    }
    let is_weak = |s: &Chain| s.ends.map_or(worth(s), |[end, _]| total[root(&parent, end)]) < limit;
    let weak: Vec<ArcId> = chains.iter().filter(|(_, s)| is_weak(s)).map(|(id, _)| id).collect();
    let rims = rims.among(chains, &weak);
    weak.into_iter().filter(|id| !rims.contains(id)).for_each(|id| {
        chains.drop_chain(id);
    });
}

/// Closed creases at full strength, as the rims of holes are.
struct Rims {
    /// Least strength, as a share of full strength per base edge length.
    strength: f64,
    /// So many at most, the longest.
    most: usize,
}

impl Rims {
    fn new(mesh: &TriMesh, base_edge_length: f64) -> Self {
        let base_vertices = mesh.total_area() / (3f64.sqrt() / 2.0 * base_edge_length.powi(2));
        Self { strength: RIM_STRENGTH / base_edge_length, most: (RIMS * base_vertices / LEAST_VERTICES) as usize }
    }

    fn among(&self, chains: &Chains, some: &[ArcId]) -> BTreeSet<ArcId> {
        let is_rim = |s: &Chain| s.ends.is_none() && s.strength() >= self.strength;
        let rims = some.iter().filter_map(|&id| chains.of_arc(id)).filter(|(_, s)| is_rim(s));
        let mut rims: Vec<(f64, ArcId)> = rims.map(|(id, s)| (s.length, id)).collect();
        rims.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        rims.into_iter().take(self.most).map(|(_, id)| id).collect()
    }
}

/// Takes the dropped arcs out of `kinds`, and returns them as chains.
fn take_dropped(
    mesh: &TriMesh,
    topology: &Topology,
    network: &Network,
    chains: &Chains,
    kinds: &mut Kinds,
) -> Result<Vec<Vec<VertexId>>, NetworkError> {
    let mut dropped = IdVec::filled(None, topology.n_edges());
    for (_, arc) in network.arcs.enumerate().filter(|&(id, _)| chains.of_arc(id).is_none()) {
        for e in arc.halfedges.iter().map(|&h| topology.edge(h)) {
            dropped[e] = kinds[e].take();
        }
    }
    let network = Network::trace(mesh, topology, &dropped, |_| false, Vec::new())?;
    Ok(network.arcs.iter().map(|arc| arc.vertices.clone()).collect())
}
