//! Which base vertices sit at corners, and which base edges follow which arc.
//!
//! Arcs that no base edges follow are given up: what a base mesh does not have, its subdivision cannot keep. Borders are never given up.

use crate::TraceError;
use crate::follow::Followed;
use crate::foreign::Foreign;
use crate::stops::Stop;
use mesh_core::{EdgeId, FaceId, Id as _, IdVec, Topology, TriMesh, VertexId};
use region_map::{Arc, ArcId, ArcKind, CornerId, Network, NetworkError, SheetId, SurfaceError};
use rustc_hash::FxHashSet;

/// A network that the base mesh follows, and how.
pub(crate) struct Attached {
    pub(crate) network: Network,
    /// The base vertex at every corner.
    pub(crate) corners: IdVec<CornerId, VertexId>,
    /// The base vertices along every arc, with both ends. On a loop the last one is the first again, a round further.
    pub(crate) chains: IdVec<ArcId, Vec<Stop>>,
    /// The sheet of every base face.
    pub(crate) sheet_of_face: IdVec<FaceId, SheetId>,
}

/// What of a network the base mesh does not follow.
#[derive(Default)]
struct Misfit {
    corners: Vec<CornerId>,
    arcs: Vec<ArcId>,
}

/// Attaches a base mesh to as much of a network as it follows.
pub(crate) fn attach(mesh: &TriMesh, topology: &Topology, network: &Network, base: &Foreign) -> Result<Attached, TraceError> {
    let mut wanted = Wanted::new(topology, network);
    loop {
        let network = wanted.network(mesh, topology).map_err(SurfaceError::from)?;
        match fit(mesh, topology, &network, base) {
            Ok(Fit { corners, chains, sheet_of_face }) => return Ok(Attached { network, corners, chains, sheet_of_face }),
            Err(misfit) => {
                if !wanted.give_up(topology, &network, &misfit) {
                    return Err(TraceError::Border(nearest_to(mesh, &network, &misfit, base)));
                }
            }
        }
    }
}

/// What is left of the network.
struct Wanted {
    kinds: IdVec<EdgeId, Option<ArcKind>>,
    is_corner: IdVec<VertexId, bool>,
    minor: Vec<Vec<VertexId>>,
}

impl Wanted {
    fn new(topology: &Topology, network: &Network) -> Self {
        let kinds = topology.edge_ids().map(|e| network.arc_of_edge[e].map(|a| network.arcs[a].kind)).collect();
        let is_corner = network.corner_of_vertex.iter().map(Option::is_some).collect();
        Self { kinds, is_corner, minor: network.minor.clone() }
    }

    fn network(&self, mesh: &TriMesh, topology: &Topology) -> Result<Network, NetworkError> {
        Network::trace(mesh, topology, &self.kinds, |v| self.is_corner[v], self.minor.clone())
    }

    /// Makes corners plain vertices of their arcs, or where that cannot be takes their arcs away; false when nothing can be given up.
    fn give_up(&mut self, topology: &Topology, network: &Network, misfit: &Misfit) -> bool {
        let mut changed = false;
        let mut arcs: FxHashSet<ArcId> =
            misfit.arcs.iter().copied().filter(|&a| network.arcs[a].kind != ArcKind::Border).collect();
        for &corner in &misfit.corners {
            let v = network.corners[corner];
            changed |= std::mem::replace(&mut self.is_corner[v], false);
            let kinds: Vec<ArcKind> = topology.one_ring(v).filter_map(|w| self.kinds[topology.find_edge(v, w)?]).collect();
            if !matches!(kinds[..], [a, b] if a == b) {
                let ends_here = |a: &Arc| a.kind != ArcKind::Border && a.corners.is_some_and(|c| c.contains(&corner));
                arcs.extend(network.arcs.enumerate().filter(|(_, a)| ends_here(a)).map(|(id, _)| id));
            }
        }
        let mut arcs: Vec<ArcId> = arcs.into_iter().collect();
        arcs.sort_unstable();
        for &a in &arcs {
            let arc = &network.arcs[a];
            arc.halfedges.iter().for_each(|&h| self.kinds[topology.edge(h)] = None);
            self.minor.push(arc.vertices.clone());
        }
        // A corner that has lost all its arcs is no corner any more.
        for v in arcs.iter().flat_map(|&a| network.arcs[a].corners).flatten().map(|c| network.corners[c]) {
            let is_bare = topology.one_ring(v).all(|w| topology.find_edge(v, w).is_none_or(|e| self.kinds[e].is_none()));
            self.is_corner[v] &= !is_bare;
        }
        // Only borders are left that do not fit: they may fit without the corners on them.
        if arcs.is_empty() && !changed {
            for &a in &misfit.arcs {
                for c in network.arcs[a].corners.into_iter().flatten() {
                    changed |= std::mem::replace(&mut self.is_corner[network.corners[c]], false);
                }
            }
        }
        changed || !arcs.is_empty()
    }
}

/// A base vertex near to what could not be given up, to name it.
fn nearest_to(mesh: &TriMesh, network: &Network, misfit: &Misfit, base: &Foreign) -> VertexId {
    let vertex =
        misfit.arcs.first().map(|&a| network.arcs[a].vertices[0]).or(misfit.corners.first().map(|&c| network.corners[c]));
    let at = vertex.map_or(glam::DVec3::ZERO, |v| mesh.position(v));
    let nearest = base.mesh.positions().enumerate().min_by(|a, b| a.1.distance(at).total_cmp(&b.1.distance(at)));
    nearest.map_or(VertexId(0), |n| n.0)
}

/// What [`Attached`] has beside the network.
struct Fit {
    corners: IdVec<CornerId, VertexId>,
    chains: IdVec<ArcId, Vec<Stop>>,
    sheet_of_face: IdVec<FaceId, SheetId>,
}

/// Attaches to all of a network, or tells what does not fit.
fn fit(mesh: &TriMesh, topology: &Topology, network: &Network, base: &Foreign) -> Result<Fit, Misfit> {
    let component = topology.components().0;
    let component_of = |v: VertexId| topology.fan(v).next().map(|h| component[h.face()]);
    let found = match_corners(mesh, topology, network, base, component_of);
    let missing: Vec<CornerId> = found.enumerate().filter(|(_, v)| v.is_none()).map(|(c, _)| c).collect();
    if !missing.is_empty() {
        return Err(Misfit { corners: missing, ..Misfit::default() });
    }
    let corners: IdVec<CornerId, VertexId> = found.iter().copied().flatten().collect();
    let mut followed = Followed::new(mesh, network, base, &corners);
    let mut order: Vec<ArcId> = network.arcs.ids().collect();
    // Borders cannot be given up, and the shorter an arc the fewer edges can follow it.
    order.sort_by(|&a, &b| {
        let key = |a: ArcId| (network.arcs[a].kind != ArcKind::Border, network.arcs[a].length().to_bits());
        key(a).cmp(&key(b))
    });
    let mut chains = IdVec::filled(Vec::new(), network.arcs.len());
    let mut lost = Vec::new();
    for a in order {
        let arc = &network.arcs[a];
        let component = component_of(arc.vertices[0]).unwrap_or(0);
        match followed.chain(mesh, arc, arc.corners.map(|c| c.map(|c| corners[c])), component) {
            Some(chain) => chains[a] = chain,
            None => lost.push(a),
        }
    }
    if lost.is_empty() {
        lost = bare_borders(network, base, &chains);
    }
    if !lost.is_empty() {
        return Err(Misfit { arcs: lost, ..Misfit::default() });
    }
    let sheet_of_face = sheets(topology, network, base, &chains).map_err(|arcs| Misfit { arcs, ..Misfit::default() })?;
    // A corner without arcs, a cone tip, must be in the sheet of its base vertex.
    let strays = |&(c, &v): &(CornerId, &VertexId)| {
        let ours = topology.fan(network.corners[c]).map(|h| network.sheet_of_face[h.face()]);
        let theirs: Vec<SheetId> = base.topology.fan(v).map(|h| sheet_of_face[h.face()]).collect();
        !ours.into_iter().any(|s| theirs.contains(&s))
    };
    let astray: Vec<CornerId> = corners.enumerate().filter(strays).map(|(c, _)| c).collect();
    if astray.is_empty() {
        Ok(Fit { corners, chains, sheet_of_face })
    } else {
        Err(Misfit { corners: astray, ..Misfit::default() })
    }
}

/// The border arcs, if a border edge of the base lies on none.
fn bare_borders(network: &Network, base: &Foreign, chains: &IdVec<ArcId, Vec<Stop>>) -> Vec<ArcId> {
    let border = base.topology.edge_ids().filter(|&e| base.topology.is_border_edge(e)).count();
    let is_border = |a: &ArcId| network.arcs[*a].kind == ArcKind::Border;
    let covered: usize = chains.ids().filter(is_border).map(|a| chains[a].len() - 1).sum();
    if border == covered { Vec::new() } else { chains.ids().filter(is_border).collect() }
}

/// The base vertex of every corner: the nearest pairs first, each vertex once, border to border.
fn match_corners(
    mesh: &TriMesh,
    topology: &Topology,
    network: &Network,
    base: &Foreign,
    component_of: impl Fn(VertexId) -> Option<u32>,
) -> IdVec<CornerId, Option<VertexId>> {
    let mut pairs = Vec::new();
    for (c, &at) in network.corners.enumerate() {
        for v in base.mesh.positions().ids() {
            let d = base.position(v).distance(mesh.position(at));
            let fits =
                component_of(at) == Some(base.component[v]) && topology.is_border_vertex(at) == base.topology.is_border_vertex(v);
            if d <= base.reach[v] && fits {
                pairs.push((d, c, v));
            }
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut found = IdVec::filled(None, network.corners.len());
    let mut taken = IdVec::<VertexId, bool>::filled(false, base.mesh.n_vertices());
    for (_, c, v) in pairs {
        if found[c].is_none() && !taken[v] {
            (found[c], taken[v]) = (Some(v), true);
        }
    }
    found
}

/// The sheet of every base face, from the arcs round its region; else the arcs that contradict each other.
fn sheets(
    topology: &Topology,
    network: &Network,
    base: &Foreign,
    chains: &IdVec<ArcId, Vec<Stop>>,
) -> Result<IdVec<FaceId, SheetId>, Vec<ArcId>> {
    let mut sides = Vec::new();
    let mut is_barrier = IdVec::<EdgeId, bool>::filled(false, base.topology.n_edges());
    for (a, chain) in chains.enumerate() {
        for pair in chain.windows(2) {
            let [v, w] = [pair[0].vertex, pair[1].vertex];
            let [left, right] = [base.topology.find_halfedge(v, w), base.topology.find_halfedge(w, v)];
            sides.extend([(left, network.arcs[a].sheets[0], a), (right, network.arcs[a].sheets[1], a)]);
            left.or(right).iter().for_each(|&h| is_barrier[base.topology.edge(h)] = true);
        }
    }
    let (regions, n) = base.topology.regions(|e| !is_barrier[e]);
    let mut sheet_of: Vec<Option<SheetId>> = vec![None; n];
    let mut region_of: IdVec<SheetId, Option<u32>> = IdVec::filled(None, network.n_sheets);
    let mut wrong = Vec::new();
    for (halfedge, sheet, a) in sides {
        match (halfedge, sheet) {
            (Some(h), Some(s)) => {
                let region = regions[h.face()];
                let fits = *sheet_of[region as usize].get_or_insert(s) == s && *region_of[s].get_or_insert(region) == region;
                if !fits {
                    wrong.push(a);
                }
            }
            (None, None) => {}
            _ => wrong.push(a),
        }
    }
    if !wrong.is_empty() {
        wrong.dedup();
        return Err(wrong);
    }
    // A region without arcs is a closed component, and has that of the surface as its sheet.
    let component = topology.components().0;
    let sheet_of_component = |c: u32| component.enumerate().find(|(_, d)| **d == c).map(|(f, _)| network.sheet_of_face[f]);
    for (f, &region) in regions.enumerate() {
        let sheet = &mut sheet_of[region as usize];
        *sheet = sheet.or_else(|| sheet_of_component(base.component[base.mesh.face(f)[0]]));
    }
    Ok(regions.iter().map(|&r| sheet_of[r as usize].unwrap_or(SheetId::new(0))).collect())
}
