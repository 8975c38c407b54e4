//! What the vertices of a domain are free to do.

use crate::RelaxError;
use crate::longest_gaps::LongestGaps;
use mesh_core::VertexId;
use region_map::{ArcId, Attachment, Domain, Surface};

/// What a vertex is free to do.
#[derive(Clone, Copy, Debug)]
pub enum Freedom {
    /// Nothing: it is at a corner, or held.
    Fixed,
    /// Slide along its arc between two neighbours.
    Arc(OnArc),
    /// Move over its sheet.
    Sheet,
}

/// How a vertex slides along its arc: between two neighbours.
#[derive(Clone, Copy, Debug)]
pub struct OnArc {
    pub(crate) arc: ArcId,
    /// The neighbour towards the start of the arc.
    pub behind: ArcNeighbour,
    /// The one towards its end.
    pub ahead: ArcNeighbour,
    /// The gap to a neighbour, an arc length, does not get longer than this: a chord across a hole would be cheap for its
    /// triangles, and far from the arc.
    pub longest_gap: f64,
    /// Nor shorter than this: vertices that fall into one never come apart again.
    pub shortest_gap: f64,
}

/// A neighbour on an arc: in the arc lengths of the vertex between, it is at its own arc length plus `shift`.
///
/// The shift is a multiple of the length on a loop, and else 0. A corner has the arc length 0 and its place as shift.
#[derive(Clone, Copy, Debug)]
pub struct ArcNeighbour {
    /// The vertex.
    pub vertex: VertexId,
    /// What its arc length is short of, in the arc lengths of the vertex between.
    pub shift: f64,
}

/// Gaps get no shorter than this share of the longer one at the start, so that they don't shrink again with each relaxation: less
/// lets vertices come together, more holds them apart where shapes would be better. Measured: on pyvi_footbones some went down to
/// 1e-13 of the diagonal; with .01 casting loses .002 of its creases.
const SHRINK: f64 = 0.001;

impl Freedom {
    /// What vertex `v` of a checked domain may do. Fails where it has no two neighbours on its arc, or sits outside of its sheet.
    pub(crate) fn new(surface: &Surface, domain: &Domain, longest_gaps: &LongestGaps, v: VertexId) -> Result<Self, RelaxError> {
        let region = &domain.region;
        match region.attachments[v] {
            Attachment::Corner(_) => Ok(Self::Fixed),
            Attachment::Arc { arc, t } => Ok(Self::Arc(OnArc::new(surface, domain, longest_gaps, v, (arc, t))?)),
            Attachment::Sheet(sheet) if surface.network().sheet_of_face.get(region.points[v].face) == Some(&sheet) => {
                Ok(Self::Sheet)
            }
            Attachment::Sheet(_) => Err(RelaxError::OtherSheet(v)),
        }
    }
}

impl OnArc {
    /// The neighbours of `v`, at this arc length, on its arc.
    fn new(
        surface: &Surface,
        domain: &Domain,
        longest_gaps: &LongestGaps,
        v: VertexId,
        (arc, t): (ArcId, f64),
    ) -> Result<Self, RelaxError> {
        let region = &domain.region;
        let mut ends: Vec<(f64, ArcNeighbour)> = Vec::new();
        for vertex in domain.topology.one_ring(v) {
            if let Some(span) = region.span(v, vertex).filter(|span| span.arc == arc) {
                let own = match region.attachments[vertex] {
                    Attachment::Arc { t, .. } => t,
                    _ => 0.0,
                };
                let gap = span.to - span.from;
                ends.push((gap, ArcNeighbour { vertex, shift: t + gap - own }));
            }
        }
        let longest = ends.iter().map(|end| end.0.abs()).fold(0.0, f64::max);
        let longest_gap = longest_gaps.about(surface, (arc, t), longest);
        let shortest_gap = SHRINK * longest;
        match ends[..] {
            [(a, behind), (b, ahead)] | [(b, ahead), (a, behind)] if a <= 0.0 && b >= 0.0 && a < b => {
                Ok(Self { arc, behind, ahead, longest_gap, shortest_gap })
            }
            _ => Err(RelaxError::ArcOrder(v)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use region_map::ArcSpan;

    /// A vertex that has come next to its neighbour is kept from it as if it were half-way: it comes no nearer when relaxed
    /// again.
    #[test]
    fn gaps_do_not_shrink_with_each_relaxation() {
        let surface = Surface::with_creases(fixtures::cuboid(DVec3::ONE, 4), 40.0).unwrap();
        let mut domain = Domain::identity(&surface);
        let (topology, region) = (&domain.topology, &mut domain.region);
        let on_arc = |region: &region_map::RegionMap, v: VertexId| matches!(region.attachments[v], Attachment::Arc { .. });
        let is_between = |v: &VertexId| on_arc(region, *v) && topology.one_ring(*v).filter(|&w| on_arc(region, w)).count() == 2;
        let v = region.vertices().find(is_between).unwrap();
        let Attachment::Arc { arc, t } = region.attachments[v] else { unreachable!() };
        for w in topology.one_ring(v).collect::<Vec<_>>() {
            let Some(span) = region.span(w, v) else { continue };
            // 1e-6 short of the end of its way from the neighbour ahead.
            let near = if span.from > t { span.from - 1e-6 } else { continue };
            region.attachments[v] = Attachment::Arc { arc, t: near };
            region.insert_span(w, v, ArcSpan { to: near, ..span });
            let behind = topology.one_ring(v).find(|&u| u != w && region.span(u, v).is_some()).unwrap();
            let span = region.span(behind, v).unwrap();
            region.insert_span(behind, v, ArcSpan { to: near, ..span });
        }
        let Attachment::Arc { t: near, .. } = region.attachments[v] else { unreachable!() };
        assert!(near > t + 0.2);
        let on_arc = OnArc::new(&surface, &domain, &LongestGaps::new(&surface, &domain), v, (arc, near)).unwrap();
        assert!((on_arc.shortest_gap - SHRINK * 0.5).abs() < 1e-5, "{}", on_arc.shortest_gap);
    }
}
