//! Does a path leave an arc on the side on which its crease does?

use crate::assignment::Assignment;
use mesh_core::{HalfedgeId, Topology, VertexId};
use region_map::{ArcId, Domain};

/// The arc that bounds a sector clockwise, and whether it leaves the vertex forward.
type Bound = Option<(ArcId, bool)>;

/// Does the edge from the domain vertex `v` to `v_next` lie between the same arcs as that from `w` to `w_next` of the surface?
pub(crate) fn leaves_alike(assignment: &Assignment, [v, v_next]: [VertexId; 2], [w, w_next]: [VertexId; 2]) -> bool {
    let (topology, network) = (assignment.surface.topology(), assignment.surface.network());
    let Domain { topology: domain_topology, region, .. } = assignment.domain;
    let of_domain = |h: HalfedgeId| {
        let span = region.span(v, domain_topology.to(h))?;
        Some((span.arc, span.from < span.to))
    };
    let of_surface = |h: HalfedgeId| {
        let arc = network.arc_of_edge[topology.edge(h)]?;
        let to = topology.to(h);
        Some((arc, network.arcs[arc].vertices.windows(2).any(|pair| pair == [w, to])))
    };
    clockwise(domain_topology, v, v_next, of_domain) == clockwise(topology, w, w_next, of_surface)
}

/// What bounds the sector of the edge from `v` to `next`, clockwise of it; `None` where nothing does.
fn clockwise(topology: &Topology, v: VertexId, next: VertexId, bound: impl Fn(HalfedgeId) -> Bound) -> Bound {
    let fan: Vec<HalfedgeId> = topology.fan(v).collect();
    let at = fan.iter().position(|&h| topology.to(h) == next)?;
    fan[..at].iter().rev().chain(fan[at..].iter().rev()).find_map(|&h| bound(h))
}
