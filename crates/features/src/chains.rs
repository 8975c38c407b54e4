//! The network as a graph that arcs can be taken out of, without tracing it anew each time.
//!
//! Its edges are chains of arcs: where a corner has lost all arcs but two of one kind, these two go on as one.

use mesh_core::IdVec;
use region_map::{ArcId, ArcKind, CornerId, Network};

/// Arcs of one kind in a row, from one corner that is left to the next.
#[derive(Clone, Debug)]
pub(crate) struct Chain {
    /// Its arcs, in no order.
    pub(crate) arcs: Vec<ArcId>,
    /// The corners at both ends, `None` for a closed chain without a corner.
    pub(crate) ends: Option<[CornerId; 2]>,
    /// What all its arcs follow.
    pub(crate) kind: ArcKind,
    /// Sum over its arcs.
    pub(crate) length: f64,
    /// Sum over its arcs.
    pub(crate) persistence: f64,
}

impl Chain {
    /// Persistence per length.
    pub(crate) fn strength(&self) -> f64 {
        self.persistence / self.length.max(f64::MIN_POSITIVE)
    }

    fn other_end(&self, corner: CornerId) -> Option<CornerId> {
        self.ends.map(|[a, b]| if a == corner { b } else { a })
    }
}

/// The chains that are left of a network. A chain is named by one of its arcs.
pub(crate) struct Chains {
    chains: IdVec<ArcId, Option<Chain>>,
    chain_of_arc: IdVec<ArcId, ArcId>,
    at_corner: IdVec<CornerId, Vec<ArcId>>,
}

impl Chains {
    /// Every arc as a chain of its own.
    pub(crate) fn new(network: &Network, persistence: &IdVec<ArcId, f64>) -> Self {
        let mut at_corner = IdVec::filled(Vec::new(), network.corners.len());
        let mut chains = IdVec::new();
        for (id, arc) in network.arcs.enumerate() {
            for corner in arc.corners.into_iter().flatten() {
                at_corner[corner].push(id);
            }
            let (length, persistence) = (arc.length(), persistence[id]);
            chains.push(Some(Chain { arcs: vec![id], ends: arc.corners, kind: arc.kind, length, persistence }));
        }
        Self { chains, chain_of_arc: network.arcs.ids().collect(), at_corner }
    }

    /// The chain of an arc, `None` when it was dropped.
    pub(crate) fn of_arc(&self, arc: ArcId) -> Option<(ArcId, &Chain)> {
        let id = self.chain_of_arc[arc];
        self.chains[id].as_ref().map(|s| (id, s))
    }

    /// All chains that are left.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (ArcId, &Chain)> {
        self.chains.enumerate().filter_map(|(id, s)| s.as_ref().map(|s| (id, s)))
    }

    /// Number of chain ends at a corner.
    pub(crate) fn degree(&self, corner: CornerId) -> usize {
        self.at_corner[corner].len()
    }

    /// Takes a chain out. What is left at its ends may become one chain; returns those that did.
    pub(crate) fn drop_chain(&mut self, id: ArcId) -> Vec<ArcId> {
        let Some(chain) = self.chains[id].take() else { return Vec::new() };
        let ends: Vec<CornerId> = chain.ends.into_iter().flatten().collect();
        for &corner in &ends {
            self.at_corner[corner].retain(|&s| s != id);
        }
        ends.into_iter().filter_map(|corner| self.join_at(corner)).collect()
    }

    /// Joins the chains at a corner where only two of one kind are left.
    fn join_at(&mut self, corner: CornerId) -> Option<ArcId> {
        let &[a, b] = self.at_corner[corner].as_slice() else { return None };
        if a == b {
            self.chains[a].as_mut()?.ends = None;
            self.at_corner[corner].clear();
            return Some(a);
        }
        let (one, two) = (self.chains[a].as_ref()?, self.chains[b].as_ref()?);
        if one.kind != two.kind {
            return None;
        }
        let (keep, gone) = if one.arcs.len() >= two.arcs.len() { (a, b) } else { (b, a) };
        let ends = one.other_end(corner).zip(two.other_end(corner)).map(|(x, y)| [x, y]);
        self.at_corner[corner].clear();
        self.merge(keep, gone, ends);
        Some(keep)
    }

    fn merge(&mut self, keep: ArcId, gone: ArcId, ends: Option<[CornerId; 2]>) {
        let Some(taken) = self.chains[gone].take() else { return };
        for corner in ends.into_iter().flatten() {
            for s in self.at_corner[corner].iter_mut().filter(|s| **s == gone) {
                *s = keep;
            }
        }
        for &arc in &taken.arcs {
            self.chain_of_arc[arc] = keep;
        }
        if let Some(chain) = &mut self.chains[keep] {
            chain.ends = ends;
            chain.length += taken.length;
            chain.persistence += taken.persistence;
            chain.arcs.extend(taken.arcs);
        }
    }
}
