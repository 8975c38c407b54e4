//! Which normal of the surface each face takes at each of its corners.

use crate::freedom::{Freedom, OnArc};
use glam::DVec3;
use mesh_core::{HalfedgeId, IdVec, Topology, VertexId};
use region_map::{ArcSpan, Attachment, Domain, Surface};

/// Which normal a face takes at a corner.
#[derive(Clone, Copy, Debug)]
pub enum CornerNormal {
    /// The vertex' own (inside a sheet), or the one on the left side of its arc.
    Left,
    /// The one on the right side of its arc.
    Right,
    /// That of a sector at a corner of the network, which counts only where the face has no other.
    Sector(DVec3),
}

/// The unit reference normal of a face, by what it takes of the normals on both sides at each of its corners.
pub(crate) fn reference_normal(corners: [(CornerNormal, [DVec3; 2]); 3]) -> DVec3 {
    let (mut free, mut sectors) = (DVec3::ZERO, DVec3::ZERO);
    for (taken, [left, right]) in corners {
        match taken {
            CornerNormal::Left => free += left,
            CornerNormal::Right => free += right,
            CornerNormal::Sector(n) => sectors += n,
        }
    }
    free.try_normalize().unwrap_or_else(|| sectors.normalize_or_zero())
}

/// The normals that all faces of a domain take, given what its vertices are free to do.
pub(crate) fn corner_normals(
    surface: &Surface,
    domain: &Domain,
    freedoms: &IdVec<VertexId, Freedom>,
) -> IdVec<HalfedgeId, CornerNormal> {
    let mut normals = IdVec::filled(CornerNormal::Left, 3 * domain.topology.n_faces());
    for (v, freedom) in freedoms.enumerate() {
        match (freedom, domain.region.attachments[v]) {
            (Freedom::Arc(on_arc), _) => mark_right_side(&domain.topology, v, on_arc, &mut normals),
            (_, Attachment::Corner(_)) => mark_sectors(surface, domain, v, &mut normals),
            _ => {}
        }
    }
    normals
}

/// Marks the corners at `v` that lie to the right of its arc: those from the neighbour behind counter-clockwise to the one ahead.
fn mark_right_side(topology: &Topology, v: VertexId, on_arc: &OnArc, normals: &mut IdVec<HalfedgeId, CornerNormal>) {
    let fan: Vec<_> = topology.fan(v).collect();
    let start = fan.iter().position(|&h| topology.to(h) == on_arc.behind.vertex);
    let Some(start) = start else { return };
    for &h in fan[start..].iter().chain(&fan[..start]) {
        if topology.to(h) == on_arc.ahead.vertex {
            return;
        }
        normals[h] = CornerNormal::Right;
    }
}

/// Gives the corners at a vertex, which sits at a corner of the network, the normals of their sectors between arcs.
fn mark_sectors(surface: &Surface, domain: &Domain, v: VertexId, normals: &mut IdVec<HalfedgeId, CornerNormal>) {
    let fan: Vec<_> = domain.topology.fan(v).collect();
    let span_of = |h: HalfedgeId| domain.region.span(v, domain.topology.to(h));
    let start = fan.iter().position(|&h| span_of(h).is_some()).unwrap_or(0);
    let mut normal = DVec3::ZERO;
    for &h in fan[start..].iter().chain(&fan[..start]) {
        if let Some(span) = span_of(h) {
            normal = sector_normal(surface, span);
        }
        normals[h] = CornerNormal::Sector(normal);
    }
}

/// The normal of the sector counter-clockwise of a span that leaves a corner.
fn sector_normal(surface: &Surface, span: ArcSpan) -> DVec3 {
    let arc = &surface.network().arcs[span.arc];
    let with_arc = span.from < span.to;
    let leaving = arc.sides(surface.topology(), span.from)[usize::from(!with_arc)];
    leaving.map_or(DVec3::ZERO, |h| surface.normals().at_corner(h))
}
